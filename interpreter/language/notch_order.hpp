#pragma once
// Notches of the sides of a seam come together.
#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// Notches that have the same name on two sides of a seam are matched when it is sewn: they must come in the same order
/// (G0432), and where the sides are as long, stand at the same place within 5 mm (G0438, a warning).
void check_notch_order(Program& program);

}  // namespace garment::interpreter
