#pragma once
// The Kelvin time of the cloth at each particle.
#include "runtime/modeller/cloth_fields.hpp"

namespace garment::modeller {

/// Fills `damping`: tau of the panel's fabric times the factors of its regions, the mean over the cell about the particle and
/// over the panels that a seam joins there. Left empty where all cloth has the usual one.
void add_damping(const std::vector<MeshedPanel>& panels, const ClothFields& fields, model::Model& model);

}  // namespace garment::modeller
