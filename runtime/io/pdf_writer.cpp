#include "runtime/io/pdf_writer.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "runtime/base/number.hpp"
#include "runtime/io/pattern_sheet.hpp"
#include "runtime/io/pdf_page.hpp"

namespace garment::io {
namespace {

constexpr PaperSize kPapers[] = {{"A4", 210, 297}, {"A3", 297, 420},  {"A2", 420, 594},
                                 {"A1", 594, 841}, {"A0", 841, 1189}, {"letter", 215.9, 279.4}};
constexpr double kUnprinted = 10;   // mm that a printer leaves blank
constexpr double kOverlap = 10;     // mm that neighbours share
constexpr double kTestSquare = 50;  // mm, side of the test square
const Pen kFrame{"#8a8f99", 0.25, "", "none"}, kInk{"#1b1d22", 0.35, "", "none"},
    kGlue{"#b4b8c0", 0.25, "2 2", "none"};
const char* const kGrey = "#6a707b";
const char* const kBlack = "#1b1d22";

/// Which tiles the drawing touches. Nothing is kept of it.
class Footprint final : public Paper {
 public:
  Footprint(const Point& step, const Point& window, int columns, int rows)
      : step_(step), window_(window), columns_(columns), rows_(rows) {}
  const std::set<std::pair<int, int>>& tiles() const { return tiles_; }  ///< (row, column)

  void polyline(const std::vector<Point>& points, bool closed, const Pen& pen) override {
    for (std::size_t k = 0; k + (closed ? 0 : 1) < points.size(); ++k) {
      Extent box;
      box.grow(points[k]), box.grow(points[(k + 1) % points.size()]);
      mark(box);
    }
    if (pen.fill == "none") return;
    Extent all;  // of a filled piece the inside counts too: a page amidst it carries its grain and its name
    for (const Point& p : points) all.grow(p);
    mark(all);
  }
  void circle(const Point& center, double radius, const Pen&) override {
    Extent box;
    box.grow(center - Point(radius, radius)), box.grow(center + Point(radius, radius));
    mark(box);
  }
  void text(const Point&, std::string_view, const Lettering&) override {}
  void begin_group(std::string_view) override {}
  void end_group() override {}

 private:
  void mark(const Extent& box) {
    auto first = [&](double low, int axis) {
      return std::max(0, static_cast<int>(std::ceil((low - window_[axis]) / step_[axis])));
    };
    auto last = [&](double high, int axis, int n) {
      return std::min(n - 1, static_cast<int>(std::floor(high / step_[axis])));
    };
    for (int r = first(box.low[1], 1); r <= last(box.high[1], 1, rows_); ++r)
      for (int c = first(box.low[0], 0); c <= last(box.high[0], 0, columns_); ++c) tiles_.insert({r, c});
  }

  Point step_, window_;
  int columns_, rows_;
  std::set<std::pair<int, int>> tiles_;
};

std::string row_letter(int row) {
  std::string out;
  for (int k = row + 1; k > 0; k = (k - 1) / 26)
    out.insert(out.begin(), static_cast<char>('A' + (k - 1) % 26));
  return out;
}
std::string tile_name(const std::pair<int, int>& tile) {
  return row_letter(tile.first) + std::to_string(tile.second + 1);
}

class PdfPattern {
 public:
  PdfPattern(const design::Garment& garment, const model::Model* model, const PaperSize& paper)
      : garment_(garment),
        page_(paper.width, paper.height),
        window_(page_ - Point(2 * kUnprinted, 2 * kUnprinted)),
        step_(window_ - Point(kOverlap, kOverlap)),
        sheet_(garment, model, true, row_width()),
        columns_(count(0)),
        rows_(count(1)),
        file_(title()) {}

  std::string write() {
    Footprint footprint(step_, window_, columns_, rows_);
    sheet_.draw(footprint, Point(0, 0));
    tiles_ = footprint.tiles();
    write_cover();
    for (const auto& tile : tiles_) write_tile(tile);
    return file_.finish();
  }

 private:
  std::string title() const { return garment_.title.empty() ? "pattern" : garment_.title; }

