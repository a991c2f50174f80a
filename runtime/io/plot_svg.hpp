#pragma once
// A picture of a curve, as SVG.
#include <array>
#include <string>
#include <vector>

namespace garment::io {

/// Draws the points (x, y) in their order as one line, in axes with round ticks that reach over all of it; 0 is in where it is near. The
/// same input gives the same text. Without points: empty.
std::string plot_svg(const std::vector<std::array<double, 2>>& points, const std::string& x_label, const std::string& y_label);

}  // namespace garment::io
