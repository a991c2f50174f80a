#include "runtime/model/surface.hpp"

#include <Eigen/Geometry>

namespace garment::model {

std::vector<Vector3d> smooth_normals(const std::vector<Indices<3>>& triangles,
                                     const std::vector<Vector3d>& positions) {
  std::vector<Vector3d> normals(positions.size(), Vector3d::Zero());
  for (const auto& [a, b, c] : triangles) {
    const Vector3d twice_area = (positions[b] - positions[a]).cross(positions[c] - positions[a]);
    for (Index p : {a, b, c}) normals[p] += twice_area;
  }
  for (Vector3d& n : normals) {
    const double length = n.norm();
    n = length > 1e-30 ? Vector3d(n / length) : Vector3d(0, 1, 0);
  }
  return normals;
}

std::vector<Vector3d> particle_normals(const Model& model, const std::vector<Vector3d>& positions) {
  std::vector<Indices<3>> triangles;
  triangles.reserve(model.n_triangles());
  for (std::size_t t = 0; t < model.n_triangles(); ++t) triangles.push_back(model.corners(t));
  return smooth_normals(triangles, positions);
}

}  // namespace garment::model
