#pragma once
// A part of a garment as a model of its own.
#include <vector>

#include "runtime/model/model.hpp"

namespace garment::model {

struct Part {
  Model model;
  std::vector<Index> particle;  ///< of the whole garment, ascending [n_particles of the part]
  std::vector<char> free;       ///< which of them may move [n_particles of the part]
};

/// The particles that `free` marks [n_particles], with all that pulls on them; what lies around them is held where it is at
/// `x` (m). Has the triangles of free particles, and those that `near` marks [n_triangles]. Panels, laws and the air are those of
/// the whole; holders and motions, which only reports and moving garments ask for, are left out, and so is friction inside the cloth.
Part part_of(const Model& whole, const std::vector<char>& free, const std::vector<char>& near, const std::vector<Vector3d>& x);

}  // namespace garment::model
