#pragma once
// Names for what the pattern files only number: edges and seams, from labels, stitches, and where the pieces
// stand.
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/design/garment.hpp"

namespace garment::io {

/// Letters, digits and underscores of `name`, starting with a letter; other characters become underscores.
/// `fallback` (an identifier) where nothing is left, and as prefix where the name starts with a digit.
std::string identifier(std::string_view name, std::string_view fallback);

/// `base`, or with the first free number `base_2`, `base_3`, ... behind it; the result joins `taken`.
std::string unique_name(const std::string& base, std::set<std::string>& taken);

/// Labels of edges: `labels[panel][edge]`, "" where there is none.
using EdgeLabels = std::vector<std::vector<std::string>>;

/// Names every edge of every panel (unique within it), marks edges without a seam as free, and names the
/// seams (unique in `taken`, which they join). Panels are rigidly placed. Names say where an edge is worn
/// (hem, waist, neck, side, shoulder, armhole, inseam, center_front, ...), left and right the wearer's; what
/// fits no rule is `to_PANEL`.
void name_edges_and_seams(design::Garment& garment, const EdgeLabels& labels, std::set<std::string>& taken);

}  // namespace garment::io
