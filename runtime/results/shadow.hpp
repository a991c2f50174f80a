#pragma once
// Figures of a drape test: the shadow of a round cloth over its disc, and the folds of its rim.
#include <optional>

#include "runtime/body/body.hpp"
#include "runtime/model/model.hpp"

namespace garment::results {

/// Area of a panel's shadow under light from straight above, m^2. Rows of 0.2 mm, each exact along x.
double shadow_area(const model::Model& model, const model::State& state, model::Index panel);

/// Drape coefficient (Cusick 1965): (shadow - disc) / (cloth - disc), where the disc is the body that carries
/// the panel: the highest horizontal extent of a body under it. Nothing where no body lies under the panel's
/// middle, or the cloth is not larger than the disc.
std::optional<double> drape_coefficient(const model::Model& model, const model::State& state,
                                        const std::vector<body::Body>& bodies, model::Index panel);

/// Folds of the rim of a panel: how often its height rises through its mean, going round; small ripples
/// (under a tenth of the whole range) do not count. 0 where the rim is level within 2 mm; nothing where there
/// is no rim.
std::optional<int> count_nodes(const model::Model& model, const model::State& state, model::Index panel);

}  // namespace garment::results
