#pragma once
#include <string>
#include <vector>

#include "interpreter/language/unparse_text.hpp"

namespace garment::interpreter::text {

/// The statements of what holds, pushes and moves: path, clamp, force, pressure, constrain, friction, wind,
/// drag, solver.
std::vector<std::string> scene(const design::Garment& garment, const Names& names);

}  // namespace garment::interpreter::text
