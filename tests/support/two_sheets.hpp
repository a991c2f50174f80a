#pragma once
// Two sheets in one Model, each a panel of its own.
#include "tests/support/grid_model.hpp"

namespace garment::test {

/// `b` behind `a`: particles, vertices and panels of b follow those of a. Springs, cells and bends only.
inline model::Model together(model::Model a, const model::Model& b) {
  using model::Index;
  const auto particles = static_cast<Index>(a.n_particles()), vertices = static_cast<Index>(a.n_vertices()),
             panels = static_cast<Index>(a.panels.size()), laws = static_cast<Index>(a.laws.size()),
             triangles = static_cast<Index>(a.n_triangles());
  auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  auto shifted = [](auto& to, const auto& from, Index by) {
    for (auto row : from) {
      if constexpr (std::is_same_v<decltype(row), Index>)
        row += by;
      else
        for (Index& i : row) i += by;
      to.push_back(row);
    }
  };
  append(a.mass, b.mass);
  append(a.start, b.start);
  append(a.thickness, b.thickness);
  append(a.friction, b.friction);
  shifted(a.vertex_particle, b.vertex_particle, particles);
  shifted(a.vertex_panel, b.vertex_panel, panels);
  append(a.vertex_uv, b.vertex_uv);
  shifted(a.triangle, b.triangle, vertices);
  shifted(a.triangle_panel, b.triangle_panel, panels);
  shifted(a.spring, b.spring, particles);
  append(a.spring_rest, b.spring_rest);
  append(a.spring_width, b.spring_width);
  shifted(a.spring_law, b.spring_law, laws);
  shifted(a.spring_panel, b.spring_panel, panels);
  shifted(a.cell, b.cell, particles);
  append(a.cell_size, b.cell_size);
  append(a.cell_shear, b.cell_shear);
  append(a.cell_twist, b.cell_twist);
  shifted(a.bend, b.bend, particles);
  append(a.bend_lengths, b.bend_lengths);
  append(a.bend_width, b.bend_width);
  append(a.bend_rigidity, b.bend_rigidity);
  shifted(a.hold_particle, b.hold_particle, particles);
  append(a.hold_kind, b.hold_kind);
  append(a.hold_point, b.hold_point);
  append(a.hold_normal, b.hold_normal);
  append(a.laws, b.laws);
  for (model::PanelRange p : b.panels) {
    p.first_vertex += vertices;
    p.first_triangle += triangles;
    a.panels.push_back(p);
  }
  return a;
}

}  // namespace garment::test
