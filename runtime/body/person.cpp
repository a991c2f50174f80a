#include "runtime/body/person.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace garment::body {
namespace {

using Kind = PersonMeasure::Kind;

/// Share of the way from shoulder point to wrist at which the elbow lies (ANSUR II: acromion-radiale over
/// sleeve outseam).
constexpr double kElbow = 0.575;
/// How far the nape (the seventh cervical vertebra) lies below the narrowest place of the neck, of stature.
constexpr double kNape = 0.014;
constexpr const char* kTorsoLevels[] = {"head",      "neck",  "shoulder", "armpit", "bust",
                                        "underbust", "waist", "hip",      "crotch"};
constexpr const char* kLegLevels[] = {"thigh", "knee", "calf", "ankle"};

double way_length(const std::vector<Vector3d>& way) {
  double sum = 0;
  for (std::size_t k = 1; k < way.size(); ++k) sum += (way[k] - way[k - 1]).norm();
  return sum;
}

class Measurer {
 public:
  Measurer(const TriangleMesh& mesh, const Landmarks& marks, bool head)
      : mesh_(mesh),
        marks_(marks),
        head_(head),
        parts_(find_parts(mesh, marks)),
        levels_(find_levels(mesh, marks, parts_)) {}

  std::vector<PersonMeasure> run() {
    for (const char* name : kTorsoLevels)
      if (head_ || std::string(name) != "head") level(name, torso_hull(mesh_, marks_, at(name)));
    const int leg = leg_hull(mesh_, marks_, at("thigh"), +1).empty() ? -1 : +1;
    for (const char* name : kLegLevels) level(name, leg_hull(mesh_, marks_, at(name), leg));
    if (head_)
      length("stature",
             {{marks_.center_x, marks_.base, 0}, {marks_.center_x, marks_.base + marks_.stature, 0}});
    arm();
    back();
    for (const char* name : {"bust", "waist", "hip"}) breadth_and_depth(name);
    length("crotch_height", {{marks_.center_x, marks_.base, 0}, {marks_.center_x, marks_.crotch, 0}});
    return std::move(out_);
  }

 private:
  double at(const std::string& name) const {
    const auto found = levels_.find(name);
    return found == levels_.end() ? marks_.base - 1 : found->second.height;
  }

  void ring(const std::string& name, const Plane& plane, const Loop& hull, double height) {
    PersonMeasure m{name, Kind::level, height - marks_.base, perimeter(hull), {}};
    for (const Vector2d& p : hull) m.course.push_back(plane.lift(p));
    out_.push_back(std::move(m));
  }
  void level(const std::string& name, const Loop& hull) {
    if (hull.size() >= 3) ring(name, horizontal(at(name)), hull, at(name));
  }
  void arm_ring(const std::string& name, const Section& s) {
    ring(name, {s.center, s.u, s.v}, s.hull, s.center.y());
  }
  void length(const std::string& name, std::vector<Vector3d> way) {
    const double size = way_length(way);
    if (size > 0) out_.push_back({name, Kind::length, std::nullopt, size, std::move(way)});
  }

  /// Height of the skin over (x, z), between armpit and neck; nothing beside the body.
  std::optional<double> skin_over(double x, double z) const {
    std::optional<double> top;
    for (const Loop& loop : slice(mesh_, {{x, 0, 0}, {0, 1, 0}, {0, 0, 1}}))
      for (const Vector2d& p : loop)
        if (std::fabs(p.y() - z) < 0.05 * marks_.stature && p.x() < marks_.height(0.86) &&
            p.x() > marks_.armpit)
          top = std::max(top.value_or(p.x()), p.x());
    return top;
  }

  struct Shoulder {
    Vector3d joint;  ///< on the axis of the arm
    Vector3d point;  ///< on the skin over it
    bool found;      ///< by its depth
  };
  /// The head of the arm bone lies on the arm's axis, 0.85 radii of the upper arm and a hundredth of the
  /// stature under the skin. An arm held out level has no such place: there it is where the first section
  /// clear of the trunk is carried on to.
  std::optional<Shoulder> shoulder(const std::vector<Section>& sections, std::size_t biceps) const {
    const Section& from = sections[biceps];
    const double depth = 0.85 * perimeter(from.hull) / 6.2832 + 0.0107 * marks_.stature;
    const Vector3d up = -sections.front().axis;
    Vector3d joint = sections.front().center;
    bool found = false;
    constexpr double kStep = 0.004, kUpright = 0.7;
    double before = 0;  // what was missing one step before
    for (double s = 0; up.y() > kUpright && s < 0.2 * marks_.stature; s += kStep) {
      const Vector3d p = from.center + s * up;
      if (p.y() < marks_.armpit) continue;
      const std::optional<double> top = skin_over(p.x(), p.z());
      if (!top) continue;
      const double missing = *top - p.y() - depth;
      if (missing > 0) {
        before = missing;
        continue;
      }
      joint = p - (before > 0 ? -missing / (before - missing) * kStep : 0) * up;
      found = true;
      break;
    }
    if (const auto top = skin_over(joint.x(), joint.z()))
      return Shoulder{joint, {joint.x(), *top, joint.z()}, found};
    return std::nullopt;
  }

