#pragma once
// Names of files in a script.
#include <string>

#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// The path of a file to read if it stays below the script's folder as written, or more was granted; else a report and
/// Stop. Whether it really does is checked where the file is opened.
std::string readable_path(Program& program, const std::string& path, Span span);
/// The same of a file to write below the output folder.
std::string writable_path(Program& program, const std::string& path, Span span);

}  // namespace garment::interpreter
