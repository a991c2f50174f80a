#include "runtime/io/svg_writer.hpp"

#include <algorithm>

#include "runtime/io/pattern_sheet.hpp"
#include "runtime/io/svg_paper.hpp"

namespace garment::io {
namespace {

constexpr double kPageMargin = 20;  // mm

void draw_scale_bar(Paper& paper, const Point& at) {
  const Pen pen{"#1b1d22", 0.4, "", "none"};
  Pen filled = pen;
  filled.fill = "#1b1d22";
  for (int k = 0; k < 10; ++k) {
    const double x = at[0] + 10 * k;
    paper.polyline({{x, at[1]}, {x + 10, at[1]}, {x + 10, at[1] + 3}, {x, at[1] + 3}}, true,
                   k % 2 == 0 ? filled : pen);
  }
  paper.text(at + Point(0, 7), "0", {4, Anchor::middle, 0, false, "#1b1d22"});
  paper.text(at + Point(100, 7), "100 mm", {4, Anchor::middle, 0, false, "#1b1d22"});
}

/// Lines below one another; returns where the next would stand.
Point write_lines(Paper& paper, Point at, const std::vector<std::string>& lines, double& width) {
  for (const std::string& line : lines) {
    paper.text(at, line, {5, Anchor::start, 0, false, "#1b1d22"});
    width = std::max(width, lettering_width(line, 5));
    at[1] += 7.5;
  }
  return at;
}

std::string write(const design::Garment& g, const model::Model* model) {
  const PatternSheet sheet(g, model, false);
  SvgPaper paper;
  const Point origin(kPageMargin, kPageMargin + 22);
  const std::string title = g.title.empty() ? "pattern" : g.title;
  paper.text({kPageMargin, kPageMargin + 6}, title, {11, Anchor::start, 0, true, "#1b1d22"});
  sheet.draw(paper, origin);
  Point at(kPageMargin, origin[1] + sheet.size()[1] + 14);
  draw_scale_bar(paper, at);
  paper.text(at + Point(125, 2),
             sheet.has_allowances() ? "Thick outlines are stitch lines, thin ones outside cut lines. Lengths in mm."
                                    : "Outlines are stitch lines: add seam allowance. Lengths in mm.",
             {4.5, Anchor::start, 0, false, "#3c414b"});
  double width = std::max(sheet.size()[0], 260.0);
  at[1] += 20;
  at = write_lines(paper, at, seam_lines(g), width);
  at[1] += 5;
  at = write_lines(paper, at, cut_lines_of(g), width);
  return paper.finish(Point(width + 2 * kPageMargin, at[1] + kPageMargin), title);
}

}  // namespace

std::string write_pattern_svg(const design::Garment& garment) { return write(garment, nullptr); }

std::string write_pattern_svg(const design::Garment& garment, const model::Model& model) {
  return write(garment, &model);
}

}  // namespace garment::io
