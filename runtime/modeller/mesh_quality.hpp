#pragma once
#include <cstddef>

#include "runtime/modeller/grid_mesh.hpp"

namespace garment::modeller {

/// Turns the inner side of triangles that have two sides on the loop, where the shape allows it: a corner
/// then has a neighbour inside the panel. Two panels sewn round a corner would otherwise share a whole
/// triangle there.
void open_ears(LoopMesh& mesh, const LoopBorder& border);

/// Smallest angle of a triangle, as its sine; negative where the triangle is turned over.
double least_sine(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

}  // namespace garment::modeller
