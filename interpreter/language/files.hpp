#pragma once
// Names of files in a script.
#include <string>

#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// The path if it stays below the script's folder (or any path is allowed); else a report and Stop.
std::string checked_path(Program& program, const std::string& path, Span span);

}  // namespace garment::interpreter
