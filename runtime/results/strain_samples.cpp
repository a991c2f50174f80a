#include "runtime/results/strain_samples.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "runtime/base/portable_math.hpp"

namespace garment::results {
namespace {

using model::Index;
using model::Model;
using model::Vector2d;
using model::Vector3d;

/// Panel in which all four corners have a place; a seam's particles have places in both, the others decide.
Index panel_of_cell(const Model& m, const VertexTable& table, const model::Indices<4>& cell) {
  for (const Index* v = table.begin(cell[0]); v != table.end(cell[0]); ++v) {
    const Index panel = m.vertex_panel[*v];
    if (std::all_of(cell.begin(), cell.end(), [&](Index p) { return table.find(panel, p) >= 0; }))
      return panel;
  }
  return -1;
}

/// Unit warp direction of each panel in its flat coordinates, read off any cell or cut cell; +y where it has
/// neither.
std::vector<Vector2d> warp_directions(const Model& m, const VertexTable& table) {
  std::vector<Vector2d> warp(m.panels.size(), Vector2d(0, 0));
  for (std::size_t c = 0; c < m.cell.size(); ++c) {
    const Index panel = panel_of_cell(m, table, m.cell[c]);
    if (panel < 0 || warp[panel] != Vector2d(0, 0)) continue;
    const auto [a, b] = table.pair(panel, {m.cell[c][0], m.cell[c][3]}, m.cell_size[c][1]);
    warp[panel] = (m.vertex_uv[b] - m.vertex_uv[a]).stableNormalized();
  }
  for (std::size_t k = 0; k < m.membrane.size(); ++k) {
    const Index panel = m.membrane_panel[k];
    if (warp[panel] != Vector2d(0, 0)) continue;
    Vector2d along(0, 0);
    for (int j = 0; j < 3; ++j) {
      const Index v = table.find(panel, m.membrane[k][j]);
      if (v >= 0) along += m.membrane_weights[k][j] * m.vertex_uv[v];
    }
    warp[panel] = along.stableNormalized();
  }
  for (Vector2d& w : warp)
    if (w == Vector2d(0, 0)) w = Vector2d(0, 1);
  return warp;
}

std::array<Vector3d, 2> membrane_axes(const Model& m, const std::vector<Vector3d>& x, std::size_t k) {
  Vector3d U = Vector3d::Zero(), V = Vector3d::Zero();
  for (int j = 0; j < 3; ++j) {
    U += m.membrane_weights[k][j] * x[m.membrane[k][j]];
    V += m.membrane_weights[k][3 + j] * x[m.membrane[k][j]];
  }
  return {U, V};
}

double shear_angle(const Vector3d& a, const Vector3d& b) {
  const double length = a.norm() * b.norm();
  if (!(length > 0)) return 0;
  return std::fabs(portable::asin(std::clamp(a.dot(b) / length, -1.0, 1.0)));
}

}  // namespace

VertexTable::VertexTable(const Model& model)
    : model_(model), begin_(model.n_particles() + 1, 0), vertex_(model.n_vertices()) {
  for (Index p : model.vertex_particle) ++begin_[p + 1];
  for (std::size_t p = 0; p < model.n_particles(); ++p) begin_[p + 1] += begin_[p];
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t v = 0; v < model.n_vertices(); ++v)
    vertex_[next[model.vertex_particle[v]]++] = static_cast<Index>(v);
}

Index VertexTable::find(Index panel, Index particle) const {
  for (const Index* v = begin(particle); v != end(particle); ++v)
    if (model_.vertex_panel[*v] == panel) return *v;
  return -1;
}

std::array<Index, 2> VertexTable::pair(Index panel, const model::Indices<2>& particles, double length) const {
  std::array<Index, 2> best{find(panel, particles[0]), find(panel, particles[1])};
  double least = 1e300;
  for (const Index* a = begin(particles[0]); a != end(particles[0]); ++a)
    for (const Index* b = begin(particles[1]); b != end(particles[1]); ++b) {
      if (model_.vertex_panel[*a] != panel || model_.vertex_panel[*b] != panel) continue;
      const double miss = std::fabs((model_.vertex_uv[*a] - model_.vertex_uv[*b]).norm() - length);
      if (miss < least) {
        least = miss;
        best = {*a, *b};
      }
    }
  return best;
}

std::vector<StrainSample> strain_samples(const Model& m, const model::State& state,
                                         const VertexTable& table) {
  const std::vector<Vector3d>& x = state.position;
  const std::vector<Vector2d> warp = warp_directions(m, table);
  std::vector<StrainSample> samples;
  samples.reserve(m.spring.size() + 2 * m.membrane.size());
  for (std::size_t s = 0; s < m.spring.size(); ++s) {
    StrainSample out;
    out.panel = m.spring_panel[s];
    const auto [a, b] = table.pair(out.panel, m.spring[s], m.spring_rest[s]);
    out.strain = (x[m.spring[s][1]] - x[m.spring[s][0]]).norm() / m.spring_rest[s] - 1;
    out.area = m.spring_rest[s] * m.spring_width[s];
    if (a >= 0 && b >= 0) {
      const Vector2d flat = m.vertex_uv[b] - m.vertex_uv[a];
      const Vector2d& w = warp[out.panel];
      const bool along = std::fabs(flat.dot(w)) >= std::fabs(flat[0] * w[1] - flat[1] * w[0]);
      out.direction = along ? Direction::warp : Direction::weft;
      out.n = 2;
      out.vertex = {a, b, -1};
    }
    samples.push_back(out);
  }
  for (std::size_t k = 0; k < m.membrane.size(); ++k) {
    const std::array<Vector3d, 2> axes = membrane_axes(m, x, k);
    StrainSample out;
    out.panel = m.membrane_panel[k];
    out.area = m.membrane_area[k];
    for (int j = 0; j < 3; ++j) {
      const Index v = table.find(out.panel, m.membrane[k][j]);
      if (v >= 0) out.vertex[out.n++] = v;
    }
    for (Direction d : {Direction::warp, Direction::weft}) {
      out.direction = d;
      out.strain = axes[static_cast<std::size_t>(d)].norm() - 1;
      samples.push_back(out);
    }
  }
  return samples;
}

std::vector<ShearSample> shear_samples(const Model& m, const model::State& state, const VertexTable& table) {
  const std::vector<Vector3d>& x = state.position;
  std::vector<ShearSample> samples;
  samples.reserve(m.cell.size() + m.membrane.size());
  for (const model::Indices<4>& c : m.cell) {
    ShearSample out{panel_of_cell(m, table, c), 0};
    for (int k = 0; k < 4; ++k) {
      const Vector3d &at = x[c[k]], &next = x[c[(k + 1) % 4]], &before = x[c[(k + 3) % 4]];
      out.angle = std::max(out.angle, shear_angle(next - at, before - at));
    }
    samples.push_back(out);
  }
  for (std::size_t k = 0; k < m.membrane.size(); ++k) {
    const std::array<Vector3d, 2> axes = membrane_axes(m, x, k);
    samples.push_back({m.membrane_panel[k], shear_angle(axes[0], axes[1])});
  }
  return samples;
}

}  // namespace garment::results
