#pragma once
// A triangle mesh of the surface where a field vanishes, for fields that are mirror-symmetric in x.
#include <functional>

#include "runtime/body/body.hpp"

namespace garment::body {

/// Roughly the distance to the surface, m: negative inside. It must not exceed twice the true distance.
/// Called from several threads at once; always with x >= 0.
using Field = std::function<double(const Vector3d&)>;

/// Half (x >= 0) of a symmetric closed surface, to be mirrored when done. Vertices on the plane have x = 0
/// exactly.
struct HalfSurface {
  std::vector<Vector3d> vertices;
  std::vector<std::array<int, 4>> quads;  ///< counter-clockwise from outside
};

/// Surface nets (Gibson 1998) on cubes of edge `cell` inside the box (0, low_y, low_z) to `high`; then the
/// vertices are evened out along the surface and brought onto it.
HalfSurface surface_nets(const Field& field, double low_y, double low_z, const Vector3d& high, double cell);

/// Moves every vertex onto the surface of `field` (Newton along the gradient), which must be close by.
void project(HalfSurface& half, const Field& field, int steps);

/// Both halves as one watertight, exactly symmetric mesh; quads are cut along their shorter diagonal.
TriangleMesh mirror(const HalfSurface& half);

}  // namespace garment::body
