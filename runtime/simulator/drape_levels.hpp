#pragma once
// A drape from coarse to fine (docs/physics.md, section 3.2).
#include <vector>

#include "runtime/simulator/drape.hpp"

namespace garment::simulator {

inline constexpr int kMostCoarseSteps = 250;  ///< a coarse garment that is not near rest by then hangs in its grid

/// Drapes on each of the `coarse` models in turn (coarsest first), carries the result to the next finer grid by the flat
/// pattern, and ends on `model`. `state` holds the result; without coarse models it is also the start. Steps are summed;
/// residual, energy and certificate are those of the fine garment. Coarse levels that fail are passed over.
DrapeReport drape_levels(const std::vector<model::Model>& coarse, const model::Model& model,
                         const std::vector<body::Body>& bodies, model::State& state, const DrapeSettings& settings);

}  // namespace garment::simulator
