#include "runtime/geometry/triangle_hit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "runtime/geometry/exact_sign.hpp"

namespace garment::geometry {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector2d drop(const Vector3d& p, int axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

bool between(const Vector2d& p, const Vector2d& q, const Vector2d& r) {
  return std::min(p[0], q[0]) <= r[0] && r[0] <= std::max(p[0], q[0]) && std::min(p[1], q[1]) <= r[1] &&
         r[1] <= std::max(p[1], q[1]);
}

bool segments_hit(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const int abc = orient_2d(a, b, c), abd = orient_2d(a, b, d), cda = orient_2d(c, d, a),
            cdb = orient_2d(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && between(a, b, c)) || (abd == 0 && between(a, b, d)) || (cda == 0 && between(c, d, a)) ||
         (cdb == 0 && between(c, d, b));
}

/// Coplanar segments meet exactly when their shadows on all three coordinate planes do: one of the shadows is
/// faithful, the others can only gain common points.
bool coplanar_segments_hit(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  for (int axis = 0; axis < 3; ++axis)
    if (!segments_hit(drop(a, axis), drop(b, axis), drop(c, axis), drop(d, axis))) return false;
  return true;
}

/// Coordinate axis along which the shadow of the triangle has an area; -1 when its three corners lie on one
/// line.
int faithful_axis(const Triangle3& t) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]).cwiseAbs();
  Eigen::Index largest = 0;
  normal.maxCoeff(&largest);
  for (int k = 0; k < 3; ++k) {
    const int axis = (static_cast<int>(largest) + k) % 3;
    if (orient_2d(drop(t[0], axis), drop(t[1], axis), drop(t[2], axis)) != 0) return axis;
  }
  return -1;
}

bool flat_hit(const Vector3d& p, const Vector3d& q, const Triangle3& t) {
  const int axis = faithful_axis(t);
  if (axis < 0) {
    for (int k = 0; k < 3; ++k) {
      const Vector3d &a = t[k], &b = t[(k + 1) % 3];
      if (orient_3d(p, q, a, b) == 0 && coplanar_segments_hit(p, q, a, b)) return true;
    }
    return false;
  }
  const Vector2d a = drop(t[0], axis), b = drop(t[1], axis), c = drop(t[2], axis);
  const Vector2d u = drop(p, axis), v = drop(q, axis);
  if (segments_hit(u, v, a, b) || segments_hit(u, v, b, c) || segments_hit(u, v, c, a)) return true;
  const int i = orient_2d(a, b, u), j = orient_2d(b, c, u), k = orient_2d(c, a, u);
  return i == j && j == k && i != 0;  // the whole segment lies inside
}

/// `side_p`, `side_q`: the sides of the plane of t on which p and q lie.
bool hits(const Vector3d& p, int side_p, const Vector3d& q, int side_q, const Triangle3& t) {
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) return flat_hit(p, q, t);
  const int i = orient_3d(p, q, t[0], t[1]);
  const int j = orient_3d(p, q, t[1], t[2]);
  if (i * j < 0) return false;
  const int k = orient_3d(p, q, t[2], t[0]);
  return (i >= 0 && j >= 0 && k >= 0) || (i <= 0 && j <= 0 && k <= 0);
}

std::array<int, 3> sides_of(const Triangle3& plane, const Triangle3& t) {
  return {orient_3d(plane[0], plane[1], plane[2], t[0]), orient_3d(plane[0], plane[1], plane[2], t[1]),
          orient_3d(plane[0], plane[1], plane[2], t[2])};
}

bool all_on_one_side(const std::array<int, 3>& s) { return s[0] != 0 && s[0] == s[1] && s[1] == s[2]; }

}  // namespace

bool segment_hits_triangle(const Vector3d& p, const Vector3d& q, const Triangle3& t) {
  return hits(p, orient_3d(t[0], t[1], t[2], p), q, orient_3d(t[0], t[1], t[2], q), t);
}

bool triangles_hit(const Triangle3& s, const Triangle3& t) {
  const std::array<int, 3> of_t = sides_of(s, t);
  if (all_on_one_side(of_t)) return false;
  const std::array<int, 3> of_s = sides_of(t, s);
  if (all_on_one_side(of_s)) return false;
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3;
    if (hits(s[k], of_s[k], s[l], of_s[l], t) || hits(t[k], of_t[k], t[l], of_t[l], s)) return true;
  }
  return false;
}

}  // namespace garment::geometry
