#pragma once
// Panels: a recipe drawn, checked, opened from the fold.
#include "interpreter/language/program.hpp"

namespace garment::interpreter {

int reserve_panel(Program& program, const Declaration& declaration);
Value evaluate_panel(Program& program, Declaration& declaration);
/// The panel back to what `reserve_panel` made.
void forget_panel(Program& program, Declaration& declaration);

/// Finds out which panels are placed on a `.back`: there the smaller-x half is the wearer's left. By the
/// words of the `place` statements alone, before anything is evaluated.
void find_backs(Program& program);

}  // namespace garment::interpreter
