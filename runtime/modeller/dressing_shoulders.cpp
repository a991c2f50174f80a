// What hangs from the shoulders is lifted onto them.
#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/modeller/dressing.hpp"

namespace garment::modeller {
namespace {

using Eigen::Vector3d;
using model::Index;

constexpr double kWithin = 0.9;         // of the torso's half breadth: farther out, side seams join front and back
constexpr double kOverShoulder = 0.01;  // m, between the body and a shoulder seam
constexpr double kLeastLift = 1e-6;     // m, less is rounding
constexpr double kMostLift = 0.4;       // m

/// Height of the body at (x, z), seen from above; `below` where there is none of it, and never above `most`.
double top_of(const body::TriangleMesh& mesh, double x, double z, double below, double most) {
  double top = below;
  for (const auto& t : mesh.triangles) {
    const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    if (std::max({a.y(), b.y(), c.y()}) <= top) continue;
    const double area = (b.x() - a.x()) * (c.z() - a.z()) - (b.z() - a.z()) * (c.x() - a.x());
    if (area == 0) continue;
    const double u = ((x - a.x()) * (c.z() - a.z()) - (z - a.z()) * (c.x() - a.x())) / area;
    const double v = ((b.x() - a.x()) * (z - a.z()) - (b.z() - a.z()) * (x - a.x())) / area;
    if (u < 0 || v < 0 || u + v > 1) continue;
    const double y = a.y() + u * (b.y() - a.y()) + v * (c.y() - a.y());
    if (y <= most) top = std::max(top, y);
  }
  return top;
}

/// Half the breadth of the torso under the arms, m.
double half_breadth(const body::Body& body) {
  auto torso = body.parts.find("torso");
  auto armpit = body.levels.find("armpit");
  if (torso == body.parts.end() || armpit == body.levels.end()) return 0;
  const body::Section* best = nullptr;
  for (const body::Section& s : torso->second.sections)
    if (!best || std::abs(s.center.y() - armpit->second.height) < std::abs(best->center.y() - armpit->second.height)) best = &s;
  double low = 1e300, high = -1e300;
  if (best)
    for (const Eigen::Vector2d& q : best->hull) {
      const double x = (best->center + q.x() * best->u + q.y() * best->v).x();
      low = std::min(low, x), high = std::max(high, x);
    }
  return best ? (high - low) / 2 : 0;
}

}  // namespace

void lift_to_shoulders(const design::Garment& garment, const body::Body& body, const model::Model& model,
                       std::vector<Vector3d>& place) {
  auto bust = body.levels.find("bust"), neck = body.levels.find("neck");
  auto left = body.parts.find("arm.left"), right = body.parts.find("arm.right");
  if (bust == body.levels.end() || neck == body.levels.end() || left == body.parts.end() || right == body.parts.end()) return;
  const double middle = (left->second.sections.front().center.x() + right->second.sections.front().center.x()) / 2;
  const double reach = kWithin * half_breadth(body);
  std::vector<std::array<bool, 2>> faces(model.n_particles(), {false, false});  // held by a front, by a back
  std::vector<Vector3d> sum(model.n_particles(), Vector3d::Zero());
  std::vector<int> count(model.n_particles(), 0);
  for (std::size_t v = 0; v < model.n_vertices(); ++v) {
    const design::Panel& panel = garment.panels[model.vertex_panel[v]];
    const Index i = model.vertex_particle[v];
    const double facing = panel.placement.rotation(2, 2);
    if (panel.placement.kind != design::Placement::Kind::rigid || is_sleeve(panel) || std::abs(facing) < 0.5) continue;
    faces[i][facing > 0 ? 0 : 1] = true;
    sum[i] += place[v];
    ++count[i];
  }
  double lift = 0;
  for (std::size_t i = 0; i < model.n_particles(); ++i) {
    if (!faces[i][0] || !faces[i][1]) continue;
    const Vector3d p = sum[i] / count[i];
    if (std::abs(p.x() - middle) > reach || p.y() < bust->second.height) continue;
    const double top = top_of(body.mesh, p.x(), p.z(), p.y() - kOverShoulder, neck->second.height + 0.02);
    lift = std::max(lift, top + kOverShoulder - p.y());
  }
  if (lift < kLeastLift || lift > kMostLift) return;
  for (std::size_t v = 0; v < model.n_vertices(); ++v)
    if (garment.panels[model.vertex_panel[v]].placement.kind == design::Placement::Kind::rigid) place[v].y() += lift;
}

}  // namespace garment::modeller
