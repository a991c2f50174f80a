#pragma once
// From the declared garment to the particle model that a drape needs.
#include <optional>

#include "interpreter/cli/project.hpp"
#include "runtime/model/model.hpp"

namespace garment::cli {

/// Builds the model of the garment as declared. Prints what is wrong; nothing when there are errors.
std::optional<model::Model> build_model(Project& project, Terminal& terminal);

/// Says what would be wrong with the model. What is declared and cannot be modelled yet is told as a warning; the rest of
/// the garment is then not modelled. Only `whole` builds the model of a script; a specification's is always built.
ExitCode check_model(Project& project, bool whole, Terminal& terminal);

/// False, with the error printed, where a question to a drape stands before any. A script that only varies has its measures
/// asked in each round.
bool check_acts(const Project& project, Terminal& terminal);

/// The script drapes nothing itself and has studies: its measures belong to their rounds.
bool measures_in_rounds(const std::vector<interpreter::Act>& acts);

}  // namespace garment::cli