  /// As many whole pages as a table is wide: 1.2 m, but no fewer than one.
  double row_width() const { return std::max(1.0, std::floor(1200 / step_[0])) * step_[0]; }
  int count(int axis) const {
    return std::max(1, static_cast<int>(std::ceil((sheet_.size()[axis] - kOverlap) / step_[axis] - 1e-9)));
  }

  void letter(const Point& at, const std::string& text, double size, const char* color = kBlack,
              bool bold = false, Anchor anchor = Anchor::start) {
    file_.text(at, text, {size, anchor, 0, bold, color});
  }
  void box(const Extent& e, const Pen& pen) {
    file_.polyline({e.low, {e.high[0], e.low[1]}, e.high, {e.low[0], e.high[1]}}, true, pen);
  }

  void write_cover() {
    file_.add_page(page_);
    const double left = kUnprinted + 5, right = page_[0] - kUnprinted - 5;
    Point at(left, kUnprinted + 10);
    letter(at, title(), 8, kBlack, true);
    at[1] += 10;
    letter(at,
           std::to_string(tiles_.size()) + (tiles_.size() == 1 ? " page" : " pages") +
               " after this one, rows A to " + row_letter(tiles_.empty() ? 0 : tiles_.rbegin()->first) +
               ". Print at 100 %, without fitting to the page.",
           3.6, kGrey);
    at[1] += 10;
    box({at, at + Point(kTestSquare, kTestSquare)}, kInk);
    letter(at + Point(kTestSquare / 2, kTestSquare / 2 - 4), "50 mm", 5, kBlack, true, Anchor::middle);
    letter(at + Point(kTestSquare / 2, kTestSquare / 2 + 3), "measure this square", 3.2, kGrey, false,
           Anchor::middle);
    letter(at + Point(kTestSquare / 2, kTestSquare / 2 + 8), "before you cut", 3.2, kGrey, false,
           Anchor::middle);
    const std::vector<std::string> how = {
        sheet_.has_allowances() ? "Thick lines are stitch lines, thin lines around them cut lines."
                                : "Lines are stitch lines: add seam allowance.",
        "Trim each page along its frame, on the left and on top.",
        "Lay it over the strip of its neighbour, edge on dashes, and glue.",
        "Short strokes across an edge are notches: clip the allowance.",
        "Arrows show the grain. Letters in circles: seams, A to A.",
    };
    for (std::size_t k = 0; k < how.size(); ++k)
      letter(at + Point(kTestSquare + 10, 6 + 8.0 * static_cast<double>(k)), how[k], 3.6);
    at[1] += kTestSquare + 14;
    write_list(at, left, right);
    write_map(at, right);
  }

  void write_list(Point& at, double left, double right) {
    letter(at, "Cut list", 5.5, kBlack, true);
    at[1] += 8;
    const double columns[] = {left, left + 0.36 * (right - left), left + 0.56 * (right - left), right};
    for (const auto& [x, text, anchor] :
         {std::tuple{columns[0], "piece", Anchor::start}, std::tuple{columns[1], "cut", Anchor::start},
          std::tuple{columns[2], "fabric", Anchor::start},
          std::tuple{columns[3], "size with allowance", Anchor::end}})
      file_.text({x, at[1]}, text, {3.2, anchor, 0, false, kGrey});
    at[1] += 3.5;
    file_.line({left, at[1]}, {right, at[1]}, kFrame);
    at[1] += 4;
    for (const CutRow& row : cut_list(garment_)) {
      if (at[1] > page_[1] - kUnprinted - 30) {  // a garment of very many pieces
        file_.add_page(page_);
        at = Point(left, kUnprinted + 10);
      }
      letter({columns[0], at[1]}, row.piece, 3.8);
      letter({columns[1], at[1]}, row.pair ? "2, a pair" : std::to_string(row.count), 3.8);
      letter({columns[2], at[1]}, row.fabric, 3.8);
      letter({columns[3], at[1]},
             format_number(std::round(row.size[0])) + " x " + format_number(std::round(row.size[1])) + " mm",
             3.8, kBlack, false, Anchor::end);
      at[1] += 6;
    }
    at[1] += 8;
  }

