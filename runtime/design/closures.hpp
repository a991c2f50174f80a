#pragma once
// What opens and shuts: buttons, zips; and stitches that hold layers together.
#include <string>
#include <vector>

#include "runtime/design/edge_part.hpp"

namespace garment::design {

struct ButtonHole {
  int panel = -1;
  Point2 point{0, 0};
};

struct Button {
  enum class Kind : std::uint8_t { sew_through, hook, snap };
  std::string name;
  OriginId origin;
  int panel = -1;                 ///< sewn on
  Point2 point{0, 0};
  std::vector<ButtonHole> holes;  ///< from the button downwards
  double mass = 1e-3;             ///< kg
  double diameter = 0.015;        ///< m
  double shank = 3e-3;            ///< m of thread between the cloth and the button
  Kind kind = Kind::sew_through;
};

/// Two edges that a slider joins. Corresponding points are at equal fractions; the first side runs as it was drawn, and
/// the last `open` of it, at its drawn end, is undone.
struct Zip {
  std::string name;
  OriginId origin;
  std::vector<EdgePart> sides[2];  ///< the start of one meets the start of the other
  OriginId side_origin[2];
  double open = 0;                 ///< 0 .. 1
};

/// Stitches that hold two places together without a seam: along two lines, or over a region of two panels.
struct Tack {
  std::string name;
  OriginId origin;
  int panel[2] = {-1, -1};
  std::vector<EdgePart> line;  ///< on panel[0]; empty with a region
  int region = -1;
};

}  // namespace garment::design
