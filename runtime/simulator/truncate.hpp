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
/// For every pair in `candidates` that is not exempt the plane between its closest points, square to the gap,
/// is a wall: midway between two pieces of cloth, at the body between cloth and body. A particle uses at most
/// `fraction` of its distance to each of its walls; what would go farther is taken off along the wall's
/// normal, motion along the wall stays. Where several walls do not agree, the whole displacement of the
/// particle shrinks. Pairs that are not listed are safe because no particle goes farther than
/// `candidates.reach()` from the reference. Gaps below 1e-8 m do not close further. The length of no
/// displacement grows. Precondition: every x lies within reach of the reference (always so when x moved by
/// truncated displacements only). Source: Chen et al. 2025, Offset geometric contact, 3.4, with planes
/// instead of balls.
TruncateStats truncate(const ContactMesh& mesh, const Candidates& candidates, const std::vector<Vector3d>& x,
                       std::vector<Vector3d>& dx, const TruncateOptions& options = {});

}  // namespace garment::simulator
