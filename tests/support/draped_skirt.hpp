#pragma once
// A made-up drape for tests of writers and pictures: a flared skirt of two panels, with folds, over an
// egg-shaped body.
#include <cmath>

#include "runtime/base/portable_math.hpp"
#include "runtime/body/body.hpp"
#include "runtime/model/model.hpp"

namespace garment::test {

struct DrapedSkirt {
  model::Model model;
  model::State state;
};

/// `around` x `down` cells; the two panels share the particles of the two side seams.
inline DrapedSkirt make_skirt(int around, int down) {
  using model::Index;
  DrapedSkirt out;
  model::Model& m = out.model;
  const double length = 0.6;
  auto particle = [&](int i, int j) { return static_cast<Index>(j * around + i % around); };
  for (int j = 0; j <= down; ++j)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * portable::kPi * i / around, t = static_cast<double>(j) / down;
      const double fold =
          0.045 * t * t * portable::cos(9 * angle + 0.4) + 0.012 * t * portable::cos(4 * angle);
      const double r = 0.135 + 0.12 * portable::sin(1.2 * t) + 0.05 * t + fold;
      out.state.position.emplace_back(1.15 * r * portable::sin(angle), 1.04 - length * t + 0.01 * t * fold,
                                      0.85 * r * portable::cos(angle));
      m.mass.push_back(1e-4);
      m.thickness.push_back(5e-4);
      m.friction.push_back(0.3);
    }
  m.start = out.state.position;
  out.state.velocity.assign(m.n_particles(), model::Vector3d::Zero());
  m.laws = {{{-1, 0, 1}, {-1000, 0, 1000}, {1000, 1000, 1000}}};
  const int half = around / 2;
  for (int panel = 0; panel < 2; ++panel) {
    model::PanelRange range;
    range.name = panel == 0 ? "front" : "back";
    range.first_vertex = static_cast<Index>(m.n_vertices());
    range.first_triangle = static_cast<Index>(m.n_triangles());
    range.color = panel == 0 ? std::array{0.30, 0.38, 0.52} : std::array{0.30, 0.38, 0.52};
    const int first = panel == 0 ? -half / 2 : half / 2;
    auto vertex = [&](int i, int j) { return static_cast<Index>(range.first_vertex + j * (half + 1) + i); };
    for (int j = 0; j <= down; ++j)
      for (int i = 0; i <= half; ++i) {
        m.vertex_particle.push_back(particle((i + first + around) % around, j));
        m.vertex_panel.push_back(panel);
        m.vertex_uv.emplace_back((i - half / 2) * 0.012, (down - j) * length / down);
      }
    for (int j = 0; j < down; ++j)
      for (int i = 0; i < half; ++i) {
        m.triangle.push_back({vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1)});
        m.triangle.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i + 1, j)});
        m.triangle_panel.insert(m.triangle_panel.end(), {panel, panel});
      }
    range.n_vertices = static_cast<Index>(m.n_vertices()) - range.first_vertex;
    range.n_triangles = static_cast<Index>(m.n_triangles()) - range.first_triangle;
    range.area = half * 0.012 * length;
    m.panels.push_back(range);
  }
  for (int side = 0; side < 2; ++side) {
    model::SeamChain seam;
    seam.name = side == 0 ? "side.left" : "side.right";
    for (int j = 0; j <= down; ++j)
      seam.particles.push_back(particle((side == 0 ? half / 2 : around - half / 2), j));
    seam.length = length;
    m.seams.push_back(seam);
  }
  return out;
}

/// An upright egg under the skirt, without a search index: for pictures and mesh files only.
inline body::Body make_egg(int around = 96, int down = 64) {
  body::Body b;
  b.name = "form";
  auto& mesh = b.mesh;
  for (int j = 1; j < down; ++j)
    for (int i = 0; i < around; ++i) {
      const double u = portable::kPi * j / down, a = 2 * portable::kPi * i / around;
      mesh.vertices.emplace_back(0.15 * portable::sin(u) * portable::sin(a), 0.95 + 0.42 * portable::cos(u),
                                 0.11 * portable::sin(u) * portable::cos(a));
    }
  const int top = static_cast<int>(mesh.vertices.size());
  mesh.vertices.emplace_back(0, 1.37, 0);
  mesh.vertices.emplace_back(0, 0.53, 0);
  for (int i = 0; i < around; ++i) {
    const int k = (i + 1) % around, last = (down - 2) * around;
    mesh.triangles.push_back({top, i, k});
    mesh.triangles.push_back({top + 1, last + k, last + i});
    for (int j = 0; j + 2 < down; ++j) {
      const int r = j * around;
      mesh.triangles.push_back({r + i, r + around + i, r + around + k});
      mesh.triangles.push_back({r + i, r + around + k, r + k});
    }
  }
  return b;
}

}  // namespace garment::test
