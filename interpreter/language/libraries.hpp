#pragma once
// Libraries: `use`, where they are looked for, and what a library file says of itself.
#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// `use NAME, ...` and `use "FILE" as NAME`: loads each library once and binds its name in `scope`. NAME is
/// looked for in the folders of InterpretOptions::library_dirs and then in the standard library, "FILE" below
/// the folder of the script. Reports and throws Stop.
void run_use(Program& program, const Statement& statement, Scope& scope);

/// Runs what a library states about itself: its edition and its assertions. What fails is shown at its `use`.
void check_libraries(Program& program);

}  // namespace garment::interpreter
