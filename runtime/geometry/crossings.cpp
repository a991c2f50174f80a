//   Both curves become polylines with a chord error of kChord. Pairs of segments whose boxes, grown by that error, meet
//   are found with a tree of boxes over each polyline; each pair is a first guess for Newton's method on the curves
//   themselves, a(s) = b(t), with s and t arc lengths:
//
//       [ a'  -b' ] [ds dt]^T = b(t) - a(s)        (damped where the curves are nearly parallel)
#include "runtime/geometry/crossings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace garment::geometry {
namespace {

constexpr double kChord = 1e-5;        // m
constexpr double kOn = 1e-7;           // m, a point this near both curves lies on both
constexpr double kSame = 1e-6;         // m
constexpr double kSameTouch = 1e-4;    // m, of points where the curves are nearly parallel
constexpr double kParallel = 2e-3;     // sine of the angle
constexpr std::size_t kMaxPairs = 2'000'000;
constexpr std::size_t kMostStretches = 64;  // between neighbouring points that are looked at
constexpr std::size_t kMaxGuesses = 4'000;

struct Box {
  Point2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  void add(const Box& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  bool meets(const Box& other, double margin) const {
    return low.x() <= other.high.x() + margin && other.low.x() <= high.x() + margin &&
           low.y() <= other.high.y() + margin && other.low.y() <= high.y() + margin;
  }
};

/// A polyline of a curve with a tree of boxes: node 1 is the root, node k has the children 2k and 2k + 1.
class Segments {
 public:
  explicit Segments(const Curve& curve) : points_(curve.polyline(kChord, &at_)) {
    while (leaves_ < count()) leaves_ *= 2;
    boxes_.resize(2 * leaves_);
    for (std::size_t k = 0; k < count(); ++k) {
      boxes_[leaves_ + k].low = points_[k].cwiseMin(points_[k + 1]);
      boxes_[leaves_ + k].high = points_[k].cwiseMax(points_[k + 1]);
    }
    for (std::size_t k = leaves_; k-- > 1;) {
      boxes_[k] = boxes_[2 * k];
      boxes_[k].add(boxes_[2 * k + 1]);
    }
  }
  std::size_t count() const { return points_.size() - 1; }
  std::size_t leaves() const { return leaves_; }
  const Box& box(std::size_t node) const { return boxes_[node]; }
  bool is_leaf(std::size_t node) const { return node >= leaves_; }
  const Point2& point(std::size_t k) const { return points_[k]; }
  double at(std::size_t k) const { return at_[k]; }

