#include "runtime/results/stress.hpp"

#include <catch2/catch.hpp>

#include "tests/support/elastic_cases.hpp"

using namespace garment;

TEST_CASE("the largest tension is that of the most stretched thread") {
  test::SheetSpec spec;
  spec.nx = spec.ny = 4;
  const model::Model m = test::make_sheet(spec);
  model::State state;
  state.position = m.start;
  CHECK(*results::largest_tension(m, state, "") == Approx(0).margin(1e-9));
  for (auto& p : state.position) p.x() *= 1.02;
  CHECK(*results::largest_tension(m, state, "sheet") == Approx(0.02 * spec.stretch));
  CHECK_FALSE(results::largest_tension(m, state, "other"));
}

TEST_CASE("cut cells bear as their laws say") {
  const model::Model m = test::membrane_case().model;  // K = 900 both ways
  model::State state;
  for (const auto& p : m.start) state.position.emplace_back(p.x(), 1.03 * p.y(), 0);
  CHECK(*results::largest_tension(m, state, "") == Approx(27));
}
