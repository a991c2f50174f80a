#pragma once
// ASCII DXF as pairs of group code and value, made into blocks of entities: the first stage of the DXF
// reader. Knows nothing of garments. DXF reference of AutoCAD R12 (AC1009), with what later editions add to
// it.
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/geometry/curve.hpp"
#include "runtime/io/pattern_report.hpp"

namespace garment::io {

using geometry::Point2;

struct DxfLimits {
  std::size_t max_bytes = 64u << 20;
  std::size_t max_points = 2'000'000;  ///< of the file; entities count as one more
  std::size_t max_blocks = 8192;
  int max_depth = 8;            ///< of blocks in blocks
  double max_coordinate = 1e7;  ///< units of the file
};

struct DxfVertex {
  Point2 point{0, 0};
  double bulge = 0;  ///< tangent of a quarter of the angle that the arc to the next vertex turns by
};

/// An entity as it is drawn; splines and ellipses are polylines by the time the file is read.
struct DxfEntity {
  enum class Kind { line, polyline, point, text, arc, circle, insert, spline, ellipse, other } kind = Kind::other;
  std::string layer, text;  ///< text: also the name of an inserted block
  std::size_t line = 0;     ///< of the file, from 1
  std::vector<DxfVertex> points;
  bool closed = false;
  double radius = 0, from = 0, to = 360;  ///< degrees, counter-clockwise
  Point2 scale{1, 1};                     ///< of an insert
  double turn = 0;                        ///< degrees, of an insert
};

struct DxfBlock {
  std::string name;
  std::size_t line = 0;
  Point2 base{0, 0};
  std::vector<DxfEntity> entities;
};

struct DxfDocument {
  std::map<std::string, double> header;  ///< numeric variables: "$INSUNITS", "$MEASUREMENT"
  std::vector<DxfBlock> blocks;
  std::vector<DxfEntity> entities;
  std::map<std::string, std::size_t> passed_over;  ///< entities of kinds that are not read, how many of each
};

/// Reads the file, splines and ellipses flattened (dxf_curves.hpp); nothing, and an error in `report` with the line of the file, where it is none: binary
/// (G0960), pairs or numbers out of order (G0961), too large (G0962). A file that breaks off is read as far
/// as it goes, with a warning (G0963); a spline or an ellipse that cannot be is left out with another (G0969). Text is made UTF-8: what is not is taken as Latin-1, and \U+00E9 is
/// decoded.
std::optional<DxfDocument> parse_dxf(std::string_view bytes, const DxfLimits& limits, PatternReport& report);

/// The entities of a block with what is inserted into it, in the block's coordinates.
std::vector<DxfEntity> flattened(const DxfDocument& document, const std::vector<DxfEntity>& entities,
                                 const DxfLimits& limits, PatternReport& report);

/// The course of a line, polyline, arc or circle as points with bulges; a closed one repeats no point.
std::vector<DxfVertex> course(const DxfEntity& entity, bool& closed);

}  // namespace garment::io
