// Trousers: the legs of the pattern stand where the legs of the body stand, the crotch below the crotch.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/base/portable_math.hpp"
#include "runtime/modeller/dressing.hpp"

namespace garment::modeller {
namespace {

using Eigen::Vector3d;
using model::Index;

constexpr double kCrotchGap = 0.02;  // m, below the crotch of the body
constexpr double kMostAway = 0.3;    // m, of a crotch point from the crotch of the body, up and down
constexpr double kLegGap = 0.01;     // m, that cloth of two legs needs between the thighs
constexpr double kLowestPart = 0.2;  // m, below the crotch; legs that part lower down are not waited for
constexpr double kMostAside = 0.12;  // m, of a crotch point from the middle of the body
constexpr double kOverAnkle = 0.05;   // m, over the ankle's level, where hems begin that are to fall over the foot
constexpr double kTurned = 0.14;     // rad, from which a leg counts as drawn for another pose

/// The four ends that meet at the crotch: panels of the left and of the right, of the front and of the back.
struct Crotch {
  std::vector<bool> leg;   ///< per panel: holds the crotch point
  double height = -1e300;  ///< m, mean of the places of the panels
};

/// The lowest particle that panels of both sides, before and behind the middle, hold together near the body's
/// crotch.
Crotch find_crotch(const design::Garment& garment, const model::Model& model,
                   const std::vector<Vector3d>& place, const Vector3d& middle) {
  std::vector<Vector3d> mean(garment.panels.size(), Vector3d::Zero());
  for (std::size_t v = 0; v < model.n_vertices(); ++v) mean[model.vertex_panel[v]] += place[v];
  for (std::size_t p = 0; p < mean.size(); ++p) mean[p] /= std::max<Index>(model.panels[p].n_vertices, 1);
  std::vector<std::array<int, 4>> held(model.n_particles(), {0, 0, 0, 0});
  std::vector<Vector3d> sum(model.n_particles(), Vector3d::Zero());
  std::vector<int> count(model.n_particles(), 0);
  for (std::size_t v = 0; v < model.n_vertices(); ++v) {
    Index i = model.vertex_particle[v];
    Vector3d d = mean[model.vertex_panel[v]] - middle;
    if (garment.panels[model.vertex_panel[v]].placement.kind == design::Placement::Kind::rigid)
      held[i][(d.x() > 0 ? 1 : 0) + (d.z() > 0 ? 2 : 0)] = 1;
    sum[i] += place[v];
    ++count[i];
  }
  Crotch crotch;
  Index found = -1;
  for (std::size_t i = 0; i < model.n_particles(); ++i) {
    if (held[i][0] + held[i][1] + held[i][2] + held[i][3] < 4) continue;
    Vector3d p = sum[i] / count[i];
    if (std::abs(p.x() - middle.x()) > kMostAside || std::abs(p.y() - middle.y()) > kMostAway) continue;
    if (found >= 0 && p.y() >= crotch.height) continue;
    crotch.height = p.y();
    found = static_cast<Index>(i);
  }
  if (found < 0) return crotch;
  crotch.leg.assign(garment.panels.size(), false);
  for (std::size_t v = 0; v < model.n_vertices(); ++v)
    if (model.vertex_particle[v] == found) crotch.leg[model.vertex_panel[v]] = true;
  return crotch;
}

/// Height below which the legs stand at least kLegGap apart; `fallback` where they never do.
double part_height(const body::Part& left, const body::Part& right, double fallback) {
  for (std::size_t k = 0; k < std::min(left.sections.size(), right.sections.size()); ++k) {
    auto inner = [k](const body::Part& leg, double side) {
      const body::Section& s = leg.sections[k];
      double least = 1e300;
      for (const Eigen::Vector2d& q : s.hull)
        least = std::min(least, side * (s.center + q.x() * s.u + q.y() * s.v).x());
      return side * least;
    };
    if (inner(left, 1) - inner(right, -1) >= kLegGap) return left.sections[k].center.y();
  }
  return fallback;
}

/// Trousers that reach to the floor begin above the feet, pushed together below the knees, and fall over them: drawn where
/// they end, the toes would stick through them.
void lift_hems(const std::vector<bool>& leg, const body::Body& body, const model::Model& model,
               std::vector<Vector3d>& place) {
  auto knee = body.levels.find("knee"), ankle = body.levels.find("ankle");
  if (knee == body.levels.end() || ankle == body.levels.end()) return;
  const double top = knee->second.height, least = ankle->second.height + kOverAnkle;
  double hem = 1e300;
  for (std::size_t v = 0; v < place.size(); ++v)
    if (leg[model.vertex_panel[v]]) hem = std::min(hem, place[v].y());
  if (hem >= least || top - least < 0.05) return;
  const double share = (top - least) / (top - hem);
  for (std::size_t v = 0; v < place.size(); ++v)
    if (leg[model.vertex_panel[v]] && place[v].y() < top) place[v].y() = top - share * (top - place[v].y());
}

/// Angle in the plane (x, y) from the downward direction towards +x.
double slant(const Vector3d& d) { return portable::atan2(d.x(), -d.y()); }

}  // namespace

void follow_legs(const design::Garment& garment, const body::Body& body, const model::Model& model,
                 std::vector<Vector3d>& place) {
  auto left = body.parts.find("leg.left"), right = body.parts.find("leg.right");
  auto level = body.levels.find("crotch");
  if (left == body.parts.end() || right == body.parts.end() || level == body.levels.end()) return;
  if (left->second.sections.size() < 2 || right->second.sections.size() < 2) return;
  Vector3d middle = (left->second.sections.front().center + right->second.sections.front().center) / 2;
  middle.y() = level->second.height;
  Crotch crotch = find_crotch(garment, model, place, middle);
  if (crotch.leg.empty()) return;
  for (std::size_t p = 0; p < garment.panels.size(); ++p) {
    if (!crotch.leg[p]) continue;
    const model::PanelRange& range = model.panels[p];
    Vector3d mean = Vector3d::Zero();
    for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v) mean += place[v];
    mean /= range.n_vertices;
    const auto& sections = (mean.x() > middle.x() ? left : right)->second.sections;
    Vector3d down = garment.panels[p].placement.rotation.col(1);
    if (down.y() > 0) down = -down;
    double turn = slant(sections.back().center - sections.front().center) - slant(down);
    if (std::abs(turn) < kTurned || std::abs(turn) > 1) turn = 0;
    Vector3d pivot(middle.x(), crotch.height, mean.z());
    double c = portable::cos(turn), s = portable::sin(turn);
    for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v) {
      Vector3d d = place[v] - pivot;
      place[v] = pivot + Vector3d(c * d.x() - s * d.y(), s * d.x() + c * d.y(), d.z());
    }
  }
  double target = part_height(left->second, right->second, middle.y() - kCrotchGap);
  target = std::clamp(target, middle.y() - kLowestPart, middle.y() - kCrotchGap);
  double lower = std::max(0.0, find_crotch(garment, model, place, middle).height - target);
  for (std::size_t v = 0; v < model.n_vertices(); ++v)
    if (crotch.leg[model.vertex_panel[v]]) place[v].y() -= lower;
  lift_hems(crotch.leg, body, model, place);
}

}  // namespace garment::modeller
