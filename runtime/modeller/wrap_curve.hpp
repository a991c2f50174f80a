#pragma once
// The closed curve, seen from above, on which panels are wrapped round a body: a convex girth line standing off the body.
#include <Eigen/Core>
#include <vector>

#include "runtime/body/body.hpp"

namespace garment::modeller {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Convex hull of `points`, counter-clockwise, without collinear points.
std::vector<Vector2d> convex_hull(std::vector<Vector2d> points);

/// Closed convex curve in the plane (x, z), symmetric about x = `center_x`, measured by arc length from its front centre
/// (largest z) towards +x.
class WrapCurve {
 public:
  /// Hull of `points` (x, z), made symmetric, grown by `offset` > 0 all round.
  WrapCurve(const std::vector<Vector2d>& points, double center_x, double offset);
  double length() const { return length_; }
  /// Point (x, z) at arc length s; s may be any number (the curve is periodic).
  Vector2d at(double s) const;
  /// Outward unit normal (x, z) at arc length s.
  Vector2d normal_at(double s) const;

 private:
  std::vector<Vector2d> points_;
  std::vector<double> arc_;
  double length_ = 0;
};

/// Points (x, z) of the horizontal sections of the body's torso between two heights, at least those of the nearest section.
std::vector<Vector2d> torso_points(const body::Body& body, double low, double high);

}  // namespace garment::modeller
