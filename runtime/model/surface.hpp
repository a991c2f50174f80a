#pragma once
// The cloth's surface: smooth normals for pictures and files.
#include <vector>

#include "runtime/model/model.hpp"

namespace garment::model {

/// Unit normal of every particle [n_particles], on the cloth's face side: the mean of the triangles around
/// it, weighted by their area, across seams too. (0, 1, 0) where that mean vanishes.
std::vector<Vector3d> particle_normals(const Model& model, const std::vector<Vector3d>& positions);

/// The same for any triangle mesh, corners counter-clockwise seen from outside.
std::vector<Vector3d> smooth_normals(const std::vector<Indices<3>>& triangles,
                                     const std::vector<Vector3d>& positions);

}  // namespace garment::model
