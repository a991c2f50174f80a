#pragma once
// The search structure of a body. FCL builds the tree of boxes; own walks over a flat copy of it answer
// closest points (FCL has no signed distance and no early-out by distance for points) and winding numbers.
#include <fcl/geometry/bvh/BVH_model.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "runtime/body/body.hpp"

namespace garment::body {

/// Which part of a triangle a closest point lies on; edge k runs from corner k to corner k + 1.
enum class Feature : std::uint8_t { corner_0, corner_1, corner_2, edge_0, edge_1, edge_2, face };

struct TrianglePoint {
  Vector3d point;
  Feature feature = Feature::face;
};

/// Closest point of triangle abc (may be degenerate) to p. Ericson, Real-Time Collision Detection, 5.1.5.
TrianglePoint closest_on_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c);

struct Body::Index {
  /// Two children and their boxes. A child below zero is a leaf: triangles [~child, ~child + count) of
  /// `leaves`.
  struct Node {
    std::array<std::array<double, 6>, 2> box;  ///< low x, y, z, high x, y, z
    std::array<int, 2> child, count;
  };
  /// A triangle in the order of the leaves.
  struct Leaf {
    std::array<Vector3d, 3> corner;
    int triangle = -1;
    bool covered = false;  ///< lies inside another part of the body: no cloth can touch it
  };
  /// Dipole and first moment of a node's triangles for far points (Barill et al. 2018, "Fast winding
  /// numbers").
  struct Far {
    Vector3d center;         ///< mean of the triangles' centres, weighted by area
    Vector3d dipole;         ///< sum of area * normal
    Eigen::Matrix3d moment;  ///< sum of area * normal * (centre - center)^T
    double radius = 0;       ///< all triangles lie within, about `center`
  };

  std::shared_ptr<fcl::BVHModel<fcl::AABBd>> model;
  std::vector<Node> nodes;                       ///< root first; empty when the mesh is
  std::vector<Far> far;                          ///< [nodes]
  std::vector<Leaf> leaves;                      ///< [triangles]
  std::vector<std::array<Vector3d, 7>> normals;  ///< [triangles] by Feature, angle-weighted, unit
  std::vector<std::array<Vector3d, 3>> smooth;   ///< [triangles] normals of the corners, not averaged over sharp edges
  std::vector<std::uint8_t> sharp;               ///< [triangles] bit k: feature k is sharp
  std::vector<int> valence;                      ///< [vertices] triangles that meet there
  double length = 0;                             ///< diagonal of the box of the body, m
};

/// Computes `smooth`, `sharp` and `valence`.
void make_smooth(const TriangleMesh& mesh, Body::Index& index);

/// The surface at a point of a triangle, as seen from p.
SurfacePoint surface_point(const Body::Index& index, const Body::Index::Leaf& leaf, const TrianglePoint& at,
                           const Vector3d& p);

/// Sets `covered` on triangles whose outer side lies inside another part (a scanned hand that sinks into the
/// hip): they are no surface to touch, a particle near them would be pushed deeper in. All else of `index`
/// must be made.
void mark_covered(const Body& body, Body::Index& index);

/// Solid angle of triangle abc seen from p over 4 pi, signed: positive where its outer side looks away from
/// p.
double solid_angle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c);

}  // namespace garment::body
