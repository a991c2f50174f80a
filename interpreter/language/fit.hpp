#pragma once
// Is the garment large enough for its body? Told before anything is draped.
#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// Warns where a ring of panels that are sewn together round the torso is narrower at a level than the body,
/// even stretched as far as its cloth goes at the load of EM (G0660). Only panels that are placed `on` a side
/// of the body `with` an edge at a level are judged: of the others it is not known where they lie.
void check_fit(Program& program);

}  // namespace garment::interpreter
