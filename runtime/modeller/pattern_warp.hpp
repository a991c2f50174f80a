#pragma once
// How a panel changed: from its new flat pattern back to the old one.
#include <vector>

#include "runtime/design/panel.hpp"

namespace garment::modeller {

/// Points of a redrawn panel on the panel as it was drawn before: edges go to the edges of the same names at
/// equal fractions of length, the inside follows by mean value coordinates of the outline (Floater, "Mean
/// value coordinates", 2003). Lines inside that both have go to one another too, with what lies about them (inverse
/// distances: Shepard, "A two-dimensional interpolation function for irregularly-spaced data", 1968): on them other panels are
/// sewn, and cloth is folded. Where nothing moved, or the outline's edges have other names, every point stays itself.
class PatternWarp {
 public:
  PatternWarp(const design::Panel& before, const design::Panel& now);

  bool identity() const { return move_.empty(); }
  /// `p` and the result in panel coordinates, m.
  design::Point2 operator()(const design::Point2& p) const;

 private:
  struct Sample {
    design::Point2 at, off;  ///< m, of a line; by how much the outline's way back misses the old line
    double length = 0;       ///< m, of the line that it stands for
  };
  design::Point2 by_outline(const design::Point2& p) const;
  void add_lines(const design::Panel& before, const design::Panel& now);

  std::vector<design::Point2> at_,
      move_;  ///< corners of the new outline as a polygon, and the way back of each
  std::vector<Sample> samples_;  ///< of lines, and of the outline where there are lines
};

}  // namespace garment::modeller
