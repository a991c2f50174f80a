#pragma once
// `garment test DIR`: scripts that say themselves what is expected of them, or have a sibling .expected file.
#include <string>
#include <vector>

#include "interpreter/cli/exit_codes.hpp"
#include "interpreter/cli/terminal.hpp"
#include "runtime/base/host.hpp"

namespace garment::cli {

struct GoldenOptions {
  std::string folder;
  std::string stdlib_dir;
  std::vector<std::string> library_dirs;  ///< where `use NAME` looks first
  bool update = false;   ///< write .expected files anew; the only way they change
  bool drape = true;     ///< else scripts of the stage `run` are only checked
  bool list = false;     ///< only name the scripts and their stages
  std::string filter;    ///< only scripts with this in their path; `*` stands for anything
  std::string junit;     ///< file for the outcome as JUnit XML
  int jobs = 1;          ///< scripts at a time; the answer does not depend on it
};

/// Runs every script below the folder, in the order of their names, and compares.
///
/// How far a script is taken is its stage: `parse` (the tree's outline), `format` (the canonical layout), `check` (the
/// diagnostics), `model` (the particle model's summary), `run` (draped; what it measures and expects). It is the one of a
/// line `#! stage: NAME`, else the nearest folder of that name on the way from DIR (DIR included), else `run` for a
/// script with a `drape`, else `check`.
///
/// A script whose comments say
///     #! error[G0312] 7-12 "part of the message"
/// above a line expects just these diagnostics (error, warning or note), at these columns of that line; without columns it
/// expects one that speaks of the script as a whole. A diagnostic that goes over several lines is held to its first
/// column only. A script with `#! ok` expects none. `#! expect: 58 cm` above a `let`, `param` or `measure` says what it
/// is. `#! tolerance: 1 mm` (or `2%`, or a number) says how far numbers may be from these and from those of the .expected
/// file, which may begin with such a line too. Any other `#!` line fails. A script that is run and has `expect`
/// statements needs no .expected file; every other one without `#!` expectations does. A missing golden and a golden
/// without its script fail.
///
/// kOk, kDiagnostics where a script failed, kInputOutput where there is nothing to test or the JUnit file cannot be
/// written, kInterrupted after Ctrl-C.
ExitCode run_goldens(const GoldenOptions& options, Host& host, Terminal& terminal);

}  // namespace garment::cli
