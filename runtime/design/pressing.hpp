#pragma once
// What iron and starch leave in the cloth.
#include <optional>
#include <string>
#include <vector>

#include "runtime/design/seam.hpp"

namespace garment::design {

/// Pressed along a line: the cloth keeps the share `set` of the fold. In a region: it is shrunk, drawn out, flattened or
/// rolled. `factor` amplifies or weakens what remains.
struct Press {
  enum class Kind : std::uint8_t { fold, shrink, extend, flat, curl };
  std::string name;
  OriginId origin;
  Kind kind = Kind::fold;
  std::vector<EdgePart> line;  ///< of a fold; the axis of a curl
  int region = -1;             ///< of the other kinds; index into Garment::regions
  double angle = 0;            ///< of a fold: rad turned from flat, 0 .. pi
  Facing to = Facing::back;    ///< side to which it is folded
  double radius = 0;           ///< m, of the fold's edge or of the curl
  double set = 1;              ///< share of the fold that stays, 0 .. 1
  double warp = 0, weft = 0;   ///< of shrink and extend: share of the length taken away or added
  double factor = 1;
};

/// Starch in a region: bending and twist times `factor`, shear times its square root (measured starched cottons: bending
/// 1.5 to 10 times, shear 2 to 4 times; docs/physics.md).
struct Starch {
  OriginId origin;
  int region = -1;
  double factor = 1;
};

}  // namespace garment::design
