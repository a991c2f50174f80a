#pragma once
// Meshes for the tests of bodies.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "runtime/base/portable_math.hpp"
#include "runtime/body/body.hpp"

namespace garment::body {

/// The folder of the reference data's bodies.
inline const std::string kBodies = std::string(GARMENT_DATA_DIR) + "/bodies/";

inline void append(TriangleMesh& mesh, const TriangleMesh& other, const Vector3d& shift) {
  const int base = static_cast<int>(mesh.vertices.size());
  for (const Vector3d& p : other.vertices) mesh.vertices.push_back(p + shift);
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
}

inline Body body_of(TriangleMesh mesh) {
  Body body;
  body.mesh = std::move(mesh);
  build_index(body);
  return body;
}

/// Smallest angle of all triangles, degrees.
inline double smallest_angle(const TriangleMesh& mesh) {
  double least = 180;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vector3d a = mesh.vertices[t[(k + 1) % 3]] - mesh.vertices[t[k]],
                     b = mesh.vertices[t[(k + 2) % 3]] - mesh.vertices[t[k]];
      least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / portable::kPi);
    }
  return least;
}

}  // namespace garment::body
