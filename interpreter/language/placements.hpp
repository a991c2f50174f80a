#pragma once
// place, attach, pin, gravity.
#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// The item's declaration is the panel of a `place` inside a panel's block, else null.
void run_place(Program& program, const Item& item);
void run_attach(Program& program, const Item& item);
void run_gravity(Program& program, const Item& item);

int reserve_pin(Program& program, const Declaration& declaration);
/// `pin NAME on PANEL at POINT`.
Value evaluate_pin(Program& program, Declaration& declaration);

}  // namespace garment::interpreter
