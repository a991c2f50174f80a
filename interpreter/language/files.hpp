#pragma once
// Names of files in a script, and `use`.
#include <string>

#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// The path if it stays below the script's folder (or any path is allowed); else a report and Stop.
std::string checked_path(Program& program, const std::string& path, Span span);

/// `use NAME, ...` and `use "FILE" as NAME`: loads each library once and binds its name in `scope`.
void run_use(Program& program, const Statement& statement, Scope& scope);

}  // namespace garment::interpreter
