#pragma once
// A drape that begins from the shape of a garment which was changed a little.
#include <vector>

#include "runtime/simulator/drape.hpp"

namespace garment::simulator {

/// Share of the springs that are stretched or squeezed by more than a few per cent.
double strained_share(const model::Model& model, const std::vector<model::Vector3d>& position);

/// True where many more springs are so than at the rest before (`at_rest`: a knit may hang stretched): then the garment
/// has to move as a whole, and coarser grids find the way sooner.
bool far_from_rest(const model::Model& model, const std::vector<model::Vector3d>& position, double at_rest = 0);

/// Drapes `state`, which hangs near its rest, to rest. On each of the `coarse` models (coarsest first; none
/// where the change is small) the shape is draped too, and the way that the coarse garment went is added to
/// the fine one, so that its folds stay as they were. Steps are summed; residual, energy and certificate are
/// those of the fine garment.
DrapeReport drape_again(const std::vector<model::Model>& coarse, const model::Model& model,
                        const std::vector<body::Body>& bodies, model::State& state,
                        const DrapeSettings& settings);

}  // namespace garment::simulator
