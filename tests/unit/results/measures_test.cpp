#include "runtime/results/measures.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/grid_model.hpp"

using namespace garment;
using model::State;
using model::Vector3d;

namespace {

State start(const model::Model& m) {
  State s;
  s.position = m.start;
  s.velocity.assign(m.n_particles(), Vector3d::Zero());
  return s;
}

}  // namespace

TEST_CASE("sizes of a sheet that is pulled to twice its width", "[measures]") {
  test::SheetSpec spec;
  spec.nx = 11;
  spec.ny = 21;
  model::Model m = test::make_sheet(spec);
  m.seams.push_back({"side", {}, {}, 0.2});
  for (int j = 0; j < spec.ny; ++j) m.seams[0].particles.push_back(test::sheet_particle(spec, 3, j));
  State s = start(m);
  for (Vector3d& p : s.position) p[0] *= 2;
  const results::Measures r = results::measure(m, s, {});
  REQUIRE(r.panels.size() == 1);
  CHECK(r.all.draped_area == Approx(2 * 0.1 * 0.2));
  CHECK(r.all.mass == Approx(m.panels[0].mass));
  CHECK_FALSE(r.all.clearance.has_value());
  CHECK(r.seams.at(0).draped_length == Approx(0.2));
  CHECK(r.seams.at(0).gap == 0);
  const geometry::Curve hem({0, 0}, {0.1, 0});
  CHECK(results::draped_length(m, s, 0, hem, 0, 0.1).value() == Approx(0.2));
  CHECK(results::draped_length(m, s, 0, hem, 0.05, 0.03).value() == Approx(0.04));
  CHECK_FALSE(results::draped_length(m, s, 0, geometry::Curve({5, 5}, {6, 5}), 0, 1).has_value());
}

namespace {

/// Bodies without files.
class NoFiles : public Host {
 public:
  HostResult<std::string> read_file(const std::string&, std::uint64_t) override {
    return {{}, {"no such file"}};
  }
  HostResult<bool> write_file(const std::string&, std::string_view) override { return {{}, {"no folder"}}; }
  double seconds() override { return 0; }
  bool interrupted() override { return false; }
  std::uint64_t peak_memory() override { return 0; }
};

body::Body sphere(double radius, const Vector3d& at) {
  design::Body declared;
  declared.name = "ball";
  declared.shape = design::Sphere{radius};
  declared.position = at;
  NoFiles host;
  body::BodyResult built = body::build_body(declared, host, "");
  REQUIRE(built.body.has_value());
  return *built.body;
}

}  // namespace

TEST_CASE("clearance is the distance to the nearest body, negative inside", "[measures]") {
  test::SheetSpec spec;
  spec.nx = 11;
  spec.ny = 11;
  spec.plane = test::SheetPlane::horizontal;
  const model::Model m = test::make_sheet(spec);  // 0.1 m x 0.1 m at y = 0
  const State s = start(m);
  const Vector3d below(0.05, -0.13, -0.05);
  const auto far = results::measure(m, s, {sphere(0.1, below)}).all.clearance;
  REQUIRE(far.has_value());
  CHECK(far->least == Approx(0.03).margin(0.001));  // the surface is faceted
  CHECK(far->mean > far->least);
  CHECK(far->mean < 0.05);
  const auto nearest =
      results::measure(m, s, {sphere(0.1, below), sphere(0.05, {0.05, 0.06, -0.05})}).all.clearance;
  CHECK(nearest->least == Approx(0.01).margin(0.001));
  const auto inside = results::measure(m, s, {sphere(0.1, {0.05, -0.09, -0.05})}).all.clearance;
  CHECK(inside->least == Approx(-0.01).margin(0.001));
  CHECK_FALSE(results::measure(m, s, {sphere(0.1, {5, 0, 0})}).all.clearance.has_value());
}

TEST_CASE("the gap of a closure is that of its longest tie, and its mass is the garment's", "[measures]") {
  test::SheetSpec spec;
  spec.nx = spec.ny = 3;
  model::Model m = test::make_sheet(spec);
  const double cloth = m.panels[0].mass;
  m.closures = {{"slack", {}, 0}, {"open", {}, 2e-3}};
  m.tie = {{0, 0, 0, 1, 1, 1}, {0, 0, 0, 1, 1, 1}, {0, 2, 0, 8, 8, 8}};
  m.tie_weights = {{1, 0, 0, 1, 0, 0}, {1, 0, 0, 1, 0, 0}, {0.25, 0.5, 0.25, 1, 0, 0}};
  m.tie_length = {0.02, 0.007, 0.001};
  m.tie_stiffness = {100, 100, 100};
  m.tie_closure = {0, 1, 1};
  const results::Measures r = results::measure(m, start(m), {});
  REQUIRE(r.ties.size() == 2);
  CHECK(r.ties[0].closure == "slack");
  CHECK(r.ties[0].gap == 0);
  CHECK(r.ties[1].gap == Approx(std::hypot(0.01, 0.02) - 0.001));  // from the middle of the lower side
  CHECK(r.all.mass == Approx(cloth + 2e-3));
  CHECK(r.panels[0].mass == Approx(cloth));
}
