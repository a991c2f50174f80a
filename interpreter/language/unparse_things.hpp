#pragma once
// Fabrics and bodies as script text.
#include <string>

#include "runtime/design/garment.hpp"

namespace garment::interpreter::text {

/// The statement that declares a cloth by all of its figures, SI units stated.
std::string fabric(const std::string& name, const design::Fabric& fabric);
/// The statement that declares a body.
std::string body(const std::string& name, const design::Body& body);
/// "(0 m/s^2, -9.80665 m/s^2, 0 m/s^2)".
std::string acceleration(const Eigen::Vector3d& a);

}  // namespace garment::interpreter::text
