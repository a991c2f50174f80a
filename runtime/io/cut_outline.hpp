#pragma once
// Outlines as formats without darts and parts of edges need them: darts cut away, edges divided where a seam
// begins, ends, or passes a corner on its other side.
#include <string>
#include <vector>

#include "runtime/design/garment.hpp"

namespace garment::io {

/// One edge of a divided outline, in the direction the panel's outline is drawn.
struct CutEdge {
  int edge = -1;            ///< index into Panel::edges
  double from = 0, to = 0;  ///< the stretch of it, m; of a dart's leg: 0, its length
  int dart = -1;            ///< index into Panel::darts of a leg, else -1
  geometry::Curve curve;    ///< the edge's own curve where it is whole
};

struct CutPanel {
  std::vector<CutEdge> edges;
};

/// Two divided edges sewn together: start to end, or start to start.
struct CutStitch {
  int panel[2] = {-1, -1};
  int edge[2] = {-1, -1};  ///< index into CutPanel::edges
  bool start_to_start = false;
  int seam = -1;  ///< index into Garment::seams; -1: the legs of a dart
};

struct CutGarment {
  std::vector<CutPanel> panels;
  std::vector<CutStitch> stitches;  ///< in the order of the seams, then of the darts
  std::vector<int> left_out;        ///< seams (indices) that are not, or not wholly, in the stitches
};

/// Divides all outlines of a garment. Corresponding points of a seam's sides are at equal fractions of sewn
/// length. A seam of three sides gives two stitches. Parts on holes and interior lines are left out.
CutGarment cut_garment(const design::Garment& garment);

/// Where the tip of a dart lies: as stated, or `depth` from the middle of its mouth square to its edge, into
/// the panel.
design::Point2 dart_tip(const design::Panel& panel, const design::EdgeDart& dart);

/// Index of the outline edge called `name`, -1 where there is none.
int outline_edge(const design::Panel& panel, const std::string& name);

}  // namespace garment::io
