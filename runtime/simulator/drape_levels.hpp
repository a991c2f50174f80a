#pragma once
// A drape from coarse to fine (docs/physics.md, section 3.2).
#include <vector>

#include "runtime/simulator/drape.hpp"

namespace garment::simulator {

/// How a coarser grid drapes on the way to what `settings` ask of the fine one, with at most `steps_left` steps: it only has to find
/// the folds.
DrapeSettings on_coarse_grid(const DrapeSettings& settings, int steps_left);
/// May finer grids begin from it? What a coarse cloth cuts off a body the finer one mends; what it ties into knots stays tied.
bool found_folds(const DrapeReport& coarse, const DrapeSettings& settings);

/// Drapes on each of the `coarse` models in turn (coarsest first), carries the result to the next finer grid by the flat
/// pattern, and ends on `model`. `state` holds the result; without coarse models it is also the start. Steps are summed;
/// residual, energy and certificate are those of the fine garment. Coarse levels that fail are passed over.
DrapeReport drape_levels(const std::vector<model::Model>& coarse, const model::Model& model,
                         const std::vector<body::Body>& bodies, model::State& state, const DrapeSettings& settings);

}  // namespace garment::simulator
