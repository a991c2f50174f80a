#pragma once
// The commands beside `run`. Each returns the exit code.
#include <string>
#include <vector>

#include "interpreter/cli/project.hpp"

namespace garment::cli {

/// Says what is wrong with a script. `whole` also builds its bodies and the particle model, as a run would.
ExitCode check(const ProjectOptions& options, bool whole, Host& host, Terminal& terminal);
ExitCode parse(const std::string& file, Host& host, Terminal& terminal);
ExitCode show_model(const ProjectOptions& options, Host& host, Terminal& terminal);

struct FormatOptions {
  std::vector<std::string> files;  ///< scripts, folders of scripts, or "-" for standard input
  bool check = false;              ///< only say whether the layout is canonical
  bool diff = false;               ///< only show what would change
  bool stdout_only = false;
};
/// Lays scripts out canonically, in place. kDiagnostics where a script has syntax errors or, with `check` or `diff`, where
/// it is not canonical; the worst of all files counts.
ExitCode format(const FormatOptions& options, Host& host, Terminal& terminal);

/// The table of limits.
ExitCode show_limits(Terminal& terminal);

}  // namespace garment::cli
