// Pieces of curves, and curves made of pieces.
#include <algorithm>
#include <cmath>

#include "runtime/base/portable_math.hpp"
#include "runtime/geometry/curve.hpp"

namespace garment::geometry {
namespace {

Point2 between(const Point2& a, const Point2& b, double t) { return a + t * (b - a); }

}  // namespace

//   A Bezier between t0 and t1: its control points are the blossom's values at (t0, t0, t0), (t0, t0, t1), ...
Curve Curve::Piece::between(double t0, double t1) const {
  const Point2 a = point(t0), b = point(t1);
  if (!bezier) {
    if (half == 0) return Curve(a, b);
    return Curve(a, b, Arc{0.5 * (b - a).norm() * portable::tan(0.5 * half * (t1 - t0))});
  }
  auto blossom = [&](double u, double v, double w) {
    const Point2 q0 = geometry::between(p[0], p[1], u), q1 = geometry::between(p[1], p[2], u),
                 q2 = geometry::between(p[2], p[3], u);
    return geometry::between(geometry::between(q0, q1, v), geometry::between(q1, q2, v), w);
  };
  return Curve(a, b, Cubic{blossom(t0, t0, t1), blossom(t0, t1, t1)});
}

std::vector<Curve> Curve::elements() const {
  std::vector<Curve> out;
  for (const Piece& piece : pieces_) out.push_back(piece.between(0, 1));
  return out;
}

Curve Curve::part(double from, double to) const {
  const double whole = length();
  from = std::clamp(from, 0.0, whole);
  to = std::clamp(to, 0.0, whole);
  if (from > to) return part(to, from).reversed();
  if (from <= 0 && to >= whole) return *this;
  if (pieces_.empty()) return Curve(start_, start_);
  const double t0 = parameter_at(from), t1 = parameter_at(to);
  const std::size_t last = pieces_.size() - 1;
  const std::size_t first_piece = std::min(static_cast<std::size_t>(t0), last),
                    last_piece = std::min(static_cast<std::size_t>(t1), last);
  std::vector<Curve> links;
  for (std::size_t k = first_piece; k <= last_piece; ++k) {
    const double base = static_cast<double>(k), a = std::max(t0 - base, 0.0), b = std::min(t1 - base, 1.0);
    if (b > a) links.push_back(pieces_[k].between(a, b));
  }
  return links.empty() ? Curve(point_at(from), point_at(to)) : chain(links);
}

Curve chain(const std::vector<Curve>& links) {
  std::vector<Curve> flat;
  for (const Curve& link : links) {
    if (const auto* inner = std::get_if<Chain>(&link.shape()))
      flat.insert(flat.end(), inner->links->begin(), inner->links->end());
    else
      flat.push_back(link);
  }
  if (flat.empty()) return {};
  if (flat.size() == 1) return flat[0];
  const Point2 start = flat.front().start(), end = flat.back().end();
  return Curve(start, end, Chain{std::make_shared<const std::vector<Curve>>(std::move(flat))});
}

}  // namespace garment::geometry
