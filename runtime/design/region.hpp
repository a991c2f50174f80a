#pragma once
// Parts of panels that are treated apart: made stiffer, heavier, pressed, fused.
#include <string>
#include <vector>

#include "runtime/design/edge_part.hpp"

namespace garment::design {

/// What a region looks like on one panel: a tree whose leaves are plain shapes.
struct RegionShape {
  enum class Kind : std::uint8_t {
    everywhere,
    nowhere,
    polygon,   ///< inside `points`, a closed loop
    circle,    ///< within `size` of points[0]
    near,      ///< within `size` of `parts` (all of them), or of points[0] where there are none
    above,     ///< y > size
    below,     ///< y < size
    left_of,   ///< to the left of `parts`, in the direction they are walked, straight on beyond their ends
    right_of,
    beyond,    ///< x > size where `sign` is positive, x < size where it is negative
    all_of,    ///< every child
    any_of,    ///< a child
    minus,     ///< the first child without the others
    opposite,  ///< not the child
  };
  Kind kind = Kind::everywhere;
  std::vector<RegionShape> children{};
  std::vector<Point2> points{};    ///< panel coordinates, m
  std::vector<EdgePart> parts{};   ///< of the same panel
  double size = 0;                 ///< m
  int sign = 1;
  /// On a panel that was drawn on the fold: the shape is that of the drawn half and holds for its mirror image too.
  /// +1 where the drawn half has the larger x, -1 where it has the smaller, 0: as it stands.
  int drawn_side = 0;
};

/// How cloth in a region differs from the cloth around; the factors of regions that overlap multiply.
struct RegionFactors {
  double stretch_warp = 1, stretch_weft = 1;  ///< on the tensile force at equal strain
  double shear = 1;
  double bend_warp = 1, bend_weft = 1;
  double twist = 1;
  double mass = 1;
  double friction = 1;
  double damping = 1;
  double thickness = 1;
  friend bool operator==(const RegionFactors&, const RegionFactors&) = default;
};
RegionFactors operator*(const RegionFactors& a, const RegionFactors& b);

/// Region on one panel.
struct RegionPart {
  int panel = -1;
  RegionShape shape;
};

struct Region {
  std::string name;
  OriginId origin;
  std::vector<RegionPart> parts;  ///< one for each panel
  RegionFactors factors{};
};

/// The part of an edge or line as a polyline in the direction walked, within 0.02 mm of the curve; points in panel coordinates.
std::vector<Point2> polyline_of(const Panel& panel, const EdgePart& part);

/// The whole outline as drawn: a polygon.
RegionShape outline_shape(const Panel& panel);

/// A shape made ready for questions. Curves are followed within 0.02 mm. Keeps nothing of the panel.
class RegionTest {
 public:
  RegionTest(const Panel& panel, const RegionShape& shape);

  /// True if the point (panel coordinates) lies in the shape; points on a border may fall to either side.
  bool contains(const Point2& p) const;
  /// Points of the shape's own drawing: where to look first for cloth in it.
  void collect_marks(std::vector<Point2>& marks) const;

 private:
  double distance_squared(const Point2& p) const;
  double side_of(const Point2& p) const;
  bool leaf_contains(const Point2& p) const;

  RegionShape::Kind kind_;
  std::vector<RegionTest> children_;
  std::vector<std::vector<Point2>> lines_;  // polylines; a point is one of length 1
  double size_ = 0, fold_x_ = 0;
  int sign_ = 1, drawn_side_ = 0;
  Point2 low_{0, 0}, high_{0, 0};  // box round the lines
};

}  // namespace garment::design
