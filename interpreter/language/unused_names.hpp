#pragma once
// Names that are declared and that nothing speaks of.
#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// Warns of `let` and `fn`, and of interior lines and named points, that the script never uses (G0439). A name counts as
/// used where it is written anywhere else, whether that place is evaluated or not.
void check_unused(Program& program);

}  // namespace garment::interpreter
