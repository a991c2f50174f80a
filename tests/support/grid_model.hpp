#pragma once
// A rectangular sheet of cloth made by hand, for tests that need a Model without the modeller.
#include "runtime/model/model.hpp"

namespace garment::test {

inline constexpr double kGravity = 9.80665;  ///< m/s^2, as in model.hpp

enum class SheetPlane {
  vertical,    ///< weft along +x, warp along +y, face towards +z: hangs in the default gravity
  horizontal,  ///< weft along +x, warp along -z, face upwards (+y)
};

/// nx x ny particles at spacing h; particle (i, j), i along weft and j along warp, has id j * nx + i.
struct SheetSpec {
  int nx = 2, ny = 2;       ///< particles, >= 2
  double h = 0.01;          ///< m
  double stretch = 1000;    ///< K of the linear law N = K strain, N/m
  double shear = 50;        ///< G, N/m
  double bend = 1e-5;       ///< B, N m
  double twist = 4e-6;      ///< Ct, N m
  double density = 0.2;     ///< kg/m^2
  double thickness = 5e-4;  ///< m
  double friction = 0.3;
  SheetPlane plane = SheetPlane::vertical;
};

inline model::Index sheet_particle(const SheetSpec& s, int i, int j) { return j * s.nx + i; }

/// N = stretch * strain, both ways.
inline model::TensileLaw linear_law(double stretch) {
  return {{-0.5, 0, 0.5}, {-0.5 * stretch, 0, 0.5 * stretch}, {stretch, stretch, stretch}};
}

/// The flat sheet, at rest without gravity, no holds. Lower left corner at the origin; border springs and
/// bends carry half the width, so the tributary widths sum to the sheet's.
inline model::Model make_sheet(const SheetSpec& s) {
  using model::Index;
  model::Model m;
  const Index nx = s.nx, ny = s.ny;
  auto id = [nx](Index i, Index j) { return j * nx + i; };
  auto share = [](Index k, Index n) { return k == 0 || k == n - 1 ? 0.5 : 1.0; };
  for (Index j = 0; j < ny; ++j)
    for (Index i = 0; i < nx; ++i) {
      const double u = i * s.h, v = j * s.h;
      m.mass.push_back(s.density * s.h * s.h * share(i, nx) * share(j, ny));
      m.start.push_back(s.plane == SheetPlane::vertical ? model::Vector3d(u, v, 0)
                                                        : model::Vector3d(u, 0, -v));
      m.thickness.push_back(s.thickness);
      m.friction.push_back(s.friction);
      m.vertex_particle.push_back(id(i, j));
      m.vertex_panel.push_back(0);
      m.vertex_uv.emplace_back(u, v);
    }
  m.laws = {linear_law(s.stretch), linear_law(s.stretch)};  // warp, weft
  auto add_spring = [&](Index a, Index b, double width, Index law) {
    m.spring.push_back({a, b});
    m.spring_rest.push_back(s.h);
    m.spring_width.push_back(width);
    m.spring_law.push_back(law);
    m.spring_panel.push_back(0);
  };
  auto add_bend = [&](Index a, Index b, Index c, double width) {
    m.bend.push_back({a, b, c});
    m.bend_lengths.emplace_back(s.h, s.h);
    m.bend_width.push_back(width);
    m.bend_rigidity.push_back(s.bend);
  };
  for (Index j = 0; j < ny; ++j)
    for (Index i = 0; i < nx; ++i) {
      if (j + 1 < ny) add_spring(id(i, j), id(i, j + 1), s.h * share(i, nx), 0);
      if (i + 1 < nx) add_spring(id(i, j), id(i + 1, j), s.h * share(j, ny), 1);
      if (j > 0 && j + 1 < ny) add_bend(id(i, j - 1), id(i, j), id(i, j + 1), s.h * share(i, nx));
      if (i > 0 && i + 1 < nx) add_bend(id(i - 1, j), id(i, j), id(i + 1, j), s.h * share(j, ny));
      if (i + 1 == nx || j + 1 == ny) continue;
      m.cell.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
      m.cell_size.emplace_back(s.h, s.h);
      m.cell_shear.push_back(s.shear);
      m.cell_twist.push_back(s.twist);
      m.triangle.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      m.triangle.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
      m.triangle_panel.insert(m.triangle_panel.end(), {0, 0});
    }
  m.fit_begin = {0};
  model::PanelRange panel;
  panel.name = "sheet";
  panel.n_vertices = nx * ny;
  panel.n_triangles = static_cast<Index>(m.triangle.size());
  panel.area = (nx - 1) * (ny - 1) * s.h * s.h;
  panel.mass = s.density * panel.area;
  m.panels.push_back(panel);
  return m;
}

/// Holds one particle where it starts.
inline void hold_point(model::Model& m, model::Index particle) {
  m.hold_particle.push_back(particle);
  m.hold_kind.push_back(model::HoldKind::point);
  m.hold_point.push_back(m.start[particle]);
  m.hold_normal.push_back(model::Vector3d::Zero());
}

/// Holds the weft row j (the top edge is j = ny - 1), the warp column i, or the two upper corners.
inline void hold_row(model::Model& m, const SheetSpec& s, int j) {
  for (int i = 0; i < s.nx; ++i) hold_point(m, sheet_particle(s, i, j));
}
inline void hold_column(model::Model& m, const SheetSpec& s, int i) {
  for (int j = 0; j < s.ny; ++j) hold_point(m, sheet_particle(s, i, j));
}
inline void hold_upper_corners(model::Model& m, const SheetSpec& s) {
  hold_point(m, sheet_particle(s, 0, s.ny - 1));
  hold_point(m, sheet_particle(s, s.nx - 1, s.ny - 1));
}

}  // namespace garment::test
