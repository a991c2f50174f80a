#pragma once
// What lies on a panel: fused and basted layers, pads, other panels.
#include <string>
#include <vector>

#include "runtime/design/seam.hpp"

namespace garment::design {

/// A cloth joined to the whole surface of a panel, or of a region of it.
struct Layer {
  std::string name;
  OriginId origin;
  int fabric = 0;               ///< index into Garment::fabrics
  int panel = -1;
  int region = -1;              ///< index into Garment::regions; -1: the whole panel
  bool fused = true;            ///< glued; otherwise basted
  double grain_angle = 0;       ///< of its warp, from +y, counter-clockwise, rad
  Facing side = Facing::back;   ///< side of the panel on which it lies
  int order = 0;                ///< place on its side, from the panel outwards: 0 lies on the panel itself
  int above = -1;               ///< index into Garment::layers, as stated: the layer under this one
};

/// A soft piece of some thickness on a panel: a shoulder pad. `thickness` runs from the region's innermost place to its
/// border at equal steps.
struct Pad {
  std::string name;
  OriginId origin;
  int panel = -1;
  int region = -1;               ///< -1: round `centre`
  Point2 centre{0, 0};
  double radius = 0;             ///< m, without a region
  std::vector<double> thickness; ///< m
  Facing side = Facing::back;
};

/// Panel `panel` lies over (towards the face of) or under (towards the back of) panel `other`.
struct Stacking {
  OriginId origin;
  int panel = -1, other = -1;
  bool over = true;
};

}  // namespace garment::design