  /// The sheet small, with the frames of its tiles.
  void write_map(const Point& at, double right) {
    const double room = page_[1] - kUnprinted - 12 - at[1];
    const Point whole = step_.cwiseProduct(Point(columns_, rows_));
    const double scale = std::min((right - at[0]) / whole[0], (room - 8) / whole[1]);
    if (room < 30 || scale < 0.01) return;
    letter(at, "How the pages lie", 5.5, kBlack, true);
    const Point corner = at + Point(0, 8);
    ScaledPaper small(file_, corner, scale);
    sheet_.draw(small, Point(0, 0));
    for (const auto& [row, column] : tiles_) {
      const Point low = corner + scale * step_.cwiseProduct(Point(column, row));
      box({low, low + scale * step_}, kFrame);
      letter(low + Point(1.2, 2.6), tile_name({row, column}), 3, kGrey, true);
    }
  }

  void write_tile(const std::pair<int, int>& tile) {
    file_.add_page(page_);
    const Point corner = step_.cwiseProduct(Point(tile.second, tile.first)), border(kUnprinted, kUnprinted);
    file_.begin_window({border, border + window_}, border - corner);
    sheet_.draw(file_, Point(0, 0));
    file_.end_window();
    box({border, border + window_}, kFrame);
    const auto there = [&](int dr, int dc) { return tiles_.contains({tile.first + dr, tile.second + dc}); };
    const Point end = border + window_;
    if (there(0, 1)) file_.line({end[0] - kOverlap, border[1]}, {end[0] - kOverlap, end[1]}, kGlue);
    if (there(1, 0)) file_.line({border[0], end[1] - kOverlap}, {end[0], end[1] - kOverlap}, kGlue);
    letter(border + Point(4, 6), tile_name(tile), 7, kGrey, true);
    const Point middle = border + 0.5 * window_;
    auto neighbour = [&](int dr, int dc, const Point& at) {
      if (there(dr, dc))
        letter(at, tile_name({tile.first + dr, tile.second + dc}), 3.2, kGrey, false, Anchor::middle);
    };
    neighbour(-1, 0, {middle[0], border[1] - 4});
    neighbour(1, 0, {middle[0], end[1] + 4});
    neighbour(0, -1, {border[0] - 5, middle[1]});
    neighbour(0, 1, {end[0] + 5, middle[1]});
    letter({border[0], end[1] + 4}, title(), 3.2, kGrey);
  }

  /// The drawing's outlines on another paper, smaller; letters and marks are left out.
  class ScaledPaper final : public Paper {
   public:
    ScaledPaper(Paper& on, const Point& corner, double scale) : on_(on), corner_(corner), scale_(scale) {}
    void polyline(const std::vector<Point>& points, bool closed, const Pen& pen) override {
      if (!closed || pen.fill == "none" || pen.fill == pen.stroke) return;
      const bool hole = std::exchange(outlined_, true);
      std::vector<Point> small;
      for (const Point& p : points) small.push_back(corner_ + scale_ * p);
      on_.polyline(small, true, {"#6a707b", 0.2, "", hole ? "#ffffff" : "#eceae5"});
    }
    void circle(const Point&, double, const Pen&) override {}
    void text(const Point&, std::string_view, const Lettering&) override {}
    void begin_group(std::string_view) override { outlined_ = false; }
    void end_group() override {}

   private:
    bool outlined_ = false;  ///< the piece's outline was drawn: what is filled after it is a hole
    Paper& on_;
    Point corner_;
    double scale_;
  };

  const design::Garment& garment_;
  Point page_, window_, step_;
  PatternSheet sheet_;
  int columns_, rows_;
  PdfFile file_;
  std::set<std::pair<int, int>> tiles_;
};

}  // namespace

std::optional<PaperSize> find_paper(std::string_view name) {
  auto same = [&](std::string_view known) {
    return std::equal(known.begin(), known.end(), name.begin(), name.end(),
                      [](char a, char b) { return (a | 32) == (b | 32); });
  };
  for (const PaperSize& paper : kPapers)
    if (same(paper.name)) return paper;
  return std::nullopt;
}

std::string paper_names() {
  std::string out;
  for (const PaperSize& paper : kPapers) out += (out.empty() ? "" : ", ") + std::string(paper.name);
  return out;
}

std::string write_pattern_pdf(const design::Garment& garment, const model::Model* model,
                              const PaperSize& paper) {
  return PdfPattern(garment, model, paper).write();
}

}  // namespace garment::io
