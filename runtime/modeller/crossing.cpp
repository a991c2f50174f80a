#include "runtime/modeller/crossing.hpp"

#include <algorithm>

#include "runtime/geometry/exact_sign.hpp"

namespace garment::modeller {
namespace {

using Eigen::Vector2d;

bool boxes_meet(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  return std::max(a.x(), b.x()) >= std::min(c.x(), d.x()) &&
         std::max(c.x(), d.x()) >= std::min(a.x(), b.x()) &&
         std::max(a.y(), b.y()) >= std::min(c.y(), d.y()) && std::max(c.y(), d.y()) >= std::min(a.y(), b.y());
}

/// Do the closed segments a-b and c-d have a point in common? (The boxes are known to meet.)
bool segments_meet(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  using geometry::orient_2d;
  return orient_2d(a, b, c) * orient_2d(a, b, d) <= 0 && orient_2d(c, d, a) * orient_2d(c, d, b) <= 0;
}

Vector2d meeting_point(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  Vector2d u = b - a, v = d - c;
  double det = u.x() * v.y() - u.y() * v.x();
  if (det == 0) return c;
  double s = ((c - a).x() * v.y() - (c - a).y() * v.x()) / det;
  return a + s * u;
}

}  // namespace

std::optional<Crossing> find_crossing(const std::vector<Vector2d>& loop) {
  std::size_t n = loop.size();
  auto low_x = [&](std::size_t k) { return std::min(loop[k].x(), loop[(k + 1) % n].x()); };
  auto high_x = [&](std::size_t k) { return std::max(loop[k].x(), loop[(k + 1) % n].x()); };
  std::vector<std::size_t> order(n);
  for (std::size_t k = 0; k < n; ++k) order[k] = k;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return low_x(a) != low_x(b) ? low_x(a) < low_x(b) : a < b; });
  std::optional<Crossing> best;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n && low_x(order[j]) <= high_x(order[i]); ++j) {
      std::size_t a = std::min(order[i], order[j]), b = std::max(order[i], order[j]);
      if (b == a + 1 || (a == 0 && b == n - 1)) continue;
      const Vector2d &p = loop[a], &q = loop[a + 1], &r = loop[b], &s = loop[(b + 1) % n];
      if (!boxes_meet(p, q, r, s) || !segments_meet(p, q, r, s)) continue;
      if (!best || a < best->first || (a == best->first && b < best->second))
        best = Crossing{a, b, meeting_point(p, q, r, s)};
    }
  }
  return best;
}

}  // namespace garment::modeller