 private:
  std::vector<double> at_;
  std::vector<Point2> points_;
  std::size_t leaves_ = 1;
  std::vector<Box> boxes_;
};

struct Guess {
  double s = 0, t = 0;
};

/// Fractions along two segments where they cross, or come nearer than `margin` at an end of one of them. Of segments
/// that run along each other there are several.
std::vector<std::pair<double, double>> near_fractions(const Point2& a0, const Point2& a1, const Point2& b0,
                                                      const Point2& b1, double margin) {
  const Point2 u = a1 - a0, v = b1 - b0;
  const double det = cross(u, v), sizes = u.norm() * v.norm();
  if (std::fabs(det) > 1e-12 * sizes) {
    const double x = cross(b0 - a0, v) / det, y = cross(b0 - a0, u) / det;
    if (x >= 0 && x <= 1 && y >= 0 && y <= 1) return {{x, y}};
  }
  std::vector<std::pair<double, double>> near;
  double least = margin * margin;
  const bool parallel = std::fabs(det) <= kParallel * sizes;
  auto offer = [&](double x, double y) {
    const double d = (a0 + x * u - b0 - y * v).squaredNorm();
    if (!(d <= (parallel ? margin * margin : least))) return;
    if (!parallel) near.clear();
    least = d;
    near.emplace_back(x, y);
  };
  auto onto = [](const Point2& p, const Point2& from, const Point2& way) {
    const double square = way.squaredNorm();
    return square > 0 ? std::clamp((p - from).dot(way) / square, 0.0, 1.0) : 0.0;
  };
  for (double end : {0.0, 1.0}) {
    offer(end, onto(a0 + end * u, b0, v));
    offer(onto(b0 + end * v, a0, u), end);
  }
  return near;
}

/// Calls `take` for pairs of leaves that may be nearer than `margin`; false where there are too many.
template <class Take>
bool for_near_pairs(const Segments& a, const Segments& b, double margin, const Take& take) {
  std::vector<std::pair<std::size_t, std::size_t>> open{{1, 1}};
  std::size_t seen = 0;
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    if (++seen > kMaxPairs) return false;
    if (!a.box(i).meets(b.box(j), margin)) continue;
    if (a.is_leaf(i) && b.is_leaf(j)) {
      if (i - a.leaves() < a.count() && j - b.leaves() < b.count() && !take(i - a.leaves(), j - b.leaves()))
        return false;
    } else if (b.is_leaf(j) || (!a.is_leaf(i) && i <= j)) {
      open.push_back({2 * i + 1, j});
      open.push_back({2 * i, j});
    } else {
      open.push_back({i, 2 * j + 1});
      open.push_back({i, 2 * j});
    }
  }
  return true;
}

/// Newton from a guess; the nearer of what it passes. Nothing where the curves stay apart.
std::optional<Crossing> refine(const Curve& a, const Curve& b, Guess guess) {
  const double la = a.length(), lb = b.length();
  double s = std::clamp(guess.s, 0.0, la), t = std::clamp(guess.t, 0.0, lb);
  Point2 p = a.point_at(s), q = b.point_at(t);
  double least = (q - p).norm(), damping = 0;
  for (int round = 0; round < 60 && least > 1e-13; ++round) {
    const Point2 u = a.tangent_at(s), v = b.tangent_at(t), r = q - p;
    // Least squares of u ds - v dt = r with damping: (J^T J + d) x = J^T r, J = [u -v], |u| = |v| = 1.
    const double c = -u.dot(v), d = 1 + damping, det = d * d - c * c;
    const double g = u.dot(r), h = -v.dot(r);
    double ds = 0, dt = 0;
    if (det > 1e-18) {
      ds = (d * g - c * h) / det;
      dt = (d * h - c * g) / det;
    } else {
      ds = g / 2;
      dt = h / 2;
    }
    const double s1 = std::clamp(s + ds, 0.0, la), t1 = std::clamp(t + dt, 0.0, lb);
    const Point2 p1 = a.point_at(s1), q1 = b.point_at(t1);
    const double far = (q1 - p1).norm();
    if (!(far < least)) {
      if (damping > 1e6) break;
      damping = damping == 0 ? 1e-3 : 10 * damping;
      continue;
    }
    damping = damping > 1e-6 ? damping / 10 : 0;
    s = s1, t = t1, p = p1, q = q1, least = far;
  }
  if (!(least <= kOn)) return std::nullopt;
  const double angle = std::fabs(cross(a.tangent_at(s), b.tangent_at(t)));
  const bool at_end = s < kSame || s > la - kSame || t < kSame || t > lb - kSame;
  return Crossing{s, t, 0.5 * (p + q), at_end || angle < kParallel};
}

bool same(const Crossing& x, const Crossing& y, bool parallel) {
  return (x.point - y.point).norm() <= (parallel ? kSameTouch : kSame);
}

bool nearly_parallel(const Curve& a, const Curve& b, const Crossing& at) {
  return std::fabs(cross(a.tangent_at(at.on_a), b.tangent_at(at.on_b))) < kParallel;
}

/// Sorted along the first curve, each point once. A point that a curve passes twice is kept twice.
void tidy(const Curve& a, const Curve& b, std::vector<Crossing>& found) {
  std::sort(found.begin(), found.end(), [](const Crossing& x, const Crossing& y) {
    return x.on_a != y.on_a ? x.on_a < y.on_a : x.on_b < y.on_b;
  });
  std::vector<Crossing> kept;
  for (const Crossing& at : found) {
    const bool parallel = nearly_parallel(a, b, at);
    bool known = false;
    for (const Crossing& other : kept) {
      const double reach = parallel ? kSameTouch : kSame;
      // Where a closed curve begins it also ends: that is one point.
      known = known || (same(at, other, parallel) &&
                        (std::fabs(at.on_a - other.on_a) <= 2 * reach ||
                         std::fabs(std::fabs(at.on_a - other.on_a) - a.length()) <= 2 * reach) &&
                        (std::fabs(at.on_b - other.on_b) <= 2 * reach ||
                         std::fabs(std::fabs(at.on_b - other.on_b) - b.length()) <= 2 * reach));
      if (known) break;
    }
    if (!known) kept.push_back(at);
  }
  found = std::move(kept);
}

/// Curves that run along each other: between two neighbouring points they do not part.
bool run_together(const Curve& a, const Curve& b, const std::vector<Crossing>& found) {
  const std::size_t last = std::min(found.size(), kMostStretches);
  for (std::size_t k = 1; k < last; ++k) {
    const double from = found[k - 1].on_a, to = found[k].on_a;
    if (to - from < kSame) continue;
    bool together = true;
    for (double way : {0.25, 0.5, 0.75}) {
      const Point2 p = a.point_at(from + way * (to - from));
      together = together && (b.point_at(b.nearest(p)) - p).norm() <= kOn;
    }
    if (together) return true;
  }
  return false;
}

}  // namespace

