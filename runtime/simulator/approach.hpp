#pragma once
// From one shape to another as far as cloth does not meet cloth.
#include <vector>

#include "runtime/model/model.hpp"

namespace garment::simulator {

/// `from` moved towards `to`, m [n_particles], along paths that start no intersection of cloth with cloth; where cloth meets cloth on
/// the way, it stops. What cuts itself at `from` is let pass. Bodies are not looked at.
std::vector<model::Vector3d> approach(const model::Model& model, const std::vector<model::Vector3d>& from,
                                      const std::vector<model::Vector3d>& to);

}  // namespace garment::simulator
