#pragma once
// Panels wrapped on the same part of a body that lap each other, like the fronts of a shirt: one begins over the other.
#include <vector>

#include "runtime/modeller/placement_workspace.hpp"

namespace garment::modeller {

/// A panel on a ring round the body: its place on the unrolled ring is (x - middle, y + base), m.
struct OnRing {
  std::size_t panel = 0;
  double middle = 0, base = 0;
};

/// Lifts what lies over another panel of the same part, as far as that reaches and beside it ever less: adds to `w.flat`, whose heights
/// the wrapping keeps. Buttons say which lies over, the panel with the hole over the one with the button; else the larger offset of the
/// placements; else the name that comes first. Panels that are sewn together or lie on each other by more than half are left alone, and
/// those of which `over` or `under` is said.
void lift_laps(Workspace& w, const std::vector<OnRing>& panels);

}  // namespace garment::modeller
