#pragma once
// Meshes of the plain shapes: watertight, outward, centred as the declared shape says, edges about 1 to 2 cm.
#include "runtime/body/body.hpp"

namespace garment::body {

/// Geodesic sphere scaled to the semi-axes, m. Vertices lie on the ellipsoid.
TriangleMesh ellipsoid_mesh(const Vector3d& semi_axes);

/// Upright cylinder standing on y = 0; its two rims are rounded by at most 5 mm so that cloth can lie over
/// them.
TriangleMesh cylinder_mesh(double radius, double height);

/// Box about the origin, its edges rounded by at most 5 mm.
TriangleMesh box_mesh(const Vector3d& size);

/// Half space below y = 0, as a slab 8 m wide and 1 m deep.
TriangleMesh floor_mesh();

/// Enclosed volume, m^3; negative when the triangles look inward.
double signed_volume(const TriangleMesh& mesh);

}  // namespace garment::body
