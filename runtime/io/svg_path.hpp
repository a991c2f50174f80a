#pragma once
// Path data and transforms of SVG 1.1 as curves.
#include <optional>
#include <string_view>
#include <vector>

#include "runtime/geometry/curve.hpp"

namespace garment::io {

using geometry::Curve;
using geometry::Point2;

/// x -> linear x + shift, user units.
struct SvgMotion {
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  Point2 shift{0, 0};
  Point2 operator()(const Point2& p) const { return linear * p + shift; }
  SvgMotion operator*(const SvgMotion& inner) const { return {linear * inner.linear, (*this)(inner.shift)}; }
};

/// A `transform` attribute; nothing where it is none.
std::optional<SvgMotion> svg_transform(std::string_view text);

/// One run of a path from `M` on.
struct SvgRun {
  std::vector<Curve> curves;  ///< each begins where the one before ends
  bool closed = false;
};

/// Path data; coordinates as they stand. At most `most` curves. Reads up to the first fault, as SVG asks for:
/// `good` says whether there was none. Elliptical arcs become cubics, circular ones arcs.
std::vector<SvgRun> svg_path(std::string_view data, std::size_t most, bool& good);

/// The run moved; a circular arc stays one where the motion keeps circles, else it becomes cubics.
SvgRun moved(const SvgRun& run, const SvgMotion& motion);

/// An ellipse as a closed run of four arcs or cubics.
SvgRun svg_ellipse(const Point2& centre, double rx, double ry);

/// Numbers separated by blanks and commas up to the first thing that is none.
std::vector<double> svg_numbers(std::string_view text, std::size_t most);

}  // namespace garment::io
