#pragma once
// A sheet of paper that becomes an SVG 1.1 file.
#include "runtime/io/paper.hpp"

namespace garment::io {

class SvgPaper final : public Paper {
 public:
  void polyline(const std::vector<Point>& points, bool closed, const Pen& pen) override;
  void circle(const Point& center, double radius, const Pen& pen) override;
  void text(const Point& at, std::string_view text, const Lettering& lettering) override;
  void begin_group(std::string_view id) override;
  void end_group() override;
  void data(std::string_view name, std::string_view value) override;

  /// The whole file. `size` in mm is both the printed size and the view box.
  std::string finish(const Point& size, std::string_view title) const;

 private:
  std::string body_, data_;
};

}  // namespace garment::io
