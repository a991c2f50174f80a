#pragma once
// Placing a panel by its seams: the surface of the placed neighbour is carried on across the seam.
#include <vector>

#include "runtime/model/model.hpp"

namespace garment::modeller {

/// Particles that panel `panel` shares with panels marked in `placed`.
std::size_t count_shared_particles(const model::Model& model, std::size_t panel, const std::vector<bool>& placed);

/// Gives every vertex of `panel` a position in `place` [n_vertices]: each takes the nearest seam particle (in the flat
/// pattern, `flat` [n_vertices]: places in the panel's plane and the distance from it, m), and goes on from there in the tangent plane that the placed neighbour has at that particle.
void carry_panel(const model::Model& model, std::size_t panel, const std::vector<Eigen::Vector3d>& flat, const std::vector<bool>& placed,
                 std::vector<Eigen::Vector3d>& place);

}  // namespace garment::modeller