Crossings crossings_of(const Curve& a, const Curve& b) {
  Crossings result;
  const Segments left(a), right(b);
  std::vector<Guess> guesses;
  const double margin = 4 * kChord;
  const bool done = for_near_pairs(left, right, margin, [&](std::size_t i, std::size_t j) {
    for (const auto& [x, y] :
         near_fractions(left.point(i), left.point(i + 1), right.point(j), right.point(j + 1), margin))
      guesses.push_back(
          {left.at(i) + x * (left.at(i + 1) - left.at(i)), right.at(j) + y * (right.at(j + 1) - right.at(j))});
    return guesses.size() <= kMaxGuesses;
  });
  if (!done) {
    result.too_many = true;
    return result;
  }
  for (const Guess& guess : guesses)
    if (const auto at = refine(a, b, guess)) result.found.push_back(*at);
  tidy(a, b, result.found);
  result.overlap = run_together(a, b, result.found);
  return result;
}

Approach nearest_approach(const Curve& a, const Curve& b) {
  Approach best{0, 0, std::numeric_limits<double>::infinity()};
  // Every point of a coarse polyline of one against the other curve, both ways round.
  auto search = [&](const Curve& from, const Curve& to, bool exchanged) {
    std::vector<double> at;
    const std::vector<Point2> points = from.polyline(1e-3, &at);
    const std::size_t step = std::max<std::size_t>(1, points.size() / 500);
    for (std::size_t k = 0; k < points.size(); k += k + 1 == points.size() ? 1 : std::min(step, points.size() - 1 - k)) {
      const double t = to.nearest(points[k]), far = (to.point_at(t) - points[k]).norm();
      if (far < best.distance) best = {exchanged ? t : at[k], exchanged ? at[k] : t, far};
    }
  };
  search(a, b, false);
  search(b, a, true);
  for (int round = 0; round < 40; ++round) {  // to and fro between the two curves
    const double t = b.nearest(a.point_at(best.on_a)), s = a.nearest(b.point_at(t));
    const double far = (a.point_at(s) - b.point_at(t)).norm();
    if (!(far < best.distance)) break;
    best = {s, t, far};
  }
  return best;
}

}  // namespace garment::geometry
