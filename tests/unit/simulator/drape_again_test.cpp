#include "runtime/simulator/drape_again.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/grid_model.hpp"

namespace {

using namespace garment;
using Eigen::Vector3d;

constexpr double kSide = 0.3;  // m

/// A square that juts out from a clamp of two columns: its rest is one shape.
model::Model shelf(int cells, double bend) {
  test::SheetSpec spec;
  spec.nx = spec.ny = cells + 1;
  spec.h = kSide / cells;
  spec.bend = bend;
  spec.twist = 0.4 * bend;
  spec.plane = test::SheetPlane::horizontal;
  model::Model m = test::make_sheet(spec);
  test::hold_column(m, spec, 0);
  test::hold_column(m, spec, 1);
  return m;
}

simulator::DrapeSettings settings(simulator::Settle settle) {
  simulator::DrapeSettings s;
  s.settle = settle;
  return s;
}

model::State at_rest(const model::Model& m, simulator::Settle settle) {
  model::State state;
  state.position = m.start;
  const simulator::DrapeReport report = simulator::drape(m, {}, state, settings(settle));
  REQUIRE(report.status == simulator::DrapeStatus::at_rest);
  return state;
}

double largest_distance(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
  REQUIRE(a.size() == b.size());
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
  return most;
}

}  // namespace

TEST_CASE("a garment that was not changed is at rest at once where it hangs") {
  const model::Model m = shelf(12, 2e-5);
  const model::State rest = at_rest(m, simulator::Settle::equilibrium);
  model::State again = rest;
  const simulator::DrapeReport report =
      simulator::drape_again({}, m, {}, again, settings(simulator::Settle::equilibrium));
  CHECK(report.status == simulator::DrapeStatus::at_rest);
  CHECK(report.steps <= 5);
  CHECK(largest_distance(rest.position, again.position) < 1e-3);
}

TEST_CASE("a drape from the shape of a softer cloth ends where a fresh one ends") {
  const model::Model soft = shelf(12, 2e-5), stiff = shelf(12, 6e-5);
  const model::State fresh = at_rest(stiff, simulator::Settle::exact);
  model::State again = at_rest(soft, simulator::Settle::equilibrium);
  REQUIRE(largest_distance(fresh.position, again.position) > 0.004);
  const simulator::DrapeReport report =
      simulator::drape_again({}, stiff, {}, again, settings(simulator::Settle::exact));
  CHECK(report.status == simulator::DrapeStatus::at_rest);
  CHECK(report.residual <= 1e-6);
  CHECK(largest_distance(fresh.position, again.position) < 1e-4);
}

TEST_CASE("coarser grids go ahead without changing where the garment ends") {
  const model::Model coarse = shelf(6, 6e-5), fine = shelf(12, 6e-5);
  const model::State fresh = at_rest(fine, simulator::Settle::exact);
  model::State again = at_rest(shelf(12, 2e-5), simulator::Settle::equilibrium);
  const simulator::DrapeReport report =
      simulator::drape_again({coarse}, fine, {}, again, settings(simulator::Settle::exact));
  CHECK(report.status == simulator::DrapeStatus::at_rest);
  CHECK(largest_distance(fresh.position, again.position) < 1e-4);
}

TEST_CASE("a drape from a shape stops where it is told to, at a shape that holds") {
  const model::Model coarse = shelf(6, 6e-5), fine = shelf(12, 6e-5);
  model::State again = at_rest(shelf(12, 2e-5), simulator::Settle::equilibrium);
  const model::State before = again;
  simulator::DrapeSettings stopped = settings(simulator::Settle::equilibrium);
  stopped.interrupted = [] { return true; };
  const simulator::DrapeReport report = simulator::drape_again({coarse}, fine, {}, again, stopped);
  CHECK(report.status == simulator::DrapeStatus::interrupted);
  CHECK(again.position == before.position);
}

TEST_CASE("a garment squeezed by a tenth is far from its rest, one bent is not") {
  const model::Model m = shelf(12, 2e-5);
  CHECK_FALSE(simulator::far_from_rest(m, at_rest(m, simulator::Settle::equilibrium).position));
  std::vector<Vector3d> x = m.start;
  for (Vector3d& p : x) p.x() *= 0.9;
  CHECK(simulator::far_from_rest(m, x));
  // A garment that hung as stretched before is at home there.
  CHECK_FALSE(simulator::far_from_rest(m, x, simulator::strained_share(m, x)));
}
