#pragma once
// Pattern pieces in a DXF file after AAMA-292 and ASTM D6673: what belongs to which piece and size, by layers
// and texts.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runtime/io/dxf_document.hpp"

namespace garment::io {

/// The layers of both standards, under the numbers that they share.
enum class DxfLayer : int {
  none = 0,
  boundary = 1,
  turn_points = 2,
  curve_points = 3,
  notches = 4,
  grade_reference = 5,
  mirror = 6,
  grain = 7,
  internal = 8,
  cutout = 11,
  drill = 13,
  sew = 14,
  annotation = 15,
};

/// The layer that a name means: its number ("1", "01", "L1"), or a word for it ("CUT", "SEWLINE", "GRAIN");
/// T-, castle-, check- and U-notches (80 to 83) are notches.
DxfLayer dxf_layer(const std::string& name);

/// Points with bulges, one after the other; a closed course goes from the last to the first.
struct DxfCourse {
  std::vector<DxfVertex> points;
  bool closed = false;
};

/// One piece in one size, units of the file.
struct DxfPiece {
  std::string name, size;
  std::size_t line = 0;                      ///< of the file
  std::map<std::string, std::string> facts;  ///< "quantity", "fabric", "annotation", ...: keys in lower case
  std::map<DxfLayer, std::vector<DxfCourse>> courses;
  std::map<DxfLayer, std::vector<Point2>> points;
};

struct DxfStyle {
  std::map<std::string, std::string> facts;  ///< "style name", "sample size", "units", ...
  std::vector<DxfPiece> pieces;              ///< of all sizes, in the order of the file
  std::vector<std::string> sizes;            ///< in the order of the file
};

/// The pieces of a document: one of each block with a boundary; without such blocks one of each closed
/// outline.
DxfStyle dxf_style(const DxfDocument& document, const DxfLimits& limits, PatternReport& report);

/// `text` in lower case (ASCII letters).
std::string lower(std::string text);

}  // namespace garment::io
