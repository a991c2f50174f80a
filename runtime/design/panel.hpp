#pragma once
#include <optional>
#include <string>
#include <vector>

#include "runtime/base/origin.hpp"
#include "runtime/design/folds.hpp"
#include "runtime/geometry/curve.hpp"

namespace garment::design {

using geometry::Point2;

/// One edge of an outline, in the direction it was drawn. Halves of a panel on the fold are named "left.side", "right.side".
struct Edge {
  std::string name;
  OriginId origin;
  geometry::Curve curve;   ///< metres, panel face up, x right, y up
  bool free = false;       ///< marked `free`: needs no seam
  double allowance = 0;    ///< width of cloth outside the stitch line, m
};

/// A closed loop cut out of a panel; its edges are Panel::hole_edges[first .. first + count), in drawn order, either sense.
struct Hole {
  std::string name;
  OriginId origin;
  int first = 0, count = 0;
};

/// A named point inside a panel.
struct InteriorPoint {
  std::string name;
  OriginId origin;
  Point2 point{0, 0};
};

/// A cut along an interior line, Panel::lines[line]. Its ends stay closed.
struct Slit {
  std::string name;
  OriginId origin;
  int line = -1;
};

/// A mark on an edge, interior line or hole's edge, to be matched when sewing. `at` is an arc length in metres from the edge's drawn start.
struct Notch {
  std::string name;
  OriginId origin;
  std::string edge;
  double at = 0;
};

/// A dart that opens on an edge: the V between two legs is cut away and the legs are sewn together.
struct EdgeDart {
  std::string name;
  OriginId origin;
  std::string edge;
  double at = 0;       ///< arc length of the mouth's middle on the edge, m
  double width = 0;    ///< of the mouth, along the edge, m
  double depth = 0;    ///< from the mouth's middle square to the edge, m; unused when `apex` is given
  std::optional<Point2> apex;
};

/// Where and how a panel starts in space.
struct Placement {
  enum class Kind {
    none,     ///< from seams and attachments
    rigid,    ///< p3 = rotation * (x, y, 0) + translation
    on_part,  ///< wrapped onto the front, back or side of a body part, `edge` at `level`
    around,   ///< wrapped round a limb or the torso
  };
  Kind kind = Kind::none;
  OriginId origin;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  std::string body;            ///< name of the body
  std::string part;            ///< "front", "back", "left", "right", "arm.left", "leg.right", "torso", ...
  std::string edge, level;     ///< edge whose mean height comes to the level; empty: the panel's centre at the part's middle
  double offset = 0.01;        ///< distance from the body, m
  bool folded = false;         ///< starts folded in half
};

/// A flat piece of cloth. The outline is the stitch line, one closed loop in drawn order, either sense; the cloth's face
/// looks towards the reader. Panels on the fold arrive here unfolded (see unfold.hpp).
struct Panel {
  std::string name;
  OriginId origin;
  int fabric = 0;                  ///< index into Garment::fabrics
  std::vector<Edge> edges;
  std::vector<Edge> hole_edges;    ///< of all holes, hole by hole
  std::vector<Hole> holes;
  std::vector<Edge> lines;         ///< interior lines, in drawn direction
  std::vector<InteriorPoint> points;
  std::vector<Slit> slits;
  std::vector<Notch> notches;
  std::vector<EdgeDart> darts;
  std::vector<InsideDart> inside_darts;
  std::vector<LegDart> leg_darts;
  std::vector<Pleat> pleats;
  double grain_angle = 0;          ///< of the warp, from +y, counter-clockwise, rad
  double resolution = 0.01;        ///< grid spacing h, m
  std::optional<double> fold_x;    ///< x of the symmetry axis of an unfolded panel
  Placement placement;
  std::string label;               ///< "body", "leg", "arm" or empty; a hint of where it is worn
};

}  // namespace garment::design
