#pragma once
// Layers and pads on panels, the order of panels, and what iron does.
#include "interpreter/language/program.hpp"

namespace garment::interpreter {

int reserve_layer(Program& program, const Declaration& declaration);
Value evaluate_layer(Program& program, Declaration& declaration);
int reserve_pad(Program& program, const Declaration& declaration);
Value evaluate_pad(Program& program, Declaration& declaration);
int reserve_iron(Program& program, const Declaration& declaration);
Value evaluate_iron(Program& program, Declaration& declaration);

/// After all declarations: numbers the layers of each side of each panel from the panel outwards, and takes
/// in `under` and `over` of panels, whose order must be free of circles (G1112).
void settle_layers(Program& program);

}  // namespace garment::interpreter
