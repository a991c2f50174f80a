// Following an arm: sections square to an axis that is taken from the centres of the sections before.
#include <algorithm>
#include <cmath>

#include "runtime/body/anatomy.hpp"

namespace garment::body {
namespace {

constexpr double kBetweenSections = 0.01;  // m, between sections
constexpr double kLookBack = 6;            // sections from which the direction is taken
constexpr double kMaxArea = 0.035;         // m^2, more is no arm
constexpr double kPalm = 1.04;             // girth of a palm against the wrist's, at least
constexpr double kMinArea = 0.0004;        // m^2, less is a finger

struct Seed {
  Vector3d center, axis;
};

Plane square_plane(const Vector3d& center, const Vector3d& axis) {
  Vector3d u = Vector3d(0, 0, 1) - axis.z() * axis;
  u = u.norm() > 0.1 ? Vector3d(u.normalized()) : Vector3d(axis.unitOrthogonal());
  return {center, u, axis.cross(u)};
}

/// Centre of the loop that lies farthest out among those that may be an arm.
std::optional<Vector3d> arm_center(const TriangleMesh& mesh, const Landmarks& marks, const Plane& plane,
                                   int side, double least_x) {
  std::optional<Vector3d> best;
  for (const Loop& loop : slice(mesh, plane)) {
    double area = std::fabs(loop_area(loop));
    if (area < kMinArea || area > kMaxArea) continue;
    Vector3d c = plane.lift(loop_centroid(loop));
    double x = side * (c.x() - marks.center_x);
    if (x < least_x || c.y() < marks.crotch) continue;
    if (!best || x > side * (best->x() - marks.center_x)) best = c;
  }
  return best;
}

/// A first centre and direction: from two horizontal sections below the armpit, or, where the arms are held
/// out, from two upright ones.
std::optional<Seed> find_seed(const TriangleMesh& mesh, const Landmarks& marks, int side) {
  double h = marks.stature;
  auto upper = arm_center(mesh, marks, horizontal(marks.armpit - 0.05 * h), side, 0.9 * marks.reach);
  auto lower = arm_center(mesh, marks, horizontal(marks.armpit - 0.09 * h), side, 0.9 * marks.reach);
  if (!upper || !lower) {
    auto upright = [&](double out) {
      Plane plane{{marks.center_x + side * (marks.reach + out * h), 0, 0}, {0, 1, 0}, {0, 0, 1}};
      return arm_center(mesh, marks, plane, side, marks.reach);
    };
    upper = upright(0.08);
    lower = upright(0.12);
  }
  if (!upper || !lower) return std::nullopt;
  return Seed{*upper, (*lower - *upper).normalized()};
}

/// The section square to the arm near `center`; nothing when no loop lies there.
std::optional<Section> section_near(const TriangleMesh& mesh, const Vector3d& center, const Vector3d& axis) {
  Plane plane = square_plane(center, axis);
  std::optional<Loop> best;
  double best_distance = 0.04;
  for (Loop& loop : slice(mesh, plane)) {
    double distance = loop_centroid(loop).norm();
    if (std::fabs(loop_area(loop)) < kMinArea || distance >= best_distance) continue;
    best_distance = distance;
    best = std::move(loop);
  }
  if (!best) return std::nullopt;
  Vector2d middle = loop_centroid(*best);
  Section section = make_section(plane, convex_hull(std::move(*best)));
  // The axis goes through the flesh, not through the middle of the hull.
  Vector2d shift =
      Vector2d((section.center - plane.origin).dot(plane.u), (section.center - plane.origin).dot(plane.v)) -
      middle;
  section.center = plane.lift(middle);
  for (Vector2d& p : section.hull) p += shift;
  return section;
}

/// Walks from the seed along +axis or -axis; stops where the arm ends or runs into the body.
std::vector<Section> walk(const TriangleMesh& mesh, const Landmarks& marks, const Seed& seed, double sense,
                          double longest) {
  std::vector<Section> sections;
  Vector3d center = seed.center, axis = seed.axis;
  for (double s = 0; s < longest; s += kBetweenSections) {
    std::optional<Section> section = section_near(mesh, center, axis);
    if (!section) break;
    double girth = perimeter(section->hull);
    // Towards the body an arm hardly thickens: where it does, the section has begun to cut the chest.
    bool in_body = std::fabs(section->center.x() - marks.center_x) < 0.9 * marks.reach;
    if (sense < 0 && !sections.empty() && (in_body || girth > 1.2 * perimeter(sections.front().hull))) break;
    sections.push_back(std::move(*section));
    std::size_t n = sections.size();
    if (n > 3) {
      std::size_t back = n - 1 - std::min<std::size_t>(n - 1, static_cast<std::size_t>(kLookBack));
      Vector3d chord = sense * (sections[n - 1].center - sections[back].center);
      if (chord.norm() > 0.5 * kBetweenSections) axis = (axis + 0.5 * chord.normalized()).normalized();
    }
    center = sections.back().center + sense * kBetweenSections * axis;
  }
  return sections;
}

}  // namespace

std::vector<Section> trace_arm(const TriangleMesh& mesh, const Landmarks& marks, int side,
                               std::size_t* biceps, std::size_t* wrist) {
  std::optional<Seed> seed = find_seed(mesh, marks, side);
  if (!seed) return {};
  std::vector<Section> inner = walk(mesh, marks, *seed, -1, 0.2 * marks.stature);
  std::vector<Section> outer = walk(mesh, marks, *seed, +1, 0.5 * marks.stature);
  if (inner.size() < 3 || outer.size() < 20) return {};
  // The last sections before the body are already cut aslant through the armpit.
  inner.resize(inner.size() - 2);
  std::reverse(inner.begin(), inner.end());
  inner.pop_back();  // the seed itself stands first in `outer`
  std::vector<Section> all = std::move(inner);
  all.insert(all.end(), outer.begin(), outer.end());
  std::size_t n = all.size();
  auto girth = [&](std::size_t i) { return perimeter(all[i].hull); };
  *wrist = n * 60 / 100;
  for (std::size_t i = *wrist; i < n * 85 / 100; ++i)
    if (girth(i) < girth(*wrist)) *wrist = i;
  // Beyond a wrist the palm is broader; where nothing is, the arm was cut off at the wrist.
  double palm = 0;
  for (std::size_t i = *wrist; i < n; ++i) palm = std::max(palm, girth(i));
  if (palm < kPalm * girth(*wrist)) *wrist = n - 1;
  // Up to the shoulder joint the arm lies in the body: its first whole section is carried on.
  std::size_t ahead = static_cast<std::size_t>(0.045 * marks.stature / kBetweenSections);
  std::vector<Section> sections(ahead, all.front());
  for (std::size_t k = 0; k < ahead; ++k)
    sections[k].center -= static_cast<double>(ahead - k) * kBetweenSections * all.front().axis;
  sections.insert(sections.end(), all.begin(), all.begin() + static_cast<std::ptrdiff_t>(*wrist) + 1);
  *wrist += ahead;
  *biceps = ahead + (*wrist - ahead) / 8;
  for (std::size_t i = *biceps; i < ahead + (*wrist - ahead) * 35 / 100; ++i)
    if (perimeter(sections[i].hull) > perimeter(sections[*biceps].hull)) *biceps = i;
  return sections;
}

}  // namespace garment::body
