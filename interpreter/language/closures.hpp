#pragma once
// Buttons, zips, hems, tacks.
#include "interpreter/language/program.hpp"

namespace garment::interpreter {

int reserve_button(Program& program, const Declaration& declaration);
Value evaluate_button(Program& program, Declaration& declaration);
int reserve_zip(Program& program, const Declaration& declaration);
Value evaluate_zip(Program& program, Declaration& declaration);
int reserve_hem(Program& program, const Declaration& declaration);
Value evaluate_hem(Program& program, Declaration& declaration);
int reserve_tack(Program& program, const Declaration& declaration);
Value evaluate_tack(Program& program, Declaration& declaration);

/// After all declarations: buttons that share a place (G1403).
void check_buttons(Program& program);

/// A point of `panel`, inside its outline. Reports and throws Stop. `what` names it ("the button").
design::Point2 eval_cloth_point(Program& program, const Expr& expr, Scope& scope, int panel,
                                const std::string& what);

}  // namespace garment::interpreter
