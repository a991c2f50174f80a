#pragma once
// Rotations by angles in degrees, the same bits on every machine; multiples of 90 degrees are exact.
#include <Eigen/Core>

namespace garment::io {

/// Rz Ry Rx of the angles (rx, ry, rz), degrees: the convention of `place ... turn` and of the pattern files.
Eigen::Matrix3d rotation_zyx(const Eigen::Vector3d& degrees);
/// Rx Ry Rz: what some writers of the pattern files mean. Equal to rotation_zyx for one angle.
Eigen::Matrix3d rotation_xyz(const Eigen::Vector3d& degrees);
/// Angles in degrees, each in (-180, 180], with rotation_zyx(angles) = R within 1e-12; R must be a rotation.
Eigen::Vector3d angles_zyx(const Eigen::Matrix3d& R);

}  // namespace garment::io
