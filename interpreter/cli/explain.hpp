#pragma once
// `garment explain`: the long texts of codes, and what the words of the language mean.
#include <string>
#include <vector>

#include "interpreter/cli/exit_codes.hpp"
#include "interpreter/cli/terminal.hpp"

namespace garment::cli {

/// Each topic is a diagnostic code ("G0312", also "g312") or a word that `:help` knows. All topics are answered; kUsage
/// where one of them is unknown.
ExitCode explain(const std::vector<std::string>& topics, Terminal& terminal);
/// All codes with their titles.
ExitCode list_codes(Terminal& terminal);

}  // namespace garment::cli
