#pragma once
// Where a panel is cut: the stitch lines with their allowances.
#include <vector>

#include "runtime/design/panel.hpp"

namespace garment::io {

/// A closed polyline, metres, panel coordinates.
using CutLine = std::vector<design::Point2>;

/// The cut lines of the outline and of each hole that has an allowance somewhere: every edge moved outwards by its own
/// width, neighbours mitred (bevelled where the mitre would reach out further than twice the width) or cut where they
/// cross. Edges without allowance are cut on the stitch line. Darts are cut as their mouth lies.
std::vector<CutLine> cut_lines(const design::Panel& panel);

}  // namespace garment::io
