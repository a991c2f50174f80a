#pragma once
// Curves under maps of the plane.
#include <vector>

#include "runtime/geometry/curve.hpp"

namespace garment::geometry {

/// The curve with its start moved by `at_start` and its end by `at_end`; what lies between moves in proportion to its
/// way along the chord (a curve without chord moves as its start does). Arcs keep their shape: bulge to chord.
Curve warped(const Curve& curve, const Point2& at_start, const Point2& at_end);

/// x -> factor_x x, y -> factor_y y, both positive. Under unequal factors arcs become cubics, within 1e-6 of their
/// radius.
Curve stretched(const Curve& curve, double factor_x, double factor_y);

/// The piece from arc length `from` to `to` (from < to); all of it is the curve itself.
Curve piece_of(const Curve& curve, double from, double to);

/// One curve along several that follow each other: a line where all lie on one.
Curve joined(const std::vector<Curve>& links);

}  // namespace garment::geometry
