#pragma once
// Groups of neighbouring particles that the preconditioner moves as rigid pieces.
#include <Eigen/Core>
#include <vector>

#include "runtime/simulator/block_matrix.hpp"
#include "runtime/simulator/holds.hpp"

namespace garment::simulator {

/// A partition of the particles that are not fixed into compact groups, none empty.
struct Aggregates {
  std::vector<model::Index> of;      ///< [n] group of each particle, -1 for fixed ones
  std::vector<model::Index> begin;   ///< [n_groups + 1] into `member`
  std::vector<model::Index> member;  ///< particles group by group, ascending within one

  std::size_t size() const { return begin.empty() ? 0 : begin.size() - 1; }
};

/// Groups of about `size` (>= 1) particles that hang together in the pattern. Where `positions` [n] are given
/// the groups are rounded by Lloyd's iteration: each particle goes to the nearest centre along the pattern,
/// centres move to the middle of their group (W. Bell, N. Olson, J. Schroder, "Algebraic multigrid by Lloyd
/// aggregation"). Steps are measured by the pattern alone, so stretched or folded cloth makes the same groups
/// as flat cloth.
Aggregates group_particles(const BlockPattern& pattern, const Holds& holds,
                           const std::vector<Eigen::Vector3d>* positions, int size);

/// Lists the members of groups that are known by the group of each particle, `of` [n].
Aggregates listed(std::vector<model::Index> of, int n_groups);

}  // namespace garment::simulator
