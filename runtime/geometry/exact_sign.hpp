#pragma once
// Signs of orientation determinants, without rounding: a filter in double decides almost all of them,
// expansion arithmetic the rest. Valid while coordinate differences lie between 1e-80 and 1e80 (or are zero).
// Source: J. R. Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric predicates,
// 1997.
#include <Eigen/Core>

namespace garment::geometry {

/// Sign of (b - a) x (c - a) . (d - a): +1 when d lies on the side that sees a, b, c counter-clockwise, -1 on
/// the other, 0 when the four points lie in one plane.
int orient_3d(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
              const Eigen::Vector3d& d);

/// Sign of (b - a) x (c - a): +1 when a, b, c turn to the left, 0 when they lie on one line.
int orient_2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

}  // namespace garment::geometry
