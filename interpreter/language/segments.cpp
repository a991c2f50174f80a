#include "interpreter/language/segments.hpp"

#include <algorithm>
#include <cmath>

namespace garment::interpreter {
namespace {

using design::Point2;
using geometry::cross;

constexpr double kChordError = 5e-5;  // m
constexpr double kBeyond = 1e-7;      // m; less is a touch

double low(const Segment& s) { return std::min(s.a.x(), s.b.x()); }
double high(const Segment& s) { return std::max(s.a.x(), s.b.x()); }

double distance(const Segment& s, const Point2& p) {
  const Point2 d = s.b - s.a;
  const double squared = d.squaredNorm();
  const double t = squared > 0 ? std::clamp((p - s.a).dot(d) / squared, 0.0, 1.0) : 0.0;
  return (s.a + t * d - p).norm();
}

}  // namespace

std::vector<Segment> segments_of(const std::vector<design::Edge>& edges) {
  std::vector<Segment> segments;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const std::vector<Point2> line = edges[k].curve.polyline(kChordError);
    for (std::size_t j = 0; j + 1 < line.size(); ++j) segments.push_back({line[j], line[j + 1], k});
  }
  return segments;
}

std::optional<Point2> crossing(const Segment& s, const Segment& t) {
  const Point2 u = s.b - s.a, v = t.b - t.a;
  const double d1 = cross(u, t.a - s.a), d2 = cross(u, t.b - s.a);
  const double d3 = cross(v, s.a - t.a), d4 = cross(v, s.b - t.a);
  if (!(d1 * d2 < 0 && d3 * d4 < 0)) return std::nullopt;
  if (std::min(std::fabs(d1), std::fabs(d2)) <= kBeyond * u.norm()) return std::nullopt;
  if (std::min(std::fabs(d3), std::fabs(d4)) <= kBeyond * v.norm()) return std::nullopt;
  return Point2(s.a + (d3 / (d3 - d4)) * u);
}

std::optional<Crossing> first_crossing(Program& program, Span span, const std::vector<Segment>& a,
                                       std::vector<Segment> b) {
  std::stable_sort(b.begin(), b.end(), [](const Segment& s, const Segment& t) { return low(s) < low(t); });
  for (const Segment& s : a) {
    count_step(program, span);
    std::optional<Crossing> first;
    for (const Segment& t : b) {
      if (low(t) > high(s)) break;
      count_step(program, span);
      if (high(t) < low(s)) continue;
      const auto at = crossing(s, t);
      if (at && (!first || (*at - s.a).norm() < (first->at - s.a).norm())) first = Crossing{s.edge, t.edge, *at};
    }
    if (first) return first;
  }
  return std::nullopt;
}

bool contains(const std::vector<Segment>& loops, const Point2& p, double tolerance) {
  bool inside = false;
  for (const Segment& s : loops) {
    if (tolerance > 0 && distance(s, p) <= tolerance) return true;
    if ((s.a.y() > p.y()) != (s.b.y() > p.y()) &&
        p.x() < s.a.x() + (p.y() - s.a.y()) / (s.b.y() - s.a.y()) * (s.b.x() - s.a.x()))
      inside = !inside;
  }
  return inside;
}

double distance_to(const std::vector<Segment>& segments, const Point2& p) {
  double nearest = 1e9;
  for (const Segment& s : segments) nearest = std::min(nearest, distance(s, p));
  return nearest;
}

}  // namespace garment::interpreter
