#pragma once
// Rings that are sewn to rings: does each place of the one meet the place of the other that it is placed beside?
#include <optional>
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/model/model.hpp"
#include "runtime/modeller/sewing.hpp"

namespace garment::modeller {

/// Places of a ring at equal steps; none where the cloth has no place of its own.
using RingPlaces = std::vector<std::optional<model::Vector3d>>;

/// How two rings lie to each other with their middles brought together: the correlation of places, 1 where one is the image of the
/// other in size, -1 where it is that turned half round (for a flat ring).
struct RingTurn {
  double sewn = 1;      ///< as they are sewn
  double best = 1;      ///< the most over all turns of the second ring
  double turned = 0;    ///< that turn, as a share of the ring, 0 .. 1
};
/// `a` and `b` have as many steps. What has no place is laid straight between what has; a ring with less than half of its places, or
/// without size, is taken to fit.
RingTurn ring_turn(const RingPlaces& a, const RingPlaces& b);

/// Warns of rings that are placed by themselves, at least half of each, and sewn together far from how they lie (G0552). `place`
/// [n_vertices] is where the panels lie before seams bring them together, m, of those that are `done` [n_panels].
Findings turned_rings(const std::vector<SewnSides>& sides, const model::Model& model, const std::vector<bool>& done,
                      const std::vector<model::Vector3d>& place);

}  // namespace garment::modeller
