#pragma once
// `garment test DIR`: scripts that say themselves what is expected of them, or have a sibling .expected file.
#include <string>

#include "interpreter/cli/exit_codes.hpp"
#include "interpreter/cli/terminal.hpp"
#include "runtime/base/host.hpp"

namespace garment::cli {

struct GoldenOptions {
  std::string folder;
  std::string stdlib_dir;
  bool update = false;  ///< write .expected files anew; the only way they change
};

/// Runs every script below the folder, in the order of their names, and compares.
///
/// The stage is the name of a folder on the way: `parse` (the tree's outline), `model` (the model's summary),
/// anything else is `check` (the diagnostics). A script whose comments say
///     #! error[G0312] 7-12 "part of the message"
/// above a line expects just these diagnostics (error, warning or note), at these columns of that line, and needs no
/// .expected file; without columns it expects one that speaks of the script as a whole. A diagnostic that goes over
/// several lines is held to its first column only. A script with `#! ok` expects none. A missing golden and a golden
/// without its script fail.
ExitCode run_goldens(const GoldenOptions& options, Host& host, Terminal& terminal);

}  // namespace garment::cli
