#pragma once
// Constrained Delaunay triangulation of a region bounded by closed loops, with points inside it.
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace garment::geometry {

/// What triangulate() gives. On failure `triangles` is empty and `bad` names the two points of the border
/// segment that runs through another point or across another segment, or the two points that coincide.
struct Triangulation {
  bool ok = false;
  std::vector<std::array<int, 3>> triangles;  ///< point indices, counter-clockwise
  std::array<int, 2> bad{-1, -1};
};

/// Triangulates the region to the left of the directed segments `border` (outer loops counter-clockwise,
/// holes clockwise), using every point in it. Border segments become triangle sides; all other sides are
/// Delaunay as far as the border allows. Points outside the region are ignored. The topology is decided
/// exactly on coordinates rounded to 2^-26 of the region's extent: same input, same triangles. Cost: about n
/// log n for points given in a spatially coherent order.
Triangulation triangulate(const std::vector<Eigen::Vector2d>& points,
                          const std::vector<std::array<int, 2>>& border);

}  // namespace garment::geometry
