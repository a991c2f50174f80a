#include "runtime/modeller/wrap_curve.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/base/portable_math.hpp"

namespace garment::modeller {
namespace {

using geometry::cross;

constexpr double kPi = 3.14159265358979323846;
constexpr int kDirections = 720;

}  // namespace

std::vector<Vector2d> convex_hull(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(),
            [](const Vector2d& a, const Vector2d& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vector2d> hull(2 * points.size());
  std::size_t k = 0;
  auto add = [&](const Vector2d& p, std::size_t keep) {
    while (k >= keep && cross(hull[k - 1] - hull[k - 2], p - hull[k - 2]) <= 0) --k;
    hull[k++] = p;
  };
  for (const Vector2d& p : points) add(p, 2);
  std::size_t lower = k + 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  hull.resize(k - 1);
  return hull;
}

WrapCurve::WrapCurve(const std::vector<Vector2d>& points, double center_x, double offset) {
  std::vector<Vector2d> all;
  for (const Vector2d& p : points) {
    all.push_back(p);
    all.emplace_back(2 * center_x - p.x(), p.y());
  }
  std::vector<Vector2d> hull = convex_hull(all);
  // The hull grown by a disc: for each direction its support point plus the offset. Directions run from +z towards +x.
  for (int i = 0; i < kDirections; ++i) {
    double angle = 2 * kPi * i / kDirections;
    Vector2d d(portable::sin(angle), portable::cos(angle));
    // Of two support points take the one farther along the walk, so that straight sides are kept.
    double best = -1e300;
    for (const Vector2d& p : hull) best = std::max(best, d.dot(p));
    Vector2d along(d.y(), -d.x()), low = hull.front(), high = hull.front();
    bool found = false;
    for (const Vector2d& p : hull) {
      if (d.dot(p) < best - 1e-9) continue;
      if (!found || along.dot(p) < along.dot(low)) low = p;
      if (!found || along.dot(p) > along.dot(high)) high = p;
      found = true;
    }
    points_.push_back(low + offset * d);
    if ((high - low).norm() > 1e-9) points_.push_back(high + offset * d);
  }
  // Start exactly at the front centre: between the last point with x < centre and the first with x >= centre.
  if (std::abs(points_.front().x() - center_x) > 1e-12) {
    double z = points_.front().y();
    points_.insert(points_.begin(), Vector2d(center_x, z));
    std::erase_if(points_, [&, first = true](const Vector2d& p) mutable {
      bool is_first = first;
      first = false;
      return !is_first && p.x() < center_x && p.y() >= z - 1e-12;
    });
  }
  arc_.push_back(0);
  for (std::size_t i = 1; i <= points_.size(); ++i)
    arc_.push_back(arc_.back() + (points_[i % points_.size()] - points_[i - 1]).norm());
  length_ = arc_.back();
}

Vector2d WrapCurve::at(double s) const {
  s -= std::floor(s / length_) * length_;
  auto next = std::upper_bound(arc_.begin(), arc_.end(), s);
  std::size_t i = std::clamp<std::size_t>(static_cast<std::size_t>(next - arc_.begin()), 1, points_.size()) - 1;
  double span = arc_[i + 1] - arc_[i];
  double t = span > 0 ? (s - arc_[i]) / span : 0;
  return points_[i] + t * (points_[(i + 1) % points_.size()] - points_[i]);
}

Vector2d WrapCurve::normal_at(double s) const {
  double step = length_ / kDirections;
  Vector2d t = (at(s + step) - at(s - step)).normalized();
  return {-t.y(), t.x()};
}

std::vector<Vector2d> torso_points(const body::Body& body, double low, double high) {
  std::vector<Vector2d> points;
  auto torso = body.parts.find("torso");
  if (torso == body.parts.end()) {
    for (const Vector3d& p : body.mesh.vertices)
      if (p.y() >= low - 0.02 && p.y() <= high + 0.02) points.emplace_back(p.x(), p.z());
    return points;
  }
  const body::Section* nearest = nullptr;
  auto gap = [&](const body::Section& s) { return std::max({low - s.center.y(), s.center.y() - high, 0.0}); };
  for (const body::Section& s : torso->second.sections)
    if (!nearest || gap(s) < gap(*nearest)) nearest = &s;
  for (const body::Section& s : torso->second.sections)
    if (gap(s) == 0 || &s == nearest)
      for (const Vector2d& q : s.hull) {
        Vector3d p = s.center + q.x() * s.u + q.y() * s.v;
        points.emplace_back(p.x(), p.z());
      }
  return points;
}

}  // namespace garment::modeller
