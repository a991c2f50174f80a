#pragma once
// Plane curves: the edges of panels. Arc length is the parameter that everyone else uses.
#include <Eigen/Geometry>
#include <memory>
#include <variant>
#include <vector>

namespace garment::geometry {

using Point2 = Eigen::Vector2d;

/// Of two vectors of the plane: positive where `b` lies to the left of `a`.
inline double cross(const Point2& a, const Point2& b) { return a.x() * b.y() - a.y() * b.x(); }

struct Line {};
/// One control point.
struct Quadratic {
  Point2 control;
};
/// Two control points; also what `tangents` becomes.
struct Cubic {
  Point2 control_1, control_2;
};
/// Circular arc. `bulge` is the signed sagitta in metres, positive to the left of the way walked; |bulge| may
/// exceed half the chord (then it is the large arc). Zero is a straight line.
struct Arc {
  double bulge = 0;
};
/// Centripetal Catmull-Rom spline through `points` (interior points only; the ends are the curve's ends).
struct Through {
  std::vector<Point2> points;
};

class Curve;
/// Curves that follow each other, each beginning where the one before ends; none of them a chain. See `chain`.
struct Chain {
  std::shared_ptr<const std::vector<Curve>> links;
};

/// A curve from `start` to `end`, metres. Value type; the arc-length table is made at construction, so it is
/// cheap to ask.
class Curve {
 public:
  using Shape = std::variant<Line, Quadratic, Cubic, Arc, Through, Chain>;

  Curve() = default;  ///< a line of no length at the origin
  /// Control points that are not finite, or beyond about 1e150 m, make a curve of no length at `start`.
  Curve(Point2 start, Point2 end, Shape shape = Line{});

  const Point2& start() const { return start_; }
  const Point2& end() const { return end_; }
  const Shape& shape() const { return shape_; }

  double length() const;
  /// Point at arc length `s` in [0, length] (clamped).
  Point2 point_at(double s) const;
  /// Unit tangent at arc length `s`, in the direction walked.
  Point2 tangent_at(double s) const;
  /// 1/2 of the integral of (x dy - y dx): by Green's theorem a closed loop of curves adds up to its exact
  /// signed area.
  double area_term() const;
  /// Integral over the region swept from the origin, first moments: closed loops add up to area * centroid.
  Point2 moment_term() const;

  Curve reversed() const;
  Curve mirrored_x(double axis_x) const;  ///< x -> 2 axis_x - x
  Curve transformed(const Eigen::Isometry2d& motion) const;
  Curve scaled(double factor) const;  ///< about the origin

  /// The piece from arc length `from` to `to`, both clamped to [0, length]; walked backwards where from > to. Exact:
  /// part of an arc is an arc, part of a spline a chain of cubics.
  Curve part(double from, double to) const;
  /// The same curve as lines, arcs and cubics in the order walked.
  std::vector<Curve> elements() const;

  /// Polyline with chord error at most `tolerance` metres, both ends included; `at` receives the arc length
  /// of each point.
  std::vector<Point2> polyline(double tolerance, std::vector<double>* at = nullptr) const;
  /// Arc length of the nearest point on the curve.
  double nearest(const Point2& p) const;
  /// Arc lengths, ascending, where the curve crosses the line n . x = offset.
  std::vector<double> crossings(const Point2& normal, double offset) const;

 private:
  /// A piece of the curve over t in [0, 1]: a cubic Bezier, or a circular arc (a straight line is one with
  /// half = 0).
  struct Piece {
    Curve between(double t0, double t1) const;
    Point2 p[4];  // an arc uses p[0] and p[3] only
    bool bezier = false;
    double half = 0;  // half the angle an arc turns by; positive where the arc lies to the left of its chord
    Point2 point(double t) const;
    Point2 derivative(double t) const;
    Point2 direction(double t) const;  // unit, also where the derivative vanishes
    double arc_length() const;         // of an arc
  };
  void add_through(const std::vector<Point2>& interior);
  void add_bezier(const Point2& p0, const Point2& p1, const Point2& p2, const Point2& p3);
  void make_table();
  void add_table(std::size_t piece, double t0, double t1, double whole, double scale, int depth);
  double length_to(double t) const;  // t in [0, number of pieces]
  double parameter_at(double s) const;
  template <class Map>
  Curve mapped(const Map& map, double bulge_factor) const;

  Point2 start_{0, 0}, end_{0, 0};
  Shape shape_;
  std::vector<Piece> pieces_;              // none: a line of no length
  std::vector<double> table_s_, table_t_;  // arc length at increasing t in [0, number of pieces]
};

/// One curve made of several; what is itself a chain is taken apart. The ends should meet: a gap is walked over in no
/// length. No links give a curve of no length.
Curve chain(const std::vector<Curve>& links);

}  // namespace garment::geometry
