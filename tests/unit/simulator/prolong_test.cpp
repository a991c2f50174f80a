// Carrying positions from a coarse grid to a finer one.
#include "runtime/simulator/prolong.hpp"

#include <catch2/catch.hpp>

#include "tests/support/grid_model.hpp"

namespace {

using namespace garment;
using Eigen::Vector2d;
using Eigen::Vector3d;
using model::Index;
using model::Model;
using Positions = std::vector<Vector3d>;

Model sheet(int nx, int ny, double h) {
  test::SheetSpec spec;
  spec.nx = nx;
  spec.ny = ny;
  spec.h = h;
  return test::make_sheet(spec);
}

/// An affine map of the pattern, another for each panel.
Vector3d affine(const Vector2d& uv, Index panel = 0) {
  return Vector3d(0.3, -0.2, 0.1) + uv.x() * Vector3d(0.9, 0.1, -0.4) + uv.y() * Vector3d(-0.2, 1.1, 0.5) +
         panel * (uv.y() - 0.07) * Vector3d(0, 0.4, 1);
}

template <class Map>
Positions mapped(const Model& m, const Map& map) {
  Positions x(m.n_particles());
  for (std::size_t v = 0; v < m.n_vertices(); ++v)
    x[m.vertex_particle[v]] = map(m.vertex_uv[v], m.vertex_panel[v]);
  return x;
}

/// Panels of rows 0..rows and rows..2 rows of one sheet, merged along row `rows`, as two panels with their
/// own uv.
Model sewn_pair(int nx, int rows, double h, const Vector2d& shift) {
  Model m = sheet(nx, 2 * rows + 1, h), out = m;
  out.vertex_particle.clear();
  out.vertex_panel.clear();
  out.vertex_uv.clear();
  out.triangle.clear();
  out.triangle_panel.clear();
  out.panels.clear();
  for (int panel = 0; panel < 2; ++panel) {
    model::PanelRange range;
    range.first_vertex = static_cast<Index>(out.n_vertices());
    range.first_triangle = static_cast<Index>(out.n_triangles());
    for (int j = panel * rows; j <= (panel + 1) * rows; ++j)
      for (int i = 0; i < nx; ++i) {
        out.vertex_particle.push_back(j * nx + i);
        out.vertex_panel.push_back(panel);
        out.vertex_uv.push_back(Vector2d(i * h, j * h) + panel * shift);
      }
    const Index first = range.first_vertex;
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i + 1 < nx; ++i) {
        const Index a = first + j * nx + i;
        out.triangle.push_back({a, a + 1, a + nx + 1});
        out.triangle.push_back({a, a + nx + 1, a + nx});
        out.triangle_panel.insert(out.triangle_panel.end(), {panel, panel});
      }
    range.n_vertices = static_cast<Index>(out.n_vertices()) - range.first_vertex;
    range.n_triangles = static_cast<Index>(out.n_triangles()) - range.first_triangle;
    out.panels.push_back(range);
  }
  return out;
}

double largest_difference(const Positions& a, const Positions& b) {
  REQUIRE(a.size() == b.size());
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, (a[i] - b[i]).norm());
  return worst;
}

}  // namespace

TEST_CASE("linear fields are carried exactly, also beyond the coarse border") {
  const Model coarse = sheet(7, 6, 0.02);
  const Positions on_coarse = mapped(coarse, affine);
  for (const auto& [nx, ny, h] :
       {std::tuple{13, 11, 0.01}, std::tuple{26, 22, 0.005}, std::tuple{18, 15, 0.0075},
        std::tuple{14, 12, 0.0101}, std::tuple{3, 3, 0.05}}) {
    const Model fine = sheet(nx, ny, h);
    CHECK(largest_difference(simulator::prolong(coarse, on_coarse, fine), mapped(fine, affine)) < 1e-12);
  }
}

TEST_CASE("a finer grid of a bent sheet stays near the surface") {
  auto bent = [](const Vector2d& uv, Index) { return Vector3d(uv.x(), uv.y(), 4 * uv.x() * uv.x()); };
  const Model coarse = sheet(11, 11, 0.02), fine = sheet(41, 41, 0.005);
  // Linear interpolation over a cell: at most h^2 / 8 times the second derivative.
  CHECK(largest_difference(simulator::prolong(coarse, mapped(coarse, bent), fine), mapped(fine, bent)) <
        0.02 * 0.02 / 8 * 8 + 1e-12);
}

TEST_CASE("the particles of the coarse grid keep their places") {
  const Model coarse = sheet(6, 7, 0.02);
  Positions x = mapped(coarse, affine);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += 0.01 * Vector3d(i % 3, i % 5, i % 7);
  CHECK(largest_difference(simulator::prolong(coarse, x, coarse), x) < 1e-14);
}

TEST_CASE("merged seams take the mean of their panels and stay closed") {
  const Vector2d shift(3.5, -2);
  const Model coarse = sewn_pair(6, 4, 0.02, shift), fine = sewn_pair(21, 16, 0.005, shift);
  auto map = [&](const Vector2d& uv, Index panel) { return affine(uv - panel * shift); };
  CHECK(largest_difference(simulator::prolong(coarse, mapped(coarse, map), fine), mapped(fine, map)) < 1e-12);
  // A fold along the seam: each panel is linear, the seam is common to both.
  auto folded = [&](const Vector2d& uv, Index panel) {
    const Vector2d p = uv - panel * shift;
    return Vector3d(p.x(), panel ? 0.08 : p.y(), panel ? p.y() - 0.08 : 0);
  };
  CHECK(largest_difference(simulator::prolong(coarse, mapped(coarse, folded), fine), mapped(fine, folded)) <
        1e-12);
}

TEST_CASE("panels of other models do not mix") {
  const Vector2d same_place(0, -0.08);  // both panels cover the same part of the pattern plane
  const Model coarse = sewn_pair(6, 4, 0.02, same_place), fine = sewn_pair(11, 8, 0.01, same_place);
  auto apart = [&](const Vector2d& uv, Index panel) {
    const Vector2d p = uv - panel * same_place;
    return Vector3d(p.x(), 0.08 - std::abs(p.y() - 0.08), panel * (p.y() - 0.08));
  };
  CHECK(largest_difference(simulator::prolong(coarse, mapped(coarse, apart), fine), mapped(fine, apart)) <
        1e-12);
}
