#include "runtime/design/region.hpp"

#include <algorithm>
#include <cmath>

namespace garment::design {
namespace {

using Kind = RegionShape::Kind;
using Line = std::vector<Point2>;

constexpr double kChordError = 2e-5;    // m
constexpr double kOutlineError = 1e-4;  // m

double cross(const Point2& a, const Point2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Nearest point of a segment to `p`, as a share of its length.
double nearest_share(const Point2& a, const Point2& b, const Point2& p) {
  const Point2 d = b - a;
  const double length = d.squaredNorm();
  return length > 0 ? std::clamp((p - a).dot(d) / length, 0.0, 1.0) : 0;
}

Point2 unit(const Point2& v) {
  const double length = v.norm();
  return length > 0 ? Point2(v / length) : v;
}

bool inside_polygon(const Line& corners, const Point2& p) {
  bool inside = false;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point2 &a = corners[k], &b = corners[(k + 1) % corners.size()];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

}  // namespace

std::vector<Point2> polyline_of(const Panel& panel, const EdgePart& part) {
  const geometry::Curve& curve = edge_of(panel, part).curve;
  const double low = std::min(part.from, part.to), high = std::max(part.from, part.to);
  std::vector<double> at;
  const std::vector<Point2> whole = curve.polyline(kChordError, &at);
  std::vector<Point2> line{curve.point_at(low)};
  for (std::size_t k = 0; k < whole.size(); ++k)
    if (at[k] > low && at[k] < high) line.push_back(whole[k]);
  line.push_back(curve.point_at(high));
  if (part.from > part.to) std::reverse(line.begin(), line.end());
  return line;
}

RegionShape outline_shape(const Panel& panel) {
  RegionShape shape;
  shape.kind = RegionShape::Kind::polygon;
  for (const Edge& edge : panel.edges) {
    const std::vector<Point2> points = edge.curve.polyline(kOutlineError);
    if (!points.empty()) shape.points.insert(shape.points.end(), points.begin(), points.end() - 1);
  }
  return shape;
}

RegionFactors operator*(const RegionFactors& a, const RegionFactors& b) {
  return {a.stretch_warp * b.stretch_warp,
          a.stretch_weft * b.stretch_weft,
          a.shear * b.shear,
          a.bend_warp * b.bend_warp,
          a.bend_weft * b.bend_weft,
          a.twist * b.twist,
          a.mass * b.mass,
          a.friction * b.friction,
          a.damping * b.damping,
          a.thickness * b.thickness};
}

RegionTest::RegionTest(const Panel& panel, const RegionShape& shape)
    : kind_(shape.kind),
      size_(shape.size),
      fold_x_(panel.fold_x.value_or(0)),
      sign_(shape.sign),
      drawn_side_(panel.fold_x ? shape.drawn_side : 0) {
  for (const RegionShape& child : shape.children) children_.emplace_back(panel, child);
  if (kind_ == Kind::polygon) lines_.push_back(shape.points);
  if (kind_ == Kind::circle || (kind_ == Kind::near && shape.parts.empty()))
    for (const Point2& p : shape.points) lines_.push_back({p});
  for (const EdgePart& part : shape.parts) {
    Line line = polyline_of(panel, part);
    const bool follows = !lines_.empty() && (lines_.back().back() - line.front()).norm() < 1e-6;
    if (follows)
      lines_.back().insert(lines_.back().end(), line.begin() + 1, line.end());
    else
      lines_.push_back(std::move(line));
  }
  low_ = Point2(1e300, 1e300);
  high_ = -low_;
  for (const Line& line : lines_)
    for (const Point2& p : line) low_ = low_.cwiseMin(p), high_ = high_.cwiseMax(p);
}

double RegionTest::distance_squared(const Point2& p) const {
  double nearest = 1e300;
  for (const Line& line : lines_) {
    if (line.size() == 1) nearest = std::min(nearest, (line[0] - p).squaredNorm());
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const double t = nearest_share(line[k], line[k + 1], p);
      nearest = std::min(nearest, (line[k] + t * (line[k + 1] - line[k]) - p).squaredNorm());
    }
  }
  return nearest;
}

/// Positive to the left of the lines. At a corner of a polyline the mean of both tangents decides.
double RegionTest::side_of(const Point2& p) const {
  double nearest = 1e300, side = 0;
  for (const Line& line : lines_)
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const double t = nearest_share(line[k], line[k + 1], p);
      const Point2 q = line[k] + t * (line[k + 1] - line[k]);
      const double d = (q - p).squaredNorm();
      if (d >= nearest) continue;
      nearest = d;
      Point2 way = unit(line[k + 1] - line[k]);
      if (t == 1 && k + 2 < line.size()) way += unit(line[k + 2] - line[k + 1]);
      if (t == 0 && k > 0) way += unit(line[k] - line[k - 1]);
      side = cross(way, p - q);
    }
  return side;
}

bool RegionTest::leaf_contains(const Point2& p) const {
  switch (kind_) {
    case Kind::everywhere:
      return true;
    case Kind::polygon:
      return !lines_.empty() && inside_polygon(lines_[0], p);
    case Kind::circle:
    case Kind::near:
      if (p.x() < low_.x() - size_ || p.x() > high_.x() + size_ || p.y() < low_.y() - size_ ||
          p.y() > high_.y() + size_)
        return false;
      return distance_squared(p) <= size_ * size_;
    case Kind::above:
      return p.y() > size_;
    case Kind::below:
      return p.y() < size_;
    case Kind::beyond:
      return sign_ > 0 ? p.x() > size_ : p.x() < size_;
    case Kind::left_of:
      return side_of(p) > 0;
    case Kind::right_of:
      return side_of(p) < 0;
    default:
      return false;
  }
}

bool RegionTest::contains(const Point2& p) const {
  switch (kind_) {
    case Kind::all_of:
      return std::all_of(children_.begin(), children_.end(),
                         [&](const RegionTest& c) { return c.contains(p); });
    case Kind::any_of:
      return std::any_of(children_.begin(), children_.end(),
                         [&](const RegionTest& c) { return c.contains(p); });
    case Kind::minus:
      for (std::size_t k = 1; k < children_.size(); ++k)
        if (children_[k].contains(p)) return false;
      return !children_.empty() && children_[0].contains(p);
    case Kind::opposite:
      return !children_.empty() && !children_[0].contains(p);
    default:
      break;
  }
  if (drawn_side_ != 0 && (p.x() - fold_x_) * drawn_side_ < 0)
    return leaf_contains(Point2(2 * fold_x_ - p.x(), p.y()));
  return leaf_contains(p);
}

void RegionTest::collect_marks(std::vector<Point2>& marks) const {
  for (const RegionTest& child : children_) child.collect_marks(marks);
  for (const Line& line : lines_) {
    Point2 middle(0, 0);
    for (const Point2& p : line) middle += p / static_cast<double>(line.size());
    marks.push_back(middle);
    for (std::size_t k = 0; k < line.size(); k += 1 + line.size() / 64) {
      marks.push_back(line[k]);
      for (const Point2& away : {Point2(1, 0), Point2(-1, 0), Point2(0, 1), Point2(0, -1)}) {
        marks.push_back(line[k] + 1e-3 * away);
        if (kind_ != Kind::polygon && size_ > 0) marks.push_back(line[k] + 0.5 * size_ * away);
      }
    }
  }
}

}  // namespace garment::design
