#include "runtime/simulator/approach.hpp"

#include <catch2/catch.hpp>

#include "runtime/simulator/certificate.hpp"
#include "tests/support/two_sheets.hpp"

using namespace garment;
using Eigen::Vector3d;

namespace {

model::Model two_sheets() {
  test::SheetSpec spec;
  spec.nx = spec.ny = 12;
  spec.plane = test::SheetPlane::horizontal;
  model::Model upper = test::make_sheet(spec);
  for (Vector3d& p : upper.start) p.y() += 0.02;
  return test::together(test::make_sheet(spec), upper);
}

std::size_t cuts(const model::Model& m, const std::vector<Vector3d>& x) {
  model::State state;
  state.position = x;
  return simulator::certify(m, state, {}).self_intersections;
}

}  // namespace

TEST_CASE("cloth that meets nothing arrives") {
  const model::Model m = two_sheets();
  std::vector<Vector3d> to = m.start;
  for (Vector3d& p : to) p += Vector3d(0.07, -0.03, 0.11);
  const std::vector<Vector3d> x = simulator::approach(m, m.start, to);
  double off = 0;
  for (std::size_t i = 0; i < x.size(); ++i) off = std::max(off, (x[i] - to[i]).norm());
  CHECK(off < 1e-5);
}

TEST_CASE("cloth on its way through other cloth stops there") {
  const model::Model m = two_sheets();
  std::vector<Vector3d> to = m.start;
  const std::size_t first = m.n_particles() / 2;
  for (std::size_t i = first; i < to.size(); ++i) {
    const bool half = m.start[i].x() > 0.05;
    to[i].y() -= half ? 0.03 : 0.01;  // one half through the lower sheet, one half nearer to it
  }
  REQUIRE(cuts(m, to) > 0);
  const std::vector<Vector3d> x = simulator::approach(m, m.start, to);
  CHECK(cuts(m, x) == 0);
  for (std::size_t i = first; i < to.size(); ++i) {
    CHECK(x[i].y() > 0);
    if (m.start[i].x() < 0.03) CHECK((x[i] - to[i]).norm() < 1e-4);
    if (m.start[i].x() > 0.08) CHECK(x[i].y() < 0.005);
  }
}

TEST_CASE("what cuts itself from the start is let pass") {
  const model::Model m = two_sheets();
  std::vector<Vector3d> from = m.start, to = m.start;
  for (std::size_t i = m.n_particles() / 2; i < from.size(); ++i) from[i].y() -= m.start[i].x() > 0.05 ? 0.025 : 0;
  REQUIRE(cuts(m, from) > 0);
  const std::vector<Vector3d> x = simulator::approach(m, from, to);
  CHECK(cuts(m, x) <= cuts(m, from));
}
