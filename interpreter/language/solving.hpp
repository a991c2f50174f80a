#pragma once
// `solve NAME in LOW .. HIGH so A == B`: declares NAME with the value for which the condition holds.
#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// Value of a `solve`: panels and values of its condition are drawn for values of the range until both sides agree.
Value evaluate_solve(Program& program, Declaration& declaration);
/// Takes its report back.
void forget_solve(Program& program, Declaration& declaration);

}  // namespace garment::interpreter
