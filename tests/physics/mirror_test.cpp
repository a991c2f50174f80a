// Garments that are their own mirror image come to rest as one, and nothing else is taken for one.
#include <catch2/catch.hpp>

#include "runtime/base/host.hpp"
#include "runtime/simulator/certificate.hpp"
#include "runtime/simulator/mirror.hpp"
#include "runtime/simulator/relaxation.hpp"
#include "tests/support/draped.hpp"
#include "tests/unit/modeller/built.hpp"

using namespace garment;
using Eigen::Vector3d;
using model::Index;

namespace {

body::Body ball(double x = 0) {
  design::Body declared;
  declared.name = "ball";
  declared.shape = design::Sphere{0.1};
  declared.position = {x, 0, 0};
  body::BodyResult built = body::build_body(declared, system_host(), "");
  REQUIRE(built.body);
  return std::move(*built.body);
}

/// A sheet over the ball, whose folds fall as they may.
model::Model sheet() {
  test::SheetSpec spec;
  spec.nx = spec.ny = 21;
  spec.h = 0.02;
  spec.plane = test::SheetPlane::horizontal;
  model::Model m = test::make_sheet(spec);
  for (Vector3d& p : m.start) p += Vector3d(-0.2, 0.103, 0.2);
  return m;
}

double unevenness(const model::Model& m, const std::vector<Vector3d>& x) {
  const simulator::Mirror mirror(m, {});
  REQUIRE_FALSE(mirror.empty());
  return mirror.unevenness(x);
}

test::Draped drape(const model::Model& m, bool symmetric, std::vector<Vector3d> start) {
  test::Draped d;
  d.state.position = std::move(start);
  simulator::DrapeSettings settings;
  settings.symmetric = symmetric;
  d.report = simulator::drape(m, {ball()}, d.state, settings);
  INFO(d.report.steps << " steps, residual " << d.report.residual);
  REQUIRE(d.report.status == simulator::DrapeStatus::at_rest);
  return d;
}

}  // namespace

TEST_CASE("mirror: a sheet over a ball lies evenly, and at rest by its own forces") {
  const model::Model m = sheet();
  const test::Draped as_it_may = drape(m, false, m.start), even = drape(m, true, m.start);
  CHECK_FALSE(as_it_may.report.symmetric);
  CHECK(even.report.symmetric);
  CHECK(unevenness(m, even.state.position) < 1e-6);
  CHECK(simulator::certify(m, even.state, {ball()}).clean());
  // Nobody keeps it even now: if its forces did not balance there, this would be told.
  const std::vector<body::Body> bodies{ball()};
  simulator::Relaxation free(m, bodies, {});
  std::vector<Vector3d> force;
  CHECK(free.residual(even.state.position, force) < 1.2 * simulator::target_residual(simulator::Settle::equilibrium));
  CHECK(even.report.energy < as_it_may.report.energy + 0.02 * std::abs(as_it_may.report.energy));
}

TEST_CASE("mirror: what begins uneven comes to lie evenly") {
  const model::Model m = sheet();
  std::vector<Vector3d> start = m.start;
  for (Vector3d& p : start) p.z() += 0.05 * p.x() + 0.004, p.y() += 0.02 * p.x() + 0.02;
  REQUIRE(unevenness(m, start) > 0.01);
  const test::Draped d = drape(m, true, start);
  CHECK(d.report.symmetric);
  CHECK(unevenness(m, d.state.position) < 1e-6);
}

TEST_CASE("mirror: panels of a pair are images of one another, seams and darts and all") {
  const model::Model m = test::build(test::skirt(0.03));
  const simulator::Mirror mirror(m, {});
  REQUIRE_FALSE(mirror.empty());
  for (std::size_t i = 0; i < m.n_particles(); ++i) {
    const auto j = static_cast<std::size_t>(mirror.image()[i]);
    CHECK((m.start[i] - Vector3d(-m.start[j].x(), m.start[j].y(), m.start[j].z())).norm() < 1e-3);
    CHECK(mirror.image()[j] == static_cast<Index>(i));
  }
}

