#include "runtime/io/flat_layout.hpp"

#include <cmath>

namespace garment::io {

void lay_flat(design::Garment& garment) {
  constexpr double kGap = 0.05;
  double at = 0;
  for (design::Panel& panel : garment.panels) {
    design::Point2 low(1e300, 1e300), high(-1e300, -1e300);
    for (const design::Edge& edge : panel.edges)
      for (const design::Point2& p : edge.curve.polyline(1e-4))
        low = low.cwiseMin(p), high = high.cwiseMax(p);
    // To a tenth of a micrometre: a shift by a round number keeps round numbers round.
    for (int axis = 0; axis < 2; ++axis) low[axis] = std::round(low[axis] * 1e7) / 1e7;
    const Eigen::Isometry2d shift(Eigen::Translation2d(-low.x(), -low.y()));
    for (auto* edges : {&panel.edges, &panel.hole_edges, &panel.lines})
      for (design::Edge& edge : *edges) edge.curve = edge.curve.transformed(shift);
    for (design::InteriorPoint& point : panel.points) point.point -= low;
    panel.placement.kind = design::Placement::Kind::rigid;
    panel.placement.translation = {std::round(at * 1e3) / 1e3, 0, 0};
    at += high.x() - low.x() + kGap;
  }
}

}  // namespace garment::io
