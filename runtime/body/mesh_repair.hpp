#pragma once
// What a surface must be before cloth can meet it: one vertex a place, no triangles without area, closed, one
// outside.
#include "runtime/body/body.hpp"

namespace garment::body {

/// Merges vertices with equal coordinates, drops triangles with fewer than three different corners and
/// vertices without triangles. Returns how many triangles were dropped.
int clean_mesh(TriangleMesh& mesh);

struct SurfaceCheck {
  std::size_t open_edges = 0;         ///< edges with an odd number of triangles
  std::size_t twisted_edges = 0;      ///< edges that two triangles walk in the same direction
  std::size_t crowded_edges = 0;      ///< edges with more than two triangles
  Vector3d place = Vector3d::Zero();  ///< the middle of one of them (open ones first)
};
/// Watertight and outward-consistent when both counts are zero. Edges with four triangles are allowed: parts
/// that touch.
SurfaceCheck check_surface(const TriangleMesh& mesh);

}  // namespace garment::body
