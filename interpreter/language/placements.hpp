#pragma once
// place, attach, pin, gravity.
#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// `owner` is the panel of a `place` inside a panel's block, else null.
void run_place(Program& program, const Statement& statement, Scope& scope, Declaration* owner);
void run_attach(Program& program, const Statement& statement, Scope& scope);
void run_gravity(Program& program, const Statement& statement, Scope& scope);

}  // namespace garment::interpreter
