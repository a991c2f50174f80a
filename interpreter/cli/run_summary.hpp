#pragma once
// What a run says at its end.
#include <string>

#include "interpreter/cli/terminal.hpp"
#include "runtime/results/report.hpp"

namespace garment::cli {

/// The drape's outcome, ties that do not close, measures, expectations, and where the results are.
void summarise(const results::Report& report, const std::string& folder, bool draped, Terminal& terminal);

}  // namespace garment::cli
