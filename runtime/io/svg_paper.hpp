#pragma once
// A sheet of paper in millimetres, y downwards, that becomes an SVG 1.1 file.
#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace garment::io {

using Point = Eigen::Vector2d;

/// Axis-aligned box, empty while low > high.
struct Extent {
  Point low{1e300, 1e300}, high{-1e300, -1e300};
  void grow(const Point& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Point size() const { return high - low; }
};

struct Pen {
  std::string stroke = "#222";
  double width = 0.3;  ///< mm
  std::string dash;    ///< "3 2", or empty
  std::string fill = "none";
};

enum class Anchor { start, middle, end };

struct Lettering {
  double size = 4;  ///< height of the letters, mm
  Anchor anchor = Anchor::start;
  double turn = 0;  ///< degrees clockwise about the point
  bool bold = false;
  std::string color = "#222";
};

class SvgPaper {
 public:
  void line(const Point& a, const Point& b, const Pen& pen);
  void polyline(const std::vector<Point>& points, bool closed, const Pen& pen);
  void circle(const Point& center, double radius, const Pen& pen);
  /// `at` is the middle of the letters' height.
  void text(const Point& at, std::string_view text, const Lettering& lettering);
  void begin_group(std::string_view id);
  void end_group();
  /// An attribute of the next polyline, for readers of the file.
  void data(std::string_view name, std::string_view value);

  /// The whole file. `size` in mm is both the printed size and the view box.
  std::string finish(const Point& size, std::string_view title) const;

 private:
  std::string body_, data_;
};

/// Roughly how wide a text prints, mm.
double lettering_width(std::string_view text, double size);

}  // namespace garment::io
