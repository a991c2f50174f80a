#pragma once
// How much the cloth bears.
#include <optional>
#include <string>

#include "runtime/model/model.hpp"

namespace garment::results {

/// Largest tension along warp or weft in a panel, by its name, or with an empty name in all of the cloth: N(strain) of springs and cut
/// cells, per width, N/m; 0 where nothing is stretched. It is that of cloth loaded for the first time: friction inside it counts as on the way
/// out. Nothing where no panel has the name.
std::optional<double> largest_tension(const model::Model& model, const model::State& state, const std::string& panel);

}  // namespace garment::results
