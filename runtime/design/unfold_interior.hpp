#pragma once
// The inside of a panel on the fold: lines, holes, points, slits and darts, opened with it.
#include <string>

#include "runtime/design/panel.hpp"

namespace garment::design {

/// Adds to `whole` what lies inside `half`: as drawn under names with `drawn` before them ("left."), and mirrored in
/// x = fold_x with `mirrored` before them. Lines keep their drawn direction in both halves. What lies on the fold is
/// there once, under its plain name. A hole with one edge along the fold becomes one hole: its other edges as drawn
/// from the fold's end round to its start, then their images walked back; the hole keeps its plain name.
void unfold_interior(const Panel& half, const std::string& drawn, const std::string& mirrored, double fold_x,
                     Panel& whole);

/// True if the whole curve lies within 1e-6 m of x = fold_x.
bool on_fold(const geometry::Curve& curve, double fold_x);
bool on_fold(const Point2& point, double fold_x);

/// True if `edge` of `half` belongs to a hole that becomes one hole with its image.
bool in_joined_hole(const Panel& half, const std::string& edge, double fold_x);

}  // namespace garment::design
