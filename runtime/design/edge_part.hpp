#pragma once
#include <cstdint>

#include "runtime/design/panel.hpp"

namespace garment::design {

/// Part of an edge, walked from arc length `from` to arc length `to` (from > to walks it backwards), metres along the
/// edge as cut.
struct EdgePart {
  int panel = -1;       ///< index into Garment::panels
  int edge = -1;        ///< index into the list of the panel that `on` names
  double from = 0, to = 0;
  enum class On : std::uint8_t { outline, hole, line } on = On::outline;  ///< Panel::edges, hole_edges or lines
};

/// The edge or interior line that a part belongs to.
inline const Edge& edge_of(const Panel& panel, const EdgePart& part) {
  const std::size_t k = static_cast<std::size_t>(part.edge);
  if (part.on == EdgePart::On::hole) return panel.hole_edges[k];
  return part.on == EdgePart::On::line ? panel.lines[k] : panel.edges[k];
}

}  // namespace garment::design
