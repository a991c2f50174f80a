#pragma once
// Changes of a drawn panel that leave it one piece: edges moved, the panel slashed and spread, scaled.
#include <functional>
#include <string>
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/design/panel.hpp"

namespace garment::design {

/// Moves what is named (edges of the outline or of holes, whole holes, lines, points) by `by`, metres. Corners of moved
/// edges move; an edge with one moved corner is drawn along with it (see geometry::warped). Lines that end on a changed
/// edge follow it; notches, darts and pleats keep their fraction of the edge. Corners on the straight edge `fold` ("" where
/// there is none) stay on it, unless it is named itself. False where the panel has nothing of that name.
bool move(Panel& panel, const std::vector<std::string>& names, const Point2& by, const std::string& fold = "");

/// Cuts the panel along its line `line`, from edge to edge, and spreads the parts: by `at_start` at the line's start and
/// `at_end` at its end, metres >= 0 (0 is a hinge). The part that holds the edge `fixed`, or where there is none the
/// start of the first edge, stays; the other moves away from it without change of shape. The cut edges are joined by
/// straight pieces over the gap. Findings: G0434 (the line does not run from edge to edge), G0435 (something lies across
/// the cut).
Findings slash(Panel& panel, const std::string& line, double at_start, double at_end, const std::string& fixed);

/// Scales everything about the origin: shapes, places, widths and depths of darts and pleats. Allowances stay.
void scale(Panel& panel, double factor_x, double factor_y);

namespace detail {
constexpr double kOnEdge = 1e-5;  // m, a line that ends this near an edge ends on it

/// Gives `edge` another course; `place` says where an arc length of the old one went. What stands on it follows.
void redraw(Panel& panel, Edge& edge, const geometry::Curve& course, const std::function<double(double)>& place);
}  // namespace detail

}  // namespace garment::design
