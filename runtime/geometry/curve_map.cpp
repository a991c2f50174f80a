#include "runtime/geometry/curve_map.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/base/portable_math.hpp"

namespace garment::geometry {
namespace {

constexpr double kStep = 4e-3;    // m between the points of a spline
constexpr double kCorner = 1e-4;  // m from a corner to the points beside it
constexpr double kSharp = 0.999;  // cosine of the turn from which on it is a corner

/// The control points mapped; `bulge` times the bulge of an arc.
template <class Map>
Curve mapped(const Curve& curve, const Map& map, double bulge) {
  Curve::Shape shape = curve.shape();
  if (auto* q = std::get_if<Quadratic>(&shape)) q->control = map(q->control);
  if (auto* c = std::get_if<Cubic>(&shape)) *c = Cubic{map(c->control_1), map(c->control_2)};
  if (auto* through = std::get_if<Through>(&shape))
    for (Point2& p : through->points) p = map(p);
  const Point2 start = map(curve.start()), end = map(curve.end());
  if (auto* arc = std::get_if<Arc>(&shape)) {
    const double chord = (curve.end() - curve.start()).norm();
    arc->bulge *= chord > 0 ? (end - start).norm() / chord : bulge;
  }
  return Curve(start, end, std::move(shape));
}

/// An arc as cubics, each of at most an eighth of a circle.
std::vector<Curve> cubics_of(const Curve& arc) {
  const double length = arc.length();
  const Point2 u = arc.tangent_at(0), v = arc.tangent_at(length), m = arc.tangent_at(length / 2);
  auto angle = [](const Point2& a, const Point2& b) {
    return portable::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  };
  const double turn = angle(u, m) + angle(m, v);
  const int n = std::max(1, static_cast<int>(std::ceil(std::fabs(turn) / (portable::kPi / 4))));
  const double piece = turn / n, radius = length / std::max(1e-12, std::fabs(turn));
  const double handle = 4.0 / 3 * portable::sin(std::fabs(piece) / 4) / portable::cos(piece / 4) * radius;
  std::vector<Curve> out;
  for (int k = 0; k < n; ++k) {
    const double a = length * k / n, b = length * (k + 1) / n;
    const Point2 p = k == 0 ? arc.start() : arc.point_at(a), q = k + 1 == n ? arc.end() : arc.point_at(b);
    out.emplace_back(p, q, Cubic{p + handle * arc.tangent_at(a), q - handle * arc.tangent_at(b)});
  }
  return out;
}

}  // namespace

Curve warped(const Curve& curve, const Point2& at_start, const Point2& at_end) {
  const Point2 start = curve.start(), chord = curve.end() - start;
  const double squared = chord.squaredNorm();
  return mapped(
      curve,
      [&](const Point2& p) -> Point2 {
        const double w = squared > 0 ? (p - start).dot(chord) / squared : 0;
        return p + (1 - w) * at_start + w * at_end;
      },
      1);
}

Curve stretched(const Curve& curve, double factor_x, double factor_y) {
  if (factor_x == factor_y) return curve.scaled(factor_x);
  if (std::holds_alternative<Arc>(curve.shape())) {
    std::vector<Curve> out;
    for (const Curve& cubic : cubics_of(curve)) out.push_back(stretched(cubic, factor_x, factor_y));
    return out.size() == 1 ? out[0] : joined(out);
  }
  return mapped(curve, [&](const Point2& p) { return Point2(factor_x * p.x(), factor_y * p.y()); }, factor_x);
}

namespace {

/// Points of a curve between its ends, kStep apart at most.
void add_points(const Curve& curve, double from, double to, std::vector<Point2>& out) {
  const bool line = std::holds_alternative<Line>(curve.shape());
  const int n = line ? 2 : std::max(2, static_cast<int>(std::ceil((to - from) / kStep)));
  for (int k = 1; k < n; ++k) out.push_back(curve.point_at(from + (to - from) * k / n));
}

}  // namespace

Curve piece_of(const Curve& curve, double from, double to) {
  if (from <= 0 && to >= curve.length()) return curve;
  const Point2 start = curve.point_at(from), end = curve.point_at(to);
  if (std::holds_alternative<Line>(curve.shape())) return Curve(start, end);
  if (const auto* arc = std::get_if<Arc>(&curve.shape())) {
    const Point2 middle = curve.point_at(0.5 * (from + to)), rise = middle - 0.5 * (start + end);
    return Curve(start, end, Arc{arc->bulge > 0 ? rise.norm() : -rise.norm()});
  }
  std::vector<Point2> points;
  add_points(curve, from, to, points);
  return Curve(start, end, Through{points});
}

Curve joined(const std::vector<Curve>& links) {
  const Point2 start = links.front().start(), end = links.back().end(), chord = end - start;
  bool straight = true;
  for (const Curve& link : links) {
    const Point2 d = link.end() - start;
    straight = straight && std::holds_alternative<Line>(link.shape()) && d.dot(chord) >= 0 &&
               std::fabs(chord.x() * d.y() - chord.y() * d.x()) <= 1e-9 * std::max(1e-3, chord.norm());
  }
  if (straight) return Curve(start, end);
  if (links.size() == 1) return links[0];
  std::vector<Point2> points;
  for (std::size_t k = 0; k < links.size(); ++k) {
    const Curve& link = links[k];
    const double length = link.length(), near = std::min(kCorner, length / 8);
    auto corner = [&](std::size_t a) {
      return links[a].tangent_at(links[a].length()).dot(links[a + 1].tangent_at(0)) < kSharp;
    };
    const bool first = k > 0 && corner(k - 1), last = k + 1 < links.size() && corner(k);
    const double from = first ? near : 0, to = last ? length - near : length;
    if (first) points.push_back(link.point_at(from));
    add_points(link, from, to, points);
    if (last) points.push_back(link.point_at(to));
    if (k + 1 < links.size()) points.push_back(link.end());
  }
  return Curve(start, end, Through{points});
}

std::optional<Curve> beside(const Curve& curve, double distance, double& at) {
  const double length = curve.length();
  auto place = [&](double s) {
    const Point2 t = curve.tangent_at(s);
    return Point2(curve.point_at(s) + distance * Point2(-t.y(), t.x()));
  };
  if (std::holds_alternative<Line>(curve.shape())) return Curve(place(0), place(length));
  const int n = std::max(8, static_cast<int>(std::ceil(length / kStep)));
  std::vector<Point2> points{place(0)};
  for (int k = 1; k <= n; ++k) {
    const double before = length * (k - 1) / n, here = length * k / n;
    points.push_back(place(here));
    const bool corner = curve.tangent_at(before).dot(curve.tangent_at(here)) < 0.9;
    const bool backwards = (points[points.size() - 1] - points[points.size() - 2]).dot(curve.tangent_at(here)) <= 0;
    if (!corner && !backwards) continue;
    at = here;
    return std::nullopt;
  }
  const Point2 start = points.front(), end = points.back();
  return Curve(start, end, Through{{points.begin() + 1, points.end() - 1}});
}

}  // namespace garment::geometry
