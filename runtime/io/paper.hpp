#pragma once
// What a pattern is drawn on: a sheet in millimetres, y downwards. One drawing, several outputs.
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

class Paper {
 public:
  virtual ~Paper() = default;
  void line(const Point& a, const Point& b, const Pen& pen) { polyline({a, b}, false, pen); }
  virtual void polyline(const std::vector<Point>& points, bool closed, const Pen& pen) = 0;
  virtual void circle(const Point& center, double radius, const Pen& pen) = 0;
  /// `at` is the middle of the letters' height.
  virtual void text(const Point& at, std::string_view text, const Lettering& lettering) = 0;
  /// What belongs together: a panel and all that is drawn on it.
  virtual void begin_group(std::string_view id) = 0;
  virtual void end_group() = 0;
  /// An attribute of the next polyline, for programs that read the file; nothing to see on paper.
  virtual void data(std::string_view /*name*/, std::string_view /*value*/) {}
};

/// Roughly how wide a text prints, mm.
double lettering_width(std::string_view text, double size);

}  // namespace garment::io
