#pragma once
// Merging: vertices that seams and darts bring together become one particle.
#include "runtime/model/model.hpp"
#include "runtime/modeller/border.hpp"

namespace garment::modeller {

/// A seam that is more than merged particles, or that joins rings, with the vertices of its sides in the order sewn: place k of every side is one.
struct SewnSides {
  const Matching* seam = nullptr;
  std::vector<std::vector<model::Index>> side;
};

/// The particle of every vertex. Vertices count panel by panel, `first_vertex` per panel, `n_vertices` in
/// all; a panel's border vertices come first. Particles are numbered in the order in which vertices first
/// meet them. Fills `model.seams` with the chains of all reported matchings, and `sides` with those that are tied or drawn in, or
/// that join rings.
std::vector<model::Index> sew(const std::vector<Matching>& matchings, const Matched& matched,
                              const Borders& borders, const std::vector<model::Index>& first_vertex,
                              std::size_t n_vertices, model::Model& model, std::vector<SewnSides>& sides);

}  // namespace garment::modeller
