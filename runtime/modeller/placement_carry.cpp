#include "runtime/modeller/placement_carry.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <map>
#include <optional>

namespace garment::modeller {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using model::Index;
using Matrix32 = Eigen::Matrix<double, 3, 2>;

constexpr double kNearer = 1 - 1e-9;  // by which a distance counts as less: the last bits decide nothing

/// A particle that both the new panel and placed ones hold, seen from both.
struct Shared {
  Index here;                 ///< vertex id in the new panel
  std::vector<Index> places;  ///< in the placed panels: several where a seam of theirs ends at the particle
  Index there = -1;           ///< the one of them that the new panel goes on from
};

std::vector<Shared> shared_vertices(const model::Model& model, std::size_t panel, const std::vector<bool>& placed) {
  std::map<Index, std::vector<Index>> placed_vertices;
  for (std::size_t v = 0; v < model.n_vertices(); ++v)
    if (placed[model.vertex_panel[v]]) placed_vertices[model.vertex_particle[v]].push_back(static_cast<Index>(v));
  // In an order that does not depend on that of the panels.
  for (auto& [particle, vertices] : placed_vertices)
    std::sort(vertices.begin(), vertices.end(), [&](Index a, Index b) {
      const Index p = model.vertex_panel[a], q = model.vertex_panel[b];
      return p != q ? model.panels[p].name < model.panels[q].name : a < b;
    });
  std::vector<Shared> shared;
  const model::PanelRange& range = model.panels[panel];
  for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v)
    if (auto it = placed_vertices.find(model.vertex_particle[v]); it != placed_vertices.end())
      shared.push_back({v, it->second, it->second.front()});
  return shared;
}

/// Mean gradient of place over uv in the triangles round each vertex of the placed panels.
std::map<Index, Matrix32> gradients_at(const model::Model& model, const std::vector<Shared>& shared,
                                       const std::vector<Vector3d>& place) {
  std::map<Index, Matrix32> sum;
  for (const Shared& s : shared)
    for (Index v : s.places) sum.emplace(v, Matrix32::Zero());
  for (const auto& t : model.triangle) {
    Matrix2d flat;
    Matrix32 space;
    flat << model.vertex_uv[t[1]] - model.vertex_uv[t[0]], model.vertex_uv[t[2]] - model.vertex_uv[t[0]];
    space << place[t[1]] - place[t[0]], place[t[2]] - place[t[0]];
    double area = flat.determinant();
    if (area <= 0) continue;
    Matrix32 gradient = space * flat.inverse() * area;
    for (Index v : t)
      if (auto it = sum.find(v); it != sum.end()) it->second += gradient;
  }
  for (auto& [v, g] : sum) {  // nearest frame with unit, square columns
    Vector3d a = g.col(0), b = g.col(1);
    if (a.norm() < 1e-12 || b.norm() < 1e-12) continue;
    a.normalize();
    b = (b - b.dot(a) * a);
    if (b.norm() < 1e-12) continue;
    g.col(0) = a;
    g.col(1) = b.normalized();
  }
  return sum;
}

/// Rotation of the plane that turns direction a into direction b.
Matrix2d rotation_between(const Vector2d& a, const Vector2d& b) {
  Vector2d p = a.normalized(), q = b.normalized();
  double c = p.dot(q), s = p.x() * q.y() - p.y() * q.x();
  Matrix2d r;
  r << c, -s, s, c;
  return r;
}

}  // namespace

std::size_t count_shared_particles(const model::Model& model, std::size_t panel, const std::vector<bool>& placed) {
  return shared_vertices(model, panel, placed).size();
}

void carry_panel(const model::Model& model, std::size_t panel, const std::vector<Vector3d>& flat, const std::vector<bool>& placed,
                 std::vector<Vector3d>& place) {
  auto flat_at = [&](Index v) -> Vector2d { return flat[v].head<2>(); };
  std::vector<Shared> shared = shared_vertices(model, panel, placed);
  std::map<Index, Matrix32> gradient = gradients_at(model, shared, place);
  // The seam's direction at each shared particle, from the nearest other shared particle of the same placed panel. Where a
  // tube's own seam ends, the particle lies at both ends of the flat panel: the place next to the neighbour's is meant.
  std::vector<Matrix2d> turn(shared.size(), Matrix2d::Identity());
  for (std::size_t i = 0; i < shared.size(); ++i) {
    double nearest = 1e300;
    for (std::size_t j = 0; j < shared.size(); ++j) {
      if (j == i) continue;
      const Vector2d here = flat_at(shared[j].here) - flat_at(shared[i].here);
      if (here.norm() >= kNearer * nearest || here.norm() < 1e-9) continue;
      double shortest = 1e300;
      for (Index a : shared[i].places)
        for (Index b : shared[j].places) {
          if (model.vertex_panel[a] != model.vertex_panel[b]) continue;
          const Vector2d there = model.vertex_uv[b] - model.vertex_uv[a];
          if (there.norm() >= kNearer * shortest || there.norm() < 1e-9) continue;
          shortest = there.norm();
          nearest = here.norm();
          shared[i].there = a;
          turn[i] = rotation_between(here, there);
        }
    }
  }
  const model::PanelRange& range = model.panels[panel];
  for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < shared.size(); ++i)
      if ((flat_at(v) - flat_at(shared[i].here)).norm() < kNearer * (flat_at(v) - flat_at(shared[best].here)).norm())
        best = i;
    Vector2d off = turn[best] * (flat_at(v) - flat_at(shared[best].here));
    const Matrix32& plane = gradient[shared[best].there];
    place[v] = place[shared[best].there] + plane * off;
    if (flat[v].z() != 0) place[v] += flat[v].z() * plane.col(0).cross(plane.col(1));
  }
}

}  // namespace garment::modeller
