#pragma once
// How a panel changed: from its new flat pattern back to the old one.
#include <vector>

#include "runtime/design/panel.hpp"

namespace garment::modeller {

/// Points of a redrawn panel on the panel as it was drawn before: edges go to the edges of the same names at
/// equal fractions of length, the inside follows by mean value coordinates of the outline (Floater, "Mean
/// value coordinates", 2003). Where the outline is the same, or its edges have other names, every point stays
/// itself.
class PatternWarp {
 public:
  PatternWarp(const design::Panel& before, const design::Panel& now);

  bool identity() const { return move_.empty(); }
  /// `p` and the result in panel coordinates, m.
  design::Point2 operator()(const design::Point2& p) const;

 private:
  std::vector<design::Point2> at_,
      move_;  ///< corners of the new outline as a polygon, and the way back of each
};

}  // namespace garment::modeller
