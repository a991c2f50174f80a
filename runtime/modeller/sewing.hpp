#pragma once
// Merging: vertices that seams and darts bring together become one particle.
#include "runtime/model/model.hpp"
#include "runtime/modeller/border.hpp"

namespace garment::modeller {

/// The particle of every vertex. Vertices count panel by panel, `first_vertex` per panel, `n_vertices` in
/// all; a panel's border vertices come first. Particles are numbered in the order in which vertices first
/// meet them. Fills `model.seams` with the chains of all reported matchings.
std::vector<model::Index> sew(const std::vector<Matching>& matchings, const Matched& matched,
                              const Borders& borders, const std::vector<model::Index>& first_vertex,
                              std::size_t n_vertices, model::Model& model);

}  // namespace garment::modeller
