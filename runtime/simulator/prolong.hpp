#pragma once
// From a coarse grid of a garment to a finer one, by the flat pattern.
#include "runtime/model/model.hpp"

namespace garment::simulator {

/// Positions [fine.n_particles] of the fine model's particles on the coarse garment: each finds its place in the flat
/// pattern of the coarse panel of the same number and takes the point of that triangle (linear inside it, carried on
/// beyond the border). A particle that several panels share takes the mean. Both models come from one declared garment.
std::vector<model::Vector3d> prolong(const model::Model& coarse, const std::vector<model::Vector3d>& positions,
                                     const model::Model& fine);

}  // namespace garment::simulator
