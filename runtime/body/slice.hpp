#pragma once
// Plane sections of a body and their convex hulls: what a tape measure sees.
#include <vector>

#include "runtime/body/body.hpp"

namespace garment::body {

using Eigen::Vector2d;

/// Plane through `origin` spanned by the unit vectors u and v; its normal is u x v.
struct Plane {
  Vector3d origin, u, v;
  Vector3d normal() const { return u.cross(v); }
  Vector3d lift(const Vector2d& q) const { return origin + q.x() * u + q.y() * v; }
};

/// Horizontal plane at height y with u = +x, v = -z, so that the normal is +y.
Plane horizontal(double y);

/// One closed curve of a section, in (u, v) of its plane, counter-clockwise where it bounds solid from
/// outside.
using Loop = std::vector<Vector2d>;

/// All closed curves in which the plane cuts the mesh, largest area first. Curves that run into a hole of the
/// mesh are closed by a straight line.
std::vector<Loop> slice(const TriangleMesh& mesh, const Plane& plane);

/// Signed area, and centroid of the area (mean of the points where the area vanishes).
double loop_area(const Loop& loop);
Vector2d loop_centroid(const Loop& loop);

/// Convex hull, counter-clockwise, without points on its sides (Andrew's monotone chain).
Loop convex_hull(Loop points);
double perimeter(const Loop& loop);

/// Points of `loop` with low <= x <= high, and where it crosses those two lines.
Loop clip_x(const Loop& loop, double low, double high);

/// Width in u and in v.
Vector2d loop_low(const Loop& loop);
Vector2d loop_high(const Loop& loop);

}  // namespace garment::body
