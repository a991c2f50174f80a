#pragma once
// The curve kinds of the pattern files: none, quadratic, cubic, circle, and the older plain pair.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "runtime/geometry/curve.hpp"
#include "runtime/io/pattern_panel.hpp"

namespace garment::io {

/// Shape of an edge from `start` to `end` (metres) as `curvature` (null for a missing key) says it. Control
/// points (a, b) of the edge's own frame are start + a d + b q with d = end - start, q = (-dy, dx). A circle
/// is [radius, large arc?, right?]; right = 1 sweeps counter-clockwise. `where` names the edge in messages.
std::optional<geometry::Curve::Shape> read_pattern_curve(
    const nlohmann::json* curvature, const geometry::Point2& start, const geometry::Point2& end,
    const PatternUnits& units, const PatternLimits& limits, const std::string& where, PatternReport& report);

}  // namespace garment::io
