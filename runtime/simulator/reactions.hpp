#pragma once
// Forces with which pins and clamps hold the cloth.
#include <Eigen/Core>
#include <vector>

#include "runtime/model/model.hpp"
#include "runtime/simulator/holds.hpp"

namespace garment::simulator {

/// Of each of the model's holders the sum over its particles of what the holds must add to `force` (N, all that acts on each
/// particle but its holds) so that nothing moves where it is held. A particle between two holders counts for both.
std::vector<Eigen::Vector3d> reactions(const model::Model& model, const Holds& holds, const std::vector<Eigen::Vector3d>& force);

/// The moments of the same forces about the middle of the particles that each holder holds at x, N m. A holder that presses on the
/// cloth with a couple alone has the same moment about any point.
std::vector<Eigen::Vector3d> moments(const model::Model& model, const Holds& holds, const std::vector<Eigen::Vector3d>& force,
                                     const std::vector<Eigen::Vector3d>& x);

}  // namespace garment::simulator
