#include "runtime/io/dxf_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/base/portable_math.hpp"

namespace garment::io {
namespace {

using geometry::Point2;
using Weighted = Eigen::Vector3d;          // (x w, y w, w)
using Segment = std::vector<Weighted>;     // control points of a Bézier segment
constexpr int kMostDegree = 11;            // as CAD systems bound it
constexpr std::size_t kMostOfOne = 8192;    // points of one curve
constexpr int kMostHalvings = 12;

Point2 projected(const Weighted& p) { return p.head<2>() / p.z(); }

double chord_distance(const Point2& a, const Point2& b, const Point2& p) {
  const Point2 d = b - a;
  const double square = d.squaredNorm();
  const double t = square > 0 ? std::clamp((p - a).dot(d) / square, 0.0, 1.0) : 0;
  return (a + t * d - p).norm();
}

/// Appends the points of a segment after its first.
void append(std::vector<Point2>& out, const Segment& segment, double flatness, int halvings) {
  const Point2 a = projected(segment.front()), b = projected(segment.back());
  double off = 0;
  for (std::size_t i = 1; i + 1 < segment.size(); ++i)
    off = std::max(off, chord_distance(a, b, projected(segment[i])));
  if (!(off > flatness) || halvings == kMostHalvings || out.size() >= kMostOfOne) {
    out.push_back(b);
    return;
  }
  Segment left, right = segment;  // de Casteljau at the middle
  left.push_back(right.front());
  for (std::size_t n = right.size(); n > 1; --n) {
    for (std::size_t i = 0; i + 1 < n; ++i) right[i] = (right[i] + right[i + 1]) / 2;
    left.push_back(right[0]);
  }
  // What is left in `right` is its control points from the middle on.
  append(out, left, flatness, halvings + 1);
  append(out, right, flatness, halvings + 1);
}

DxfFlattened flattened_segments(const std::vector<Segment>& segments, bool closed) {
  DxfFlattened out;
  if (segments.empty()) return out;
  Point2 low = projected(segments[0][0]), high = low;
  for (const Segment& s : segments)
    for (const Weighted& p : s) low = low.cwiseMin(projected(p)), high = high.cwiseMax(projected(p));
  const double flatness = kDxfFlatness * (high - low).norm();
  out.points.push_back(projected(segments[0][0]));
  for (const Segment& s : segments) append(out.points, s, flatness, 0);
  out.closed = closed || (out.points.back() - out.points.front()).norm() <= flatness;
  while (out.closed && out.points.size() > 1 &&
         (out.points.back() - out.points.front()).norm() <= flatness)
    out.points.pop_back();
  return out;
}

/// The blossom of the span that starts at knot k, at the arguments `u` (degree of them): de Boor's triangle,
/// each row with its own argument.
Weighted blossom(const std::vector<Weighted>& control, const std::vector<double>& t, std::size_t k,
                 const std::vector<double>& u) {
  const std::size_t p = u.size();
  std::vector<Weighted> d(control.begin() + static_cast<std::ptrdiff_t>(k - p),
                          control.begin() + static_cast<std::ptrdiff_t>(k + 1));
  for (std::size_t r = 1; r <= p; ++r)
    for (std::size_t j = p; j >= r; --j) {
      const double from = t[j + k - p], to = t[j + 1 + k - r];
      const double a = (u[r - 1] - from) / (to - from);
      d[j] = (1 - a) * d[j - 1] + a * d[j];
    }
  return d[p];
}

std::string fault_of(const DxfSpline& s) {
  if (s.degree < 1 || s.degree > kMostDegree)
    return fmt::format("degree {}, expected 1 to {}", s.degree, kMostDegree);
  const std::size_t n = s.control.size(), p = static_cast<std::size_t>(s.degree);
  if (n <= p) return fmt::format("{} control points, expected more than its degree {}", n, p);
  if (!s.knots.empty() && s.knots.size() != n + p + 1)
    return fmt::format("{} knots, expected {} ({} control points, degree {})", s.knots.size(), n + p + 1, n, p);
  if (!s.weights.empty() && s.weights.size() != n)
    return fmt::format("{} weights, expected {}", s.weights.size(), n);
  if (!std::is_sorted(s.knots.begin(), s.knots.end())) return "knots that fall, expected none";
  if (!s.knots.empty() && !(s.knots[p] < s.knots[n])) return "knots that are all the same, expected a range";
  for (double w : s.weights)
    if (!(w > 0)) return "a weight that is not positive, expected only such";
  return {};
}

DxfFlattened by_control_points(const DxfSpline& s) {
  DxfFlattened out;
  out.fault = fault_of(s);
  if (!out.fault.empty()) return out;
  const std::size_t n = s.control.size(), p = static_cast<std::size_t>(s.degree);
  std::vector<double> knots = s.knots;
  if (knots.empty())
    for (std::size_t i = 0; i < n + p + 1; ++i)
      knots.push_back(static_cast<double>(std::clamp(i, p, n) - p));
  std::vector<Weighted> control;
  for (std::size_t i = 0; i < n; ++i) {
    const double w = s.weights.empty() ? 1 : s.weights[i];
    control.emplace_back(s.control[i].x() * w, s.control[i].y() * w, w);
  }
  std::vector<Segment> segments;
  for (std::size_t k = p; k < n; ++k) {
    const double a = knots[k], b = knots[k + 1];
    if (!(a < b)) continue;
    Segment segment;
    for (std::size_t i = 0; i <= p; ++i) {
      std::vector<double> arguments(p - i, a);
      arguments.resize(p, b);
      segment.push_back(blossom(control, knots, k, arguments));
    }
    segments.push_back(std::move(segment));
  }
  return flattened_segments(segments, s.closed);
}

/// Solves the tridiagonal system in place: below[i] x[i-1] + on[i] x[i] + above[i] x[i+1] = x[i] on entry.
void solve_tridiagonal(const std::vector<double>& below, std::vector<double> on, const std::vector<double>& above,
                       std::vector<Point2>& x) {
  for (std::size_t i = 1; i < x.size(); ++i) {
    const double m = below[i] / on[i - 1];
    on[i] -= m * above[i - 1];
    x[i] -= m * x[i - 1];
  }
  x.back() /= on.back();
  for (std::size_t i = x.size() - 1; i-- > 0;) x[i] = (x[i] - above[i] * x[i + 1]) / on[i];
}

/// Derivatives by chord length at the points of a cubic spline, h[i] from point i to the next.
std::vector<Point2> slopes(const std::vector<Point2>& p, const std::vector<double>& h, const DxfSpline& s,
                           bool closed) {
  const std::size_t n = p.size();
  auto chord = [&](std::size_t i) { return Point2((p[(i + 1) % n] - p[i]) / h[i]); };
  std::vector<double> below(n, 0), on(n, 1), above(n, 0);
  std::vector<Point2> m(n, Point2(0, 0));
  for (std::size_t i = closed ? 0 : 1; i + (closed ? 0 : 1) < n; ++i) {  // equal curvature on both sides
    const std::size_t before = (i + n - 1) % n;
    below[i] = h[i];
    on[i] = 2 * (h[i] + h[before]);
    above[i] = h[before];
    m[i] = 3 * (h[i] * chord(before) + h[before] * chord(i));
  }
  if (closed) {
    // Sherman and Morrison: the corners of the matrix are u v^T beside a tridiagonal one.
    const double corner_high = below[0], corner_low = above[n - 1], g = -on[0];
    on[0] -= g;
    on[n - 1] -= corner_low * corner_high / g;
    std::vector<Point2> u(n, Point2(0, 0));
    u[0] = Point2(g, 0), u[n - 1] = Point2(corner_low, 0);
    below[0] = above[n - 1] = 0;
    solve_tridiagonal(below, on, above, m);
    solve_tridiagonal(below, on, above, u);
    const double f = corner_high / g, scale = 1 + u[0].x() + f * u[n - 1].x();
    const Point2 part = (m[0] + f * m[n - 1]) / scale;
    for (std::size_t i = 0; i < n; ++i) m[i] -= part * u[i].x();
    return m;
  }
  auto end = [&](std::size_t i, const Point2& direction, const Point2& beside, double& other) {
    if (direction.norm() > 0) {
      m[i] = direction.normalized();
    } else {
      on[i] = 2, other = 1;
      m[i] = 3 * beside;
    }
  };
  end(0, s.start, chord(0), above[0]);
  end(n - 1, s.end, chord(n - 2), below[n - 1]);
  solve_tridiagonal(below, on, above, m);
  return m;
}

DxfFlattened by_fit_points(const DxfSpline& s) {
  std::vector<Point2> p;
  for (const Point2& q : s.fit)
    if (p.empty() || (q - p.back()).norm() > 0) p.push_back(q);
  bool closed = s.closed;
  if (closed && p.size() > 1 && p.front() == p.back()) p.pop_back();
  closed = closed && p.size() > 2;
  if (p.size() < 2) {
    DxfFlattened out;
    out.fault = fmt::format("{} fit points, expected at least 2", p.size());
    return out;
  }
  const std::size_t n = p.size(), spans = closed ? n : n - 1;
  std::vector<double> h;
  for (std::size_t i = 0; i < spans; ++i) h.push_back((p[(i + 1) % n] - p[i]).norm());
  const std::vector<Point2> m = slopes(p, h, s, closed);
  std::vector<Segment> segments;
  auto weighted = [](const Point2& q) { return Weighted(q.x(), q.y(), 1); };
  for (std::size_t i = 0; i < spans; ++i) {
    const std::size_t j = (i + 1) % n;
    segments.push_back({weighted(p[i]), weighted(p[i] + h[i] / 3 * m[i]), weighted(p[j] - h[i] / 3 * m[j]),
                        weighted(p[j])});
  }
  return flattened_segments(segments, closed);
}

}  // namespace

DxfFlattened flattened(const DxfSpline& spline) {
  return spline.control.empty() ? by_fit_points(spline) : by_control_points(spline);
}

DxfFlattened flattened(const DxfEllipse& e) {
  DxfFlattened out;
  const double round = 2 * portable::kPi;
  if (!(e.major.norm() > 0) || !(e.ratio > 0)) {
    out.fault = "no width, expected two axes";
    return out;
  }
  double turn = std::fmod(e.to - e.from, round);
  const double least = 1e-9;
  if (turn < 0) turn += round;
  if (turn < least || round - turn < least) turn = round;
  const Point2 minor = e.ratio * (e.flipped ? Point2(e.major.y(), -e.major.x()) : Point2(-e.major.y(), e.major.x()));
  const int parts = std::max(1, static_cast<int>(std::ceil(turn / (round / 4) - least)));
  const double half = turn / parts / 2, w = portable::cos(half);
  auto at = [&](double angle, double far) {
    return Point2(e.centre + far * (portable::cos(angle) * e.major + portable::sin(angle) * minor));
  };
  std::vector<Segment> segments;
  for (int k = 0; k < parts; ++k) {
    const double from = e.from + 2 * half * k;
    const Point2 a = at(from, 1), b = at(from + half, 1 / w), c = at(from + 2 * half, 1);
    segments.push_back({Weighted(a.x(), a.y(), 1), Weighted(b.x() * w, b.y() * w, w), Weighted(c.x(), c.y(), 1)});
  }
  return flattened_segments(segments, turn == round);
}

}  // namespace garment::io
