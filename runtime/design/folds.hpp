#pragma once
// What takes cloth away inside a panel or along its edges: darts that do not open on one edge, pleats and tucks.
#include <cstdint>
#include <string>

#include "runtime/base/origin.hpp"
#include "runtime/geometry/curve.hpp"

namespace garment::design {

/// A fish-eye dart: a lens inside a panel, pointed at both ends; its two sides are sewn together.
struct InsideDart {
  std::string name;
  OriginId origin;
  geometry::Point2 from{0, 0}, to{0, 0};  ///< the two tips
  double width = 0;                       ///< at the widest place, square to the line between the tips, m
  double at = 0.5;                        ///< where it is widest, as a fraction of the way from `from` to `to`
};

/// A dart whose legs are drawn: two neighbouring edges of the outline that meet at the tip and are sewn together.
struct LegDart {
  std::string name;
  OriginId origin;
  std::string leg_a, leg_b;  ///< names in Panel::edges; both are as long
};

/// Pleats or tucks on an edge. Each takes cloth out of the edge: the stretch `take` about its place is folded away
/// when the edge is sewn.
struct Pleat {
  enum class Kind : std::uint8_t { knife, box, inverted, tuck };
  std::string name;
  OriginId origin;
  std::string edge;
  Kind kind = Kind::knife;
  double at = 0;       ///< arc length of the middle of the first one's stretch, m
  double underlay = 0; ///< depth of one fold, m
  int count = 1;
  double spacing = 0;  ///< between the middles of neighbours along the edge as cut, m
  int toward = 1;      ///< the folds lie towards the edge's end (1) or its start (-1); of knife pleats and tucks
  double length = 0;   ///< how far it is stitched down from the edge, m; 0: held at the edge only
  bool ironed = false; ///< creased over its whole length

  /// Length of edge that one of them folds away: two layers for a knife pleat or tuck, four for a box pleat.
  double take() const { return underlay * (kind == Kind::knife || kind == Kind::tuck ? 2 : 4); }
};

}  // namespace garment::design