TEST_CASE("mirror: a garment that differs on its two sides is none") {
  const model::Model m = sheet();
  const std::vector<body::Body> middle{ball()}, beside{ball(0.003)};
  REQUIRE_FALSE(simulator::Mirror(m, middle).empty());
  CHECK(simulator::Mirror(m, beside).empty());
  auto differs = [&](const char* what, auto change) {
    model::Model other = m;
    change(other);
    INFO(what);
    CHECK(simulator::Mirror(other, middle).empty());
  };
  std::size_t at = 0;  // a particle of one side
  while (m.start[at].x() > -0.1) ++at;
  differs("a button's mass", [&](model::Model& o) { o.mass[at] *= 4; });
  differs("a fabric's friction", [&](model::Model& o) { o.friction[at] += 0.1; });
  auto on_the_left = [&](Index i) { return m.start[static_cast<std::size_t>(i)].x() > 0.1; };  // a quarter of the sheet
  differs("threads drawn out", [&](model::Model& o) {
    for (std::size_t s = 0; s < o.spring.size(); ++s)
      if (on_the_left(o.spring[s][0])) o.spring_rest[s] *= 1.02;
  });
  differs("softer cloth", [&](model::Model& o) {
    for (std::size_t b = 0; b < o.bend.size(); ++b)
      if (on_the_left(o.bend[b][1])) o.bend_rigidity[b] *= 0.9;
  });
  differs("heavier cloth", [&](model::Model& o) {
    for (std::size_t i = 0; i < o.mass.size(); ++i)
      if (on_the_left(static_cast<Index>(i))) o.mass[i] *= 1.03;
  });
  differs("a pin", [&](model::Model& o) {
    o.hold_particle.push_back(static_cast<Index>(at));
    o.hold_kind.push_back(model::HoldKind::point);
    o.hold_point.push_back(o.start[at]);
    o.hold_normal.push_back(Vector3d::UnitY());
  });
  differs("a load", [&](model::Model& o) {
    o.load_particle.push_back(static_cast<Index>(at));
    o.load_force.emplace_back(0, 0, 1);
  });
  differs("wind from a side", [](model::Model& o) { o.air = {{3, 0, 0}, 0, 1.2}; });
  differs("a pad", [&](model::Model& o) {
    o.pad_particle.push_back(static_cast<Index>(at));
    o.pad_thickness.push_back(5e-3);
  });
  differs("a slope", [](model::Model& o) { o.gravity = {1, -9.8, 0}; });
}

TEST_CASE("mirror: what neighbours on one side divide otherwise makes no difference") {
  const model::Model m = sheet();
  model::Model other = m;
  std::size_t at = 0;
  while (m.start[at].x() > -0.1) ++at;
  other.mass[at] *= 1.5;
  other.mass[at + 21] *= 0.5;
  CHECK_FALSE(simulator::Mirror(other, {ball()}).empty());
}

TEST_CASE("mirror: of a part, what has no image in it goes its own way") {
  const model::Model m = sheet();
  const simulator::Mirror mirror(m, {});
  REQUIRE_FALSE(mirror.empty());
  std::vector<Index> particle;
  for (Index i = 0; i < 40; ++i) particle.push_back(i);  // two rows, less the end of the second
  const simulator::Mirror part = mirror.of_part(particle, std::vector<char>(40, 1));
  for (std::size_t k = 0; k < 21; ++k) CHECK(part.image()[k] == static_cast<Index>(20 - k));
  CHECK(part.image()[21] == -1);
  std::vector<char> free(40, 1);
  free[0] = 0;
  CHECK(mirror.of_part(particle, free).image()[20] == -1);
}

TEST_CASE("mirror: places that lie unevenly are parted, and a checkpoint keeps who is still paired") {
  const model::Model m = sheet();
  const simulator::Mirror mirror(m, {});
  REQUIRE(mirror.n_paired() == m.n_particles());
  std::vector<Vector3d> x = m.start;
  x[3].y() += 0.002;
  simulator::Mirror some = mirror.where_even(x, simulator::kEven);
  CHECK(some.n_paired() == m.n_particles() - 2);
  CHECK(some.image()[3] == -1);
  CHECK(some.image()[17] == -1);
  CHECK(some.unevenness(x) < 1e-12);
  CHECK(mirror.unevenness(x) == Approx(0.002));
  Archive out;
  some.keep(out, m.n_particles());
  const std::string bytes = out.take();
  Archive in(bytes), of_another(bytes);
  simulator::Mirror back, wrong;
  back.keep(in, m.n_particles());
  CHECK(in.whole());
  CHECK(back.image() == some.image());
  wrong.keep(of_another, m.n_particles() + 1);
  CHECK_FALSE(of_another.ok());
}