  void arm() {
    std::optional<Shoulder> shoulders[2];
    std::vector<Section> sections;
    std::size_t biceps = 0, wrist = 0;
    int side = 0;
    for (int s : {-1, +1}) {
      std::size_t thickest = 0, thinnest = 0;
      std::vector<Section> traced = trace_arm(mesh_, marks_, s, &thickest, &thinnest);
      if (traced.empty()) continue;
      shoulders[s > 0] = shoulder(traced, thickest);
      sections = std::move(traced), biceps = thickest, wrist = thinnest, side = s;
    }
    if (side == 0) return;
    // The arm stays as thin as at the wrist for some way into the hand: the tape lies where that begins.
    for (std::size_t k = biceps; k < wrist; ++k)
      if (perimeter(sections[k].hull) < 1.015 * perimeter(sections[wrist].hull)) wrist = k;
    const std::optional<Shoulder>& from = shoulders[side > 0];
    // The tape lies on the outside of the arm; the axis from a hundredth of the stature above the joint is as
    // long.
    std::vector<Vector3d> way;
    double clear = 0.005;
    if (from && from->found)
      way = {from->joint - 0.012 * marks_.stature * sections.front().axis, from->joint};
    if (from && !from->found) way = {from->point}, clear = 0.045;
    for (std::size_t k = 0; k <= wrist; ++k)
      if (!from || (sections[k].center - from->joint).dot(sections[k].axis) > clear)
        way.push_back(sections[k].center);
    const std::size_t before =
        way.size() - (wrist + 1);  // wraps where sections before the joint were left out; only compared
    const double whole = way_length(way);
    double walked = 0;
    std::size_t elbow_way = 0;
    while (elbow_way + 1 < way.size() && walked < kElbow * whole) {
      walked += (way[elbow_way + 1] - way[elbow_way]).norm();
      ++elbow_way;
    }
    const std::size_t elbow = elbow_way - before;
    arm_ring("biceps", sections[biceps]);
    arm_ring("elbow", sections[std::min(elbow, wrist)]);
    arm_ring("wrist", sections[wrist]);
    if (shoulders[0] && shoulders[1]) {
      const Vector3d &left = shoulders[1]->point, &right = shoulders[0]->point;
      PersonMeasure across{
          "shoulder_breadth", Kind::length, std::nullopt, left.x() - right.x(), {left, right}};
      out_.push_back(std::move(across));
    }
    if (!from) return;
    neck_to(from->point, side);
    length("sleeve_length", way);
    way.resize(elbow_way + 1);
    length("upper_arm_length", way);
  }

  void neck_to(const Vector3d& shoulder, int side) {
    const Loop neck = torso_hull(mesh_, marks_, at("neck"));
    if (neck.empty()) return;
    // The neck spreads into the shoulder: its side at the root is a quarter farther out than at its
    // narrowest.
    const double x = 1.25 * (side > 0 ? loop_high(neck) : loop_low(neck)).x() - 0.25 * marks_.center_x;
    // The skin over the shoulder in the upright plane from neck to shoulder point.
    std::vector<Vector3d> way;
    constexpr int kSteps = 12;
    for (int k = 0; k <= kSteps; ++k) {
      const double share = static_cast<double>(k) / kSteps;
      const Plane upright{{x + share * (shoulder.x() - x), 0, 0}, {0, 1, 0}, {0, 0, 1}};
      std::optional<double> top;
      for (const Loop& loop : slice(mesh_, upright))
        for (const Vector2d& p : loop)
          if (std::fabs(p.y() - shoulder.z()) < 0.05 * marks_.stature && p.x() > marks_.armpit &&
              p.x() < at("neck"))
            top = std::max(top.value_or(p.x()), p.x());
      if (top) way.push_back({upright.origin.x(), *top, shoulder.z()});
    }
    length("shoulder_length", std::move(way));
  }

  /// The back in the plane of symmetry, from the nape to the waist.
  void back() {
    const Plane middle{{marks_.center_x, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    constexpr double kStep = 0.005;
    std::vector<Vector2d> outline;  // (y, z), from the waist upwards
    const std::vector<Loop> loops = slice(mesh_, middle);
    for (double y = at("waist"); y < at("neck") + 0.02 * marks_.stature; y += kStep) {
      std::optional<double> z;
      for (const Loop& loop : loops)
        for (std::size_t k = 0; k < loop.size(); ++k) {
          const Vector2d &a = loop[k], &b = loop[(k + 1) % loop.size()];
          if ((a.x() <= y) == (b.x() <= y)) continue;
          const double here = a.y() + (y - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
          z = std::min(z.value_or(here), here);
        }
      if (z) outline.push_back({y, *z});
    }
    if (outline.size() < 20) return;
    const double nape = at("neck") - kNape * marks_.stature;
    auto first_above =
        std::find_if(outline.begin(), outline.end(), [&](const Vector2d& p) { return p.x() > nape; });
    std::vector<Vector3d> way;
    for (auto p = first_above; p != outline.begin();) {
      --p;
      way.push_back({marks_.center_x, p->x(), p->y()});
    }
    length("back_length", std::move(way));
  }

  void breadth_and_depth(const std::string& name) {
    const Loop hull = torso_hull(mesh_, marks_, at(name));
    if (hull.size() < 3) return;
    const Vector2d low = loop_low(hull), high = loop_high(hull);
    const double y = at(name), z = -loop_centroid(hull).y();
    length(name + "_breadth", {{low.x(), y, z}, {high.x(), y, z}});
    length(name + "_depth", {{marks_.center_x, y, -low.y()}, {marks_.center_x, y, -high.y()}});
  }

  const TriangleMesh& mesh_;
  const Landmarks& marks_;
  bool head_;
  std::map<std::string, Part> parts_;
  std::map<std::string, Level> levels_;
  std::vector<PersonMeasure> out_;
};

}  // namespace

std::vector<PersonMeasure> measure_person(const TriangleMesh& mesh, const Landmarks& marks, bool head) {
  return Measurer(mesh, marks, head).run();
}

}  // namespace garment::body
