#include "runtime/geometry/curve_map.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "runtime/base/portable_math.hpp"

namespace garment::geometry {
namespace {

using Map = std::function<Point2(const Point2&)>;

/// The control points mapped; `bulge` times the bulge of an arc.
Curve mapped(const Curve& curve, const Map& map, double bulge) {
  if (const auto* links = std::get_if<Chain>(&curve.shape())) {
    std::vector<Curve> out;
    for (const Curve& link : *links->links) out.push_back(mapped(link, map, bulge));
    return chain(out);
  }
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
  if (std::holds_alternative<Chain>(curve.shape()) || std::holds_alternative<Arc>(curve.shape())) {
    std::vector<Curve> out;
    for (const Curve& element : curve.elements()) {
      if (!std::holds_alternative<Arc>(element.shape())) {
        out.push_back(stretched(element, factor_x, factor_y));
        continue;
      }
      for (const Curve& cubic : cubics_of(element)) out.push_back(stretched(cubic, factor_x, factor_y));
    }
    return joined(out);
  }
  return mapped(curve, [&](const Point2& p) { return Point2(factor_x * p.x(), factor_y * p.y()); }, factor_x);
}

Curve piece_of(const Curve& curve, double from, double to) {
  return from <= 0 && to >= curve.length() ? curve : curve.part(from, to);
}

Curve joined(const std::vector<Curve>& links) {
  const Point2 start = links.front().start(), end = links.back().end(), along = end - start;
  bool straight = true;
  for (const Curve& link : links) {
    const Point2 d = link.end() - start;
    straight = straight && std::holds_alternative<Line>(link.shape()) && d.dot(along) >= 0 &&
               std::fabs(along.x() * d.y() - along.y() * d.x()) <= 1e-9 * std::max(1e-3, along.norm());
  }
  if (straight) return Curve(start, end);
  return links.size() == 1 ? links[0] : chain(links);
}

}  // namespace garment::geometry
