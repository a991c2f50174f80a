#pragma once
// Curves beside a curve: allowances, facings, yokes.
#include <optional>

#include "runtime/geometry/curve.hpp"

namespace garment::geometry {

struct OffsetResult {
  std::optional<Curve> curve;  ///< nothing where there is no offset curve
  double at = 0;               ///< then: arc length where it fails, m
  bool tight = false;          ///< then: the curve bends there with a radius below the distance; else a corner is too sharp
};

/// The curve at `distance` metres to the left of `curve` (to the right where negative), walked the same way. Lines and
/// arcs stay lines and arcs; of other curves it is cubics within 1e-6 m. Corners are filled by prolonging both sides
/// straight until they meet, or cut where the sides cross.
OffsetResult offset_curve(const Curve& curve, double distance);

/// `curve` prolonged straight along its end tangents, `before` its start and `after` its end, metres >= 0.
Curve prolonged(const Curve& curve, double before, double after);

}  // namespace garment::geometry
