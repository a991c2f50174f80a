// What the forces alone must give, on hand-made sheets: patch tests, and small rest states with known
// answers. The same cases run through modeller and solver elsewhere.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/clamped_strip.hpp"
#include "tests/support/dense_newton.hpp"
#include "tests/support/grid_model.hpp"

namespace {

using namespace garment;
using Eigen::Vector3d;
using test::clamped_strip;
using test::kGravity;
using Positions = std::vector<Vector3d>;

double top(const Positions& x) {
  double y = x[0].y();
  for (const auto& p : x) y = std::max(y, p.y());
  return y;
}
double bottom(const Positions& x) {
  double y = x[0].y();
  for (const auto& p : x) y = std::min(y, p.y());
  return y;
}

}  // namespace

TEST_CASE("uniform strain leaves no force inside a sheet and the right tractions on its border") {
  test::SheetSpec spec;
  spec.nx = 7;
  spec.ny = 6;
  const model::Model m = test::make_sheet(spec);
  const double weft = 0.04, warp = 0.03, phi = 0.1;
  Positions x, f;
  for (const auto& uv : m.vertex_uv)
    x.emplace_back((1 + weft) * uv[0] + (1 + warp) * std::sin(phi) * uv[1],
                   (1 + warp) * std::cos(phi) * uv[1], 0);
  simulator::ElasticModel(m).energy_and_force(x, f);
  double right = 0;
  const double scale = spec.stretch * weft * spec.h;
  for (int j = 0; j < spec.ny; ++j)
    for (int i = 0; i < spec.nx; ++i) {
      const bool border = i == 0 || j == 0 || i + 1 == spec.nx || j + 1 == spec.ny;
      if (!border) CHECK(f[test::sheet_particle(spec, i, j)].norm() < 1e-12 * scale);
    }
  for (int j = 0; j < spec.ny; ++j) right += f[test::sheet_particle(spec, spec.nx - 1, j)].x();
  // Right side: the weft tension pulls it back; shear acts across the weft edges' own direction, along y.
  CHECK(right == Approx(-spec.stretch * weft * 5 * spec.h).epsilon(1e-10));
}

TEST_CASE("a twisted strip has the torsional rigidity 4 Ct b") {
  test::SheetSpec spec;
  spec.nx = 9;
  spec.ny = 41;
  spec.h = 0.0025;
  spec.shear = 0;
  model::Model m = test::make_sheet(spec);
  m.spring.clear();
  const double rate = 0.5, b = 8 * spec.h, L = 40 * spec.h;  // rad/m
  Positions x;
  for (const auto& uv : m.vertex_uv) {
    const double u = uv[0] - b / 2, angle = rate * uv[1];
    x.emplace_back(u * std::cos(angle), uv[1], u * std::sin(angle));
  }
  CHECK(simulator::ElasticModel(m).energy(x) ==
        Approx(0.5 * 4 * spec.twist * b * rate * rate * L).epsilon(1e-3));
}

TEST_CASE("a hanging strip stretches by w L^2 / 2K") {
  test::SheetSpec spec;
  spec.nx = 2;
  spec.ny = 41;
  spec.stretch = 20;
  model::Model m = test::make_sheet(spec);
  test::hold_row(m, spec, spec.ny - 1);
  const auto rest = test::settle_dense(m, m.start, 1e-9, 40);
  INFO("steps " << rest.steps);
  REQUIRE(rest.residual <= 1e-9);
  const double L = 40 * spec.h, w = spec.density * kGravity;
  CHECK(-bottom(rest.x) == Approx(w * L * L / (2 * spec.stretch)).epsilon(1e-6));
  double held = 0, weight = 0;
  for (const auto& r : rest.reaction) held += r.y();
  for (double mass : m.mass) weight += mass * kGravity;
  CHECK(held == Approx(weight).epsilon(1e-8));
}

TEST_CASE("a stiff strip between two points hangs as a catenary") {
  test::SheetSpec spec;
  spec.nx = 101;
  spec.ny = 2;
  spec.h = 0.01;
  spec.stretch = 5e4;
  spec.bend = 1e-9;
  spec.plane = test::SheetPlane::horizontal;
  model::Model m = test::make_sheet(spec);
  Positions x = m.start;
  for (auto& p : x) {  // between supports 0.8 apart, on a parabola near the answer
    const double s = p.x() - 0.5;
    p = {0.8 * s, 0.26 * (4 * s * s - 1), p.z()};
  }
  m.start = x;
  test::hold_column(m, spec, 0);
  test::hold_column(m, spec, 100);
  const auto rest = test::settle_dense(m, x, 1e-7, 200);
  INFO("steps " << rest.steps);
  REQUIRE(rest.residual <= 1e-7);
  CHECK(top(rest.x) - bottom(rest.x) == Approx(0.265438).epsilon(0.005));
  const double weight_per_length = spec.density * kGravity * spec.h;  // the strip is one cell wide
  double pull = 0;
  for (int j = 0; j < 2; ++j) pull += rest.reaction[test::sheet_particle(spec, 100, j)].x();
  CHECK(pull == Approx(0.338202 * weight_per_length).epsilon(0.005));
}

TEST_CASE("a cantilever follows the elastica") {
  // H: drop of the tip, W: its distance from the clamp; Gamma = w L^3 / B.
  const double table[][2] = {{1, 0.12456}, {5, 0.58572}, {10, 1.06680}, {20, 1.86393}, {50, 3.70556}};
  for (const auto& [gamma, expected] : table) {
    test::SheetSpec spec;
    const model::Model m = clamped_strip(spec, 40, 0.2, gamma, 1e-5);
    const auto rest = test::settle_dense(m, m.start, 1e-6, 400);
    INFO("Gamma " << gamma << ", steps " << rest.steps << ", residual " << rest.residual);
    REQUIRE(rest.residual <= 1e-6);
    const Vector3d tip =
        rest.x[test::sheet_particle(spec, spec.nx - 1, 0)] - rest.x[test::sheet_particle(spec, 1, 0)];
    CHECK(-tip.y() / tip.x() == Approx(expected).epsilon(0.02));
  }
}

TEST_CASE("the tip of a cantilever converges with the square of the spacing") {
  double tip[3];
  for (int level = 0; level < 3; ++level) {
    test::SheetSpec spec;
    const int cells = 10 << level;
    const model::Model m = clamped_strip(spec, cells, 0.2, 5, 1e-5);
    const auto rest = test::settle_dense(m, m.start, 1e-6, 400);
    INFO("cells " << cells << ", steps " << rest.steps << ", residual " << rest.residual);
    REQUIRE(rest.residual <= 1e-6);
    tip[level] = rest.x[test::sheet_particle(spec, spec.nx - 1, 0)].y();
  }
  const double order = std::log2(std::abs((tip[0] - tip[1]) / (tip[1] - tip[2])));
  INFO(tip[0] << " " << tip[1] << " " << tip[2]);
  CHECK(order >= 1.8);
}
