#pragma once
// A panel drawn as one half on the fold, opened into the whole piece.
#include <cstddef>
#include <optional>

#include "runtime/base/finding.hpp"
#include "runtime/design/panel.hpp"

namespace garment::design {

struct UnfoldResult {
  std::optional<Panel> panel;
  Findings findings;
};

/// Opens `half` about its edge `fold_edge`, which must be straight along y (G0404) with the rest of the
/// outline on one side (G0406) and both neighbours meeting it squarely within 1 deg (G0405). The result is
/// one loop: the drawn edges from the fold's end round to its start, then their mirror images walked back;
/// the fold itself is gone and `fold_x` is set. Edges, notches, darts and pleats are named "left.NAME" and
/// "right.NAME"; the drawn half is the left one if `drawn_is_left`. For the inside see unfold_interior.hpp.
UnfoldResult unfold(const Panel& half, std::size_t fold_edge, bool drawn_is_left);

}  // namespace garment::design
