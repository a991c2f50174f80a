#pragma once
// release, record, vary: acts beside drape, expect and save.
#include "interpreter/language/program.hpp"

namespace garment::interpreter {

void run_release(Program& program, const Item& item);
void run_record(Program& program, const Item& item);
void run_vary(Program& program, const Item& item);

/// Where a study varies something (InterpretOptions::study), puts the value in place of what the script
/// states. Reports and throws Stop where there is nothing of that name.
void apply_study(Program& program);

}  // namespace garment::interpreter
