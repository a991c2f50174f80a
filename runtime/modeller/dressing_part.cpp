// Fronts that are drawn edge to edge in one plane, like those of an open jacket, are moved apart.
#include <Eigen/Geometry>
#include <cmath>
#include <set>

#include "runtime/modeller/dressing.hpp"

namespace garment::modeller {
namespace {

using Eigen::Vector3d;
using model::Index;

constexpr double kSamePlane = 2e-3;  // m
constexpr double kSameNormal = 1e-3;
constexpr double kTouch = 5e-3;  // m, between particles of panels that meet
constexpr double kApart = 0.01;  // m, by which each of them moves

struct Flat {
  Vector3d normal, mean = Vector3d::Zero();
  Vector3d low = Vector3d::Constant(1e300), high = Vector3d::Constant(-1e300);
  std::set<Index> particles;
};

bool touch(const model::Model& model, std::size_t a, std::size_t b, const Flat& other,
           const std::vector<Vector3d>& place) {
  const model::PanelRange &ra = model.panels[a], &rb = model.panels[b];
  for (Index v = ra.first_vertex; v < ra.first_vertex + ra.n_vertices; ++v) {
    if (((place[v] - other.low).array() < -kTouch).any() || ((place[v] - other.high).array() > kTouch).any())
      continue;
    for (Index w = rb.first_vertex; w < rb.first_vertex + rb.n_vertices; ++w)
      if ((place[v] - place[w]).norm() < kTouch) return true;
  }
  return false;
}

}  // namespace

void part_panels(const design::Garment& garment, const model::Model& model, std::vector<Vector3d>& place) {
  std::vector<Flat> flats(garment.panels.size());
  for (std::size_t v = 0; v < model.n_vertices(); ++v) {
    Flat& f = flats[model.vertex_panel[v]];
    f.mean += place[v] / model.panels[model.vertex_panel[v]].n_vertices;
    f.low = f.low.cwiseMin(place[v]);
    f.high = f.high.cwiseMax(place[v]);
    f.particles.insert(model.vertex_particle[v]);
  }
  std::vector<Vector3d> move(flats.size(), Vector3d::Zero());
  for (std::size_t a = 0; a < flats.size(); ++a)
    for (std::size_t b = a + 1; b < flats.size(); ++b) {
      const design::Placement &p = garment.panels[a].placement, &q = garment.panels[b].placement;
      if (p.kind != design::Placement::Kind::rigid || q.kind != design::Placement::Kind::rigid) continue;
      Vector3d n = p.rotation.col(2), away = flats[a].mean - flats[b].mean;
      if (n.cross(Vector3d(q.rotation.col(2))).norm() > kSameNormal || std::abs(n.dot(away)) > kSamePlane)
        continue;
      bool sewn = false;
      for (Index i : flats[a].particles) sewn = sewn || flats[b].particles.contains(i);
      away -= n.dot(away) * n;
      if (sewn || away.norm() < kTouch || !touch(model, a, b, flats[b], place)) continue;
      move[a] += kApart * away.normalized();
      move[b] -= kApart * away.normalized();
    }
  for (std::size_t v = 0; v < model.n_vertices(); ++v) place[v] += move[model.vertex_panel[v]];
}

}  // namespace garment::modeller
