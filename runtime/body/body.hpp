#pragma once
// A body ready for use: watertight surface, distance queries, and (on people) levels, parts and girths.
#include <Eigen/Core>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/base/host.hpp"
#include "runtime/design/garment.hpp"

namespace garment::body {

using Eigen::Vector3d;

struct TriangleMesh {
  std::vector<Vector3d> vertices;             ///< m
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise from outside
};

/// Closest point of the surface.
struct SurfacePoint {
  Vector3d point;
  Vector3d normal;      ///< outward, unit; angle-weighted at edges and vertices, so that it tells the sign of `distance`
  Vector3d push;        ///< outward, unit: where to push; turns continuously over facets, but for corners beside a sharp edge
  double distance = 0;  ///< signed: negative inside
  int triangle = -1;
};

/// A horizontal level of a person ("waist", "hip", "bust", "neck", "knee", ...).
struct Level {
  double height = 0;  ///< y, m
  double girth = 0;   ///< convex-hull girth of that section, m
};

/// A part that cloth can be wrapped on: a chain of sections square to an axis (torso, limb, neck).
/// Section k is a convex closed polygon in the plane through `center` spanned by `u` and `v`.
struct Section {
  Vector3d center, axis, u, v;        ///< axis: unit, from `start` to `end` of the part; u x v = axis
  std::vector<Eigen::Vector2d> hull;  ///< convex, counter-clockwise in (u, v), m
};
struct Part {
  std::string name;  ///< "torso", "arm.left", "arm.right", "leg.left", "leg.right", "neck", "head"
  std::vector<Section> sections;  ///< ordered along the axis
};

class Body {
 public:
  std::string name;
  double friction = 0.3;
  TriangleMesh mesh;
  std::map<std::string, Level> levels;  ///< empty on plain shapes
  std::map<std::string, Part> parts;    ///< empty on plain shapes

  /// Closest point of the surface within `max_distance` of `p`; nothing if it is farther away.
  std::optional<SurfacePoint> closest(const Vector3d& p, double max_distance) const;
  /// Where else the surface faces `p` within `radius`: places that are nearer to `p` than the surface around them, seen from
  /// outside, in directions well apart from one another's and from that of `nearest` (which `closest` gave). In a crotch or
  /// between two thighs one nearest place does not tell what a particle must keep away from. Replaces `out`, nearest first.
  void facing(const Vector3d& p, double radius, const SurfacePoint& nearest, std::vector<SurfacePoint>& out) const;
  /// Generalised winding number, about 1 inside, 0 outside; overlapping bodies give 2 and so on.
  double winding(const Vector3d& p) const;
  bool inside(const Vector3d& p) const { return winding(p) >= 0.5; }

  struct Index;  ///< FCL BVHModel and search tables, made by build_index
  std::shared_ptr<const Index> index;
};

/// Makes the search structures; call after `mesh` is filled and never change the mesh afterwards.
void build_index(Body& body);

struct BodyResult {
  std::optional<Body> body;
  Findings findings;
};

/// Builds a declared body. Fails with coded findings on unreadable, truncated, empty, huge or open meshes,
/// and on measures out of range.
BodyResult build_body(const design::Body& declared, Host& host, const std::string& base_folder);

}  // namespace garment::body
