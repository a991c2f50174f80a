#include "runtime/results/measures.hpp"

#include <catch2/catch.hpp>

#include "runtime/base/hash.hpp"
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

TEST_CASE("the state hash sees every bit and nothing else", "[measures]") {
  const model::Model m = test::make_sheet({});
  State a = start(m), b = a;
  CHECK(results::state_hash(a) == results::state_hash(b));
  b.time = 3;
  CHECK(results::state_hash(a) == results::state_hash(b));
  b.position[1][2] = 5e-324;
  CHECK(results::state_hash(a) != results::state_hash(b));
}
