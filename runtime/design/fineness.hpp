#pragma once
// How fine the grid of a panel must be.
#include <algorithm>
#include <cmath>

#include "runtime/design/panel.hpp"

namespace garment::design {

inline constexpr double kFinestResolution = 1e-3, kCoarsestResolution = 0.1;  ///< m, of a panel's grid

/// Half the mean width of an outline, seen as a strip: its area over its length, m.
inline double half_mean_width(const Panel& panel) {
  double area = 0, perimeter = 0;
  for (const Edge& edge : panel.edges) {
    area += edge.curve.area_term();
    perimeter += edge.curve.length();
  }
  return perimeter > 0 ? std::fabs(area) / perimeter : 0;
}

/// The resolution to advise where `h` is too coarse for a strip of that half width: two spacings across, in tenths of a
/// millimetre, m.
inline double fitting_resolution(double half_width, double h) {
  return std::floor(std::min(half_width, 0.7 * h) * 1e4 + 1e-6) / 1e4;
}

}  // namespace garment::design
