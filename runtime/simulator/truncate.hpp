#pragma once
// No step may start an intersection: displacements are cut back at walls between near parts.
#include <vector>

#include "runtime/simulator/candidates.hpp"
#include "runtime/simulator/contact_mesh.hpp"

namespace garment::simulator {

struct TruncateOptions {
  double fraction = 0.9;  ///< of the way to its wall that a particle may use, (0, 1)
};

struct TruncateStats {
  std::size_t walls = 0;         ///< walls that some displacement would have passed
  std::size_t limited = 0;       ///< particles whose displacement was changed
  std::size_t out_of_reach = 0;  ///< particles stopped only because the candidates are too old: rebuild them
  double largest_cut = 0;        ///< m, largest change of a displacement
};

/// Changes `dx` [n_particles, m] so that x + t dx, t in [0, 1], starts no intersection.
///
/// For every pair in `candidates` that is not exempt a plane square to the gap between its closest points is a wall. The wall
/// moves along its normal as far as both sides wish to go, or the slower of them, so that layers that move together are free
/// however near they are; where the sides go against each other it stands. Of its distance to the wall a particle uses at most
/// `fraction`; the gap is shared by how far each side comes (a side has at least a tenth). What would go farther is taken off
/// along the wall's normal, motion along the wall stays. Where several walls do not agree, the whole displacement of the
/// particle shrinks. A particle that was cut back does not go on before the walls behind it any more: those slow down, in
/// rounds, and stand in the end. Walls stand
/// where the displacements may bring parts together, and, where cutting changed that, between the parts that may now meet.
/// Pairs that are not listed are safe while the candidates are complete; where they are not, no particle goes farther than
/// `candidates.reach()` from the reference. Gaps below 1e-8 m do not close further. The length of no
/// displacement grows. Precondition: x moved from the reference by
/// truncated displacements only. Source: Chen et al. 2025, Offset geometric contact, 3.4, with moving planes
/// instead of balls.
TruncateStats truncate(const ContactMesh& mesh, const Candidates& candidates, const std::vector<Vector3d>& x,
                       std::vector<Vector3d>& dx, const TruncateOptions& options = {});

}  // namespace garment::simulator
