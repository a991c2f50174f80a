#pragma once
// Splines and ellipses of a drawing made into points: what DXF has beside lines and arcs.
#include <optional>
#include <string>
#include <vector>

#include "runtime/geometry/curve.hpp"

namespace garment::io {

/// Farthest that the points' polygon lies from a curve, as a part of the diagonal of its control points' box:
/// 0.01 mm where that is a metre.
inline constexpr double kDxfFlatness = 1e-5;

/// A SPLINE as it stands in the file, in its units.
struct DxfSpline {
  int degree = 3;
  bool closed = false;
  std::vector<double> knots, weights;  ///< without knots: uniform, both ends clamped; without weights: all 1
  std::vector<geometry::Point2> control;
  std::vector<geometry::Point2> fit;  ///< what it runs through, where there are no control points
  geometry::Point2 start{0, 0}, end{0, 0};  ///< directions at the ends, for `fit`; zero: none
};

/// Point at t: centre + cos t major + sin t minor, minor = ratio major turned left (right where `flipped`).
struct DxfEllipse {
  geometry::Point2 centre{0, 0}, major{0, 0};
  double ratio = 1, from = 0, to = 6.283185307179586;  ///< rad
  bool flipped = false;                                ///< the drawing plane is seen from behind
};

struct DxfFlattened {
  std::vector<geometry::Point2> points;  ///< a closed one repeats no point
  bool closed = false;
  std::string fault;  ///< what is wrong with it, found and expected; there are no points then
};

/// The curve that de Boor's algorithm gives, cut into Bézier segments (its blossoms at the knots), which are
/// halved until their control polygons, and so the curve, lie within kDxfFlatness of the chord. Through fit
/// points: the cubic spline with continuous curvature over the lengths of chords, no curvature at free ends.
DxfFlattened flattened(const DxfSpline& spline);

/// The same for an ellipse or a part of it, as rational quadratic segments of a quarter turn at most.
DxfFlattened flattened(const DxfEllipse& ellipse);

}  // namespace garment::io
