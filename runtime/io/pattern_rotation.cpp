#include "runtime/io/pattern_rotation.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "runtime/base/portable_math.hpp"

namespace garment::io {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct CosSin {
  double c, s;
};

/// Cosine and sine of an angle in degrees; reduced to a quarter turn first, so that 90 degrees gives (0, 1)
/// exactly.
CosSin cos_sin(double degrees) {
  double turn = std::remainder(degrees, 360.0);
  double quarter = std::round(turn / 90.0);
  double rest = (turn - 90.0 * quarter) * (portable::kPi / 180.0);
  CosSin r{portable::cos(rest), portable::sin(rest)};
  switch ((static_cast<int>(quarter) + 4) % 4) {
    case 1:
      return {-r.s, r.c};
    case 2:
      return {-r.c, -r.s};
    case 3:
      return {r.s, -r.c};
    default:
      return r;
  }
}

Matrix3d about(int axis, double degrees) {
  auto [c, s] = cos_sin(degrees);
  int j = (axis + 1) % 3, k = (axis + 2) % 3;
  Matrix3d R = Matrix3d::Identity();
  R(j, j) = c;
  R(k, k) = c;
  R(j, k) = -s;
  R(k, j) = s;
  return R;
}

}  // namespace

Matrix3d rotation_zyx(const Vector3d& degrees) {
  return about(2, degrees.z()) * about(1, degrees.y()) * about(0, degrees.x());
}

Matrix3d rotation_xyz(const Vector3d& degrees) {
  return about(0, degrees.x()) * about(1, degrees.y()) * about(2, degrees.z());
}

Vector3d angles_zyx(const Matrix3d& R) {
  // R = Rz Ry Rx: R(2,0) = -sin y, R(2,1) = cos y sin x, R(2,2) = cos y cos x, R(1,0) = cos y sin z, R(0,0) =
  // cos y cos z.
  constexpr double kDegrees = 180.0 / portable::kPi;
  double y = portable::atan2(-R(2, 0), std::sqrt(R(0, 0) * R(0, 0) + R(1, 0) * R(1, 0)));
  double x = portable::atan2(R(2, 1), R(2, 2));
  // z from R Rx(-x) rather than from its own entries: where cos y is nearly 0, x is arbitrary and z must
  // agree with it.
  double s = portable::sin(x), c = portable::cos(x);
  double z = portable::atan2(s * R(0, 2) - c * R(0, 1), c * R(1, 1) - s * R(1, 2));
  // The same turn has a second set of angles; (0, 180, 0) reads better than (180, 0, 180).
  Vector3d angles = Vector3d(x, y, z) * kDegrees;
  auto opposite = [](double a) { return a > 0 ? a - 180 : a + 180; };
  Vector3d other(opposite(angles.x()), y >= 0 ? 180 - angles.y() : -180 - angles.y(), opposite(angles.z()));
  if (other.y() <= -180) other.y() += 360;
  return other.cwiseAbs().sum() < angles.cwiseAbs().sum() - 1e-9 ? other : angles;
}

}  // namespace garment::io
