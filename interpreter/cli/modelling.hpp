#pragma once
// From the declared garment to the particle models that a drape needs: the fine one, and coarser ones to start on.
#include <vector>

#include "interpreter/cli/project.hpp"
#include "runtime/model/model.hpp"

namespace garment::cli {

/// Builds the model of the garment as declared. Prints what is wrong; nothing when there are errors.
std::optional<model::Model> build_model(Project& project, Terminal& terminal);

/// Says what would be wrong with the model. What is declared and cannot be modelled yet is told as a warning; the rest of
/// the garment is then not modelled.
ExitCode check_model(Project& project, Terminal& terminal);

/// Models at 2^k times the stated grid spacing, coarsest first, the fine one not among them; empty for small garments and
/// where a panel is too small for a coarser grid.
std::vector<model::Model> build_coarse_models(const Project& project, const model::Model& fine);

}  // namespace garment::cli
