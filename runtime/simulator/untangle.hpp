#pragma once
// Cloth that starts tangled: what cuts what, and displacements that take it apart.
#include <cstdint>
#include <vector>

#include "runtime/body/body.hpp"
#include "runtime/simulator/contact_mesh.hpp"

namespace garment::simulator {

/// An edge and a triangle that meet and share no point (exact test, touching counts). At least one is cloth.
struct EdgeHit {
  Index edge = -1, triangle = -1;
  friend bool operator==(const EdgeHit&, const EdgeHit&) = default;
  friend auto operator<=>(const EdgeHit&, const EdgeHit&) = default;
};

struct Tangle {
  std::vector<EdgeHit> hits;         ///< ascending
  std::vector<std::uint8_t> inside;  ///< per particle: inside a body (winding number >= 1/2)
  std::size_t n_inside = 0;
  bool empty() const { return hits.empty() && n_inside == 0; }
  std::size_t size() const { return hits.size() + n_inside; }
};

/// Everything that is tangled at `x` [n_particles]. Same result for any thread count.
Tangle find_tangle(const ContactMesh& mesh, const std::vector<body::Body>& bodies,
                   const std::vector<Vector3d>& x);

struct UntangleOptions {
  double step = 2e-3;  ///< m, largest displacement of a particle in one call
  double body_offset =
      2e-3;  ///< m, target distance outside a body for particles that are inside it or pierced by it
  double search = 0.3;  ///< m, how deep inside a body a particle may lie
};

/// Sets `dx` [n_particles] to displacements that reduce the tangle (zero for particles that have no part in
/// it). Particles inside a body, or closer than the offset on a triangle or edge that cuts it, move along the
/// closest surface normal to the offset. Where cloth cuts cloth, the smaller part that has gone through comes
/// back (contours.hpp) and the other gives way; edges of the contour that are no part of this move along the
/// direction that shortens it (Volino & Magnenat-Thalmann 2006, Resolving surface collisions through
/// intersection contour minimization). Call, truncate() with the tangle exempt, add, repeat. Returns
/// `tangle.size()`.
std::size_t untangle_displacements(const ContactMesh& mesh, const std::vector<body::Body>& bodies,
                                   const std::vector<Vector3d>& x, const Tangle& tangle,
                                   std::vector<Vector3d>& dx, const UntangleOptions& options = {});

/// The same with the tangle found anew.
std::size_t untangle_displacements(const ContactMesh& mesh, const std::vector<body::Body>& bodies,
                                   const std::vector<Vector3d>& x, std::vector<Vector3d>& dx);

}  // namespace garment::simulator
