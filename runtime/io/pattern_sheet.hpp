#pragma once
// The flat pattern laid out on one sheet, to scale: what the SVG and the PDF share.
#include <string>
#include <vector>

#include "runtime/io/panel_drawing.hpp"
#include "runtime/model/model.hpp"

namespace garment::io {

/// One row of the cut list.
struct CutRow {
  std::string piece;
  int count = 1;      ///< pieces of cloth
  bool pair = false;  ///< the second is the first one's mirror image
  std::string fabric;
  Point size{0, 0};  ///< of the cut piece, allowances included, mm
};
/// The pieces in the order declared; `sleeve.left` and its mirror image `sleeve.right` are one row, `sleeve`.
std::vector<CutRow> cut_list(const design::Garment& garment);

class PatternSheet {
 public:
  /// All panels in rows, the tallest first, wider than high, or within `row_width` mm where it is given (a
  /// wider panel takes what it needs). `plain`, for a printer: white pieces, of a pair the left one alone.
  /// `model`, where given, tells areas and masses.
  PatternSheet(const design::Garment& garment, const model::Model* model, bool plain, double row_width = 0);

  Point size() const { return size_; }
  /// Draws the panels with the upper left corner of the sheet at `origin`.
  void draw(Paper& paper, const Point& origin) const;
  bool has_allowances() const { return has_allowances_; }

 private:
  std::vector<PanelDrawing> panels_;
  std::vector<Point> corners_;
  Point size_{0, 0};
  bool has_allowances_ = false;
};

/// "A   side_left:   front.side 573 mm   to   back.side 573 mm", one for each seam.
std::vector<std::string> seam_lines(const design::Garment& garment);
/// "sleeve: cut 2, a pair; shell; 412 x 355 mm", one for each row of the cut list.
std::vector<std::string> cut_lines_of(const design::Garment& garment);

}  // namespace garment::io
