#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/body/anatomy.hpp"

namespace garment::body {
namespace {

constexpr double kScanStep = 0.005;  // m, of the scans
constexpr double kMinLeg = 0.0015;   // m^2, area below which a section is no leg
constexpr double kLeastMeshStature = 0.7, kMostMeshStature = 2.6;

struct LegPair {
  double left = 0, right = 0;  // x of their centroids
};

/// The two largest loops, if they lie on both sides of `center_x` and are alike.
std::optional<LegPair> legs_at(const TriangleMesh& mesh, double y) {
  std::vector<Loop> loops = slice(mesh, horizontal(y));
  if (loops.size() < 2) return std::nullopt;
  double a = std::fabs(loop_area(loops[0])), b = std::fabs(loop_area(loops[1]));
  double xa = loop_centroid(loops[0]).x(), xb = loop_centroid(loops[1]).x();
  if (b < kMinLeg || a > 2 * b) return std::nullopt;
  return LegPair{std::max(xa, xb), std::min(xa, xb)};
}

/// The loop of the trunk at height y: the largest that reaches over the plane of symmetry.
std::optional<Loop> trunk_at(const TriangleMesh& mesh, double center_x, double y) {
  for (Loop& loop : slice(mesh, horizontal(y)))
    if (loop_low(loop).x() < center_x - 0.015 && loop_high(loop).x() > center_x + 0.015)
      return std::move(loop);
  return std::nullopt;
}

double half_breadth(const Loop& loop, double center_x) {
  return std::max(loop_high(loop).x() - center_x, center_x - loop_low(loop).x());
}

/// An arm that hangs close to the trunk grows into it by little and little: the armpit is where its own loop ends, going up.
bool find_hanging_arms(const TriangleMesh& mesh, Landmarks& marks, double low, double high) {
  constexpr double kLeastArm = 0.0015, kMostArm = 0.02;  // m^2
  for (double y = high; y > low; y -= kScanStep) {
    const std::optional<Loop> trunk = trunk_at(mesh, marks.center_x, y);
    if (!trunk) continue;
    const double half = half_breadth(*trunk, marks.center_x);
    bool arm[2] = {false, false};
    for (const Loop& loop : slice(mesh, horizontal(y))) {
      const double x = loop_centroid(loop).x() - marks.center_x, area = std::fabs(loop_area(loop));
      if (area > kLeastArm && area < kMostArm && std::fabs(x) > 0.9 * half) arm[x > 0] = true;
    }
    if (!arm[0] || !arm[1]) continue;
    marks.armpit = y;
    marks.reach = half;
    return true;
  }
  return false;
}

/// First height, going up, where the trunk's loop takes the arms in: it grows by an arm on both sides.
void find_armpit(const TriangleMesh& mesh, Landmarks& marks) {
  constexpr double kStep1 = 0.01, kJump = 0.04;
  double low = marks.height(0.62), high = marks.height(0.86);
  std::optional<Loop> before = trunk_at(mesh, marks.center_x, low);
  for (double y = low + kStep1; before && y < high; y += kStep1) {
    std::optional<Loop> here = trunk_at(mesh, marks.center_x, y);
    if (!here) break;
    double grown_left = loop_high(*here).x() - loop_high(*before).x();
    double grown_right = loop_low(*before).x() - loop_low(*here).x();
    if (std::max(grown_left, grown_right) > kJump) {
      marks.armpit = y - kStep1;
      marks.reach = half_breadth(*before, marks.center_x);
      // Under an arm held out the section widens softly: the chest below says how much of it is torso.
      if (auto chest = trunk_at(mesh, marks.center_x, marks.armpit - 0.04 * marks.stature))
        marks.reach = std::min(marks.reach, 1.08 * half_breadth(*chest, marks.center_x));
      return;
    }
    before = std::move(here);
  }
  if (find_hanging_arms(mesh, marks, low, high)) return;
  // No arms (a dress form): the usual place of the armpit, and the broadest of what is above it.
  marks.armpit = marks.height(0.76);
  for (double y = marks.armpit; y < high; y += kStep1)
    if (auto loop = trunk_at(mesh, marks.center_x, y))
      marks.reach = std::max(marks.reach, half_breadth(*loop, marks.center_x));
}

}  // namespace

std::optional<Landmarks> find_landmarks(const TriangleMesh& mesh, std::optional<double> stature, Lacking* lacking) {
  auto none = [&](Lacking what) -> std::optional<Landmarks> {
    if (lacking != nullptr) *lacking = what;
    return std::nullopt;
  };
  if (mesh.vertices.empty()) return none(Lacking::stature);
  Landmarks marks;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vector3d& p : mesh.vertices) low = std::min(low, p.y()), high = std::max(high, p.y());
  marks.base = low;
  marks.top = high;
  marks.stature = stature.value_or(high - low);
  if (!(marks.stature >= kLeastMeshStature && marks.stature <= kMostMeshStature)) return none(Lacking::stature);
  std::optional<LegPair> legs = legs_at(mesh, marks.height(0.30));
  if (!legs || legs->left - legs->right < 0.03 * marks.stature) return none(Lacking::legs);
  marks.center_x = 0.5 * (legs->left + legs->right);
  for (double y = marks.height(0.36); y < marks.height(0.60); y += kScanStep) {
    std::optional<Loop> trunk = trunk_at(mesh, marks.center_x, y);
    if (trunk && std::fabs(loop_centroid(*trunk).x() - marks.center_x) < 0.03 * marks.stature) {
      marks.crotch = y;
      break;
    }
  }
  if (marks.crotch == 0) return none(Lacking::crotch);
  if (!trunk_at(mesh, marks.center_x, marks.height(0.64))) return none(Lacking::torso);
  find_armpit(mesh, marks);
  if (lacking != nullptr) *lacking = Lacking::nothing;
  return marks;
}

Loop torso_hull(const TriangleMesh& mesh, const Landmarks& marks, double y) {
  std::optional<Loop> trunk = trunk_at(mesh, marks.center_x, y);
  if (!trunk) return {};
  if (y <= marks.armpit) return convex_hull(std::move(*trunk));
  return convex_hull(clip_x(*trunk, marks.center_x - marks.reach, marks.center_x + marks.reach));
}

Loop leg_hull(const TriangleMesh& mesh, const Landmarks& marks, double y, int side) {
  for (Loop& loop : slice(mesh, horizontal(y))) {
    double x = side * (loop_centroid(loop).x() - marks.center_x);
    if (x > 0 && x < 0.2 * marks.stature) return convex_hull(std::move(loop));
  }
  return {};
}

Section make_section(const Plane& plane, const Loop& loop) {
  Vector2d center = loop_centroid(loop);
  Section section{plane.lift(center), plane.normal(), plane.u, plane.v, loop};
  for (Vector2d& p : section.hull) p -= center;
  return section;
}

}  // namespace garment::body
