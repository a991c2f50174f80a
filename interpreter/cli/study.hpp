#pragma once
// `vary`: the same garment made and draped once for each value, side by side.
#include <string>

#include "interpreter/cli/run.hpp"

namespace garment::cli {

/// Runs the rounds of one `vary`, each into a folder TARGET=VALUE below `folder`, and writes study_TARGET.csv there: a
/// row for each value with what the round found. The worst exit code of the rounds; goes on after a round that fails.
ExitCode run_study(const RunOptions& options, const interpreter::VaryAct& act, const std::string& folder, Host& host,
                   Terminal& terminal);

/// The folders of its rounds.
std::vector<std::string> round_folders(const interpreter::VaryAct& act, const std::string& folder);

/// Evaluates the script with each value of each of its studies; prints what is wrong with one, the first that is.
ExitCode check_studies(const ProjectOptions& options, const std::vector<interpreter::Act>& acts, Host& host,
                       Terminal& terminal);

}  // namespace garment::cli
