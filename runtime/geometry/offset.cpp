#include "runtime/geometry/offset.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/geometry/crossings.hpp"

namespace garment::geometry {
namespace {

constexpr double kTolerance = 1e-6;  // m
constexpr double kMeets = 1e-7;      // m
constexpr int kMaxDepth = 10;

Point2 left_of(const Point2& t) { return {-t.y(), t.x()}; }

class BezierOffset {
 public:
  BezierOffset(const Curve& curve, double distance) : curve_(curve), d_(distance) {}

  /// Links of the offset curve; false where it folds back on itself, at `at`.
  bool make(std::vector<Curve>& links, double& at) {
    const double length = curve_.length();
    constexpr int kParts = 8;  // the folds of a cubic are found by looking at its parts
    for (int k = 0; k < kParts; ++k)
      if (!add(length * k / kParts, length * (k + 1) / kParts, 0, links)) {
        at = failed_;
        return false;
      }
    return true;
  }

 private:
  Point2 beside(double s) const { return curve_.point_at(s) + d_ * left_of(curve_.tangent_at(s)); }

  //   Handles of chord / (3 cos^2(turn / 4)): exact for an arc of a circle.
  bool add(double s0, double s1, int depth, std::vector<Curve>& links) {
    const Point2 a = beside(s0), b = beside(s1), t0 = curve_.tangent_at(s0), t1 = curve_.tangent_at(s1);
    const Point2 chord = b - a, way = curve_.point_at(s1) - curve_.point_at(s0);
    if (chord.dot(way) <= 0 || chord.dot(t0) <= 0 || chord.dot(t1) <= 0) {
      if (depth >= 3 || t0.dot(t1) > 0.9) {
        failed_ = 0.5 * (s0 + s1);
        return false;
      }
    } else {
      const double cosine = std::clamp(t0.dot(t1), -1.0, 1.0), half = std::sqrt((1 + cosine) / 2),
                   quarter = (1 + half) / 2;  // cos of the turn, of half of it, cos^2 of a quarter
      const double handle = chord.norm() / (3 * quarter);
      const Curve link(a, b, Cubic{a + handle * t0, b - handle * t1});
      if (depth >= kMaxDepth || fits(link, s0, s1)) {
        links.push_back(link);
        return true;
      }
    }
    const double middle = 0.5 * (s0 + s1);
    return add(s0, middle, depth + 1, links) && add(middle, s1, depth + 1, links);
  }

  bool fits(const Curve& link, double s0, double s1) const {
    for (double way : {0.2, 0.5, 0.8}) {
      const Point2 q = link.point_at(way * link.length());
      double s = s0 + way * (s1 - s0);
      for (int round = 0; round < 4; ++round)
        s = std::clamp(s + (q - curve_.point_at(s)).dot(curve_.tangent_at(s)), s0, s1);
      if (std::fabs((q - curve_.point_at(s)).dot(left_of(curve_.tangent_at(s))) - d_) > kTolerance) return false;
    }
    return true;
  }

  const Curve& curve_;
  double d_;
  double failed_ = 0;
};

bool offset_element(const Curve& element, double d, std::vector<Curve>& links, double& at) {
  const Point2 a = element.start() + d * left_of(element.tangent_at(0)),
               b = element.end() + d * left_of(element.tangent_at(element.length()));
  if (std::holds_alternative<Line>(element.shape())) {
    links.push_back(Curve(a, b));
    return true;
  }
  if (const auto* arc = std::get_if<Arc>(&element.shape())) {
    const double chord = (element.end() - element.start()).norm(), half = chord / 2;
    if (arc->bulge == 0) {
      links.push_back(Curve(a, b));
      return true;
    }
    const double bulge = std::fabs(arc->bulge), radius = (half * half + bulge * bulge) / (2 * bulge);
    const double outward = arc->bulge > 0 ? d : -d;  // the centre lies on the other side
    if (radius + outward < kTolerance) {
      at = element.length() / 2;
      return false;
    }
    links.push_back(Curve(a, b, Arc{arc->bulge * (radius + outward) / radius}));
    return true;
  }
  return BezierOffset(element, d).make(links, at);
}

/// Joins `next` to what is there. False where the corner cannot be filled.
bool join(std::vector<Curve>& links, Curve next) {
  if (links.empty() || (links.back().end() - next.start()).norm() <= kMeets) {
    links.push_back(std::move(next));
    return true;
  }
  const Curve last = links.back();
  const Crossings met = crossings_of(last, next);
  if (!met.found.empty()) {
    links.back() = last.part(0, met.found.back().on_a);
    links.push_back(next.part(met.found.back().on_b, next.length()));
    return true;
  }
  const Point2 p = last.end(), q = next.start(), u = last.tangent_at(last.length()), v = next.tangent_at(0);
  const double det = cross(u, v);
  if (std::fabs(det) < 1e-3) return false;
  const double along = cross(q - p, v) / det, back = cross(q - p, u) / det;
  if (!(along > 0 && back < 0)) return false;
  const Point2 corner = p + along * u;
  links.push_back(Curve(p, corner));
  links.push_back(Curve(corner, q));
  links.push_back(std::move(next));
  return true;
}

}  // namespace

OffsetResult offset_curve(const Curve& curve, double distance) {
  std::vector<Curve> links;
  double done = 0;
  for (const Curve& element : curve.elements()) {
    if (!(element.length() > 0)) continue;
    std::vector<Curve> beside;
    double at = 0;
    if (!offset_element(element, distance, beside, at)) return {std::nullopt, done + at, true};
    for (Curve& link : beside)
      if (!join(links, std::move(link))) return {std::nullopt, done, false};
    done += element.length();
  }
  std::erase_if(links, [](const Curve& link) { return !(link.length() > 0); });
  if (links.empty()) return {std::nullopt, 0, true};
  return {chain(links), 0, false};
}

Curve prolonged(const Curve& curve, double before, double after) {
  std::vector<Curve> links;
  if (before > 0) links.push_back(Curve(curve.start() - before * curve.tangent_at(0), curve.start()));
  links.push_back(curve);
  if (after > 0) links.push_back(Curve(curve.end(), curve.end() + after * curve.tangent_at(curve.length())));
  // A straight line prolonged is one straight line.
  if (std::holds_alternative<Line>(curve.shape())) return Curve(links.front().start(), links.back().end());
  return chain(links);
}

}  // namespace garment::geometry
