// Questions that need a search along the curve: polyline, nearest point, crossings with a line.
#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/base/portable_math.hpp"
#include "runtime/geometry/curve.hpp"

namespace garment::geometry {
namespace {

/// Root of `f` in [low, high], where f(low) and f(high) have opposite signs.
template <class Function>
double bisect(double low, double high, const Function& f) {
  bool rising = f(low) < 0;
  for (int i = 0; i < 100; ++i) {
    double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    ((f(middle) < 0) == rising ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Appends the parameters in (0, 1) between which the Bezier p is flat enough, its end included.
void flatten(const Point2 (&p)[4], double t0, double t1, double tolerance, int depth,
             std::vector<double>& out) {
  Point2 chord = p[3] - p[0];
  double length = chord.norm(), off = 0;
  for (int i : {1, 2}) {
    Point2 d = p[i] - p[0];
    double along = length > 0 ? chord.dot(d) / length : 0;
    double across = length > 0 ? std::fabs(chord.x() * d.y() - chord.y() * d.x()) / length : d.norm();
    off = std::max({off, across, -along, along - length});  // a control point past an end makes a hook
  }
  if (!(0.75 * off > tolerance) || depth == 0) {
    out.push_back(t1);
    return;
  }
  Point2 a = 0.5 * (p[0] + p[1]), b = 0.5 * (p[1] + p[2]), c = 0.5 * (p[2] + p[3]);
  Point2 ab = 0.5 * (a + b), bc = 0.5 * (b + c), middle = 0.5 * (ab + bc);
  double t = 0.5 * (t0 + t1);
  flatten({p[0], a, ab, middle}, t0, t, tolerance, depth - 1, out);
  flatten({middle, bc, c, p[3]}, t, t1, tolerance, depth - 1, out);
}

}  // namespace

std::vector<Point2> Curve::polyline(double tolerance, std::vector<double>* at) const {
  constexpr double kMaxParts = 20000;
  constexpr int kMaxDepth = 12;
  tolerance = std::max(tolerance, 1e-7 * length());
  std::vector<double> t{0};
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const Piece& piece = pieces_[k];
    std::vector<double> local;
    if (piece.bezier) {
      flatten(piece.p, 0, 1, tolerance, kMaxDepth, local);
    } else {
      // The sagitta of a part that turns by x is below R x^2/8.
      double turn = 2 * std::fabs(piece.half), chord = (piece.p[3] - piece.p[0]).norm();
      double parts = std::ceil(turn * std::sqrt(chord / (16 * tolerance * portable::sin(0.5 * turn))));
      int n = turn > 0 && parts > 1 ? static_cast<int>(std::min(parts, kMaxParts)) : 1;
      for (int i = 1; i <= n; ++i) local.push_back(static_cast<double>(i) / n);
    }
    for (double x : local) t.push_back(static_cast<double>(k) + x);
  }
  std::vector<Point2> points;
  if (at) at->clear();
  for (double x : t) {
    std::size_t k = std::min(static_cast<std::size_t>(x), pieces_.empty() ? 0 : pieces_.size() - 1);
    points.push_back(pieces_.empty() ? start_ : pieces_[k].point(x - static_cast<double>(k)));
    if (at) at->push_back(length_to(x));
  }
  if (points.size() == 1) {
    points.push_back(end_);
    if (at) at->push_back(length());
  }
  return points;
}

double Curve::nearest(const Point2& p) const {
  constexpr int kSamples = 24;
  double best = std::numeric_limits<double>::infinity(), best_t = 0;
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const Piece& piece = pieces_[k];
    auto offer = [&](double t) {
      double d = (piece.point(t) - p).squaredNorm();
      if (d < best) {
        best = d;
        best_t = static_cast<double>(k) + t;
      }
    };
    auto slope = [&](double t) { return (piece.point(t) - p).dot(piece.derivative(t)); };
    offer(0);
    offer(1);
    if (!piece.bezier && piece.half == 0) {
      Point2 chord = piece.p[3] - piece.p[0];
      if (chord.squaredNorm() > 0)
        offer(std::clamp(chord.dot(p - piece.p[0]) / chord.squaredNorm(), 0.0, 1.0));
      continue;
    }
    // The squared distance is least where its slope rises through zero.
    double t0 = 0, slope0 = slope(0);
    for (int i = 1; i <= kSamples; ++i) {
      double t1 = static_cast<double>(i) / kSamples, slope1 = slope(t1);
      if (slope0 < 0 && slope1 >= 0) offer(bisect(t0, t1, slope));
      t0 = t1;
      slope0 = slope1;
    }
  }
  return length_to(best_t);
}

std::vector<double> Curve::crossings(const Point2& normal, double offset) const {
  std::vector<double> found;
  double scale = std::fabs(offset) + normal.norm() * (start_.norm() + end_.norm() + length());
  double epsilon = 1e-13 * scale;
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const Piece& piece = pieces_[k];
    auto height = [&](double t) { return normal.dot(piece.point(t)) - offset; };
    // Between the ends and the places where the curve runs along the line, the height is monotone.
    std::vector<double> stops{0, 1};
    auto add_stop = [&](double t) {
      if (t > 0 && t < 1) stops.push_back(t);
    };
    if (piece.bezier) {
      double a = normal.dot(piece.p[1] - piece.p[0]), b = normal.dot(piece.p[2] - piece.p[1]),
             c = normal.dot(piece.p[3] - piece.p[2]);
      double qa = a - 2 * b + c, qb = b - a, disc = qb * qb - qa * a;  // qa t^2 + 2 qb t + a = 0
      if (disc >= 0) {
        double q = -(qb + std::copysign(std::sqrt(disc), qb));
        if (qa != 0) add_stop(q / qa);
        if (q != 0) add_stop(a / q);
      }
    } else if (piece.half != 0) {
      Point2 chord = piece.p[3] - piece.p[0];
      // The direction at t is the chord's, turned by half (1 - 2 t); it is square to the normal at these
      // angles.
      double base = portable::atan2(-normal.dot(chord), normal.y() * chord.x() - normal.x() * chord.y());
      for (int turn = -2; turn <= 2; ++turn) add_stop(0.5 * (1 - (base + portable::kPi * turn) / piece.half));
    }
    std::sort(stops.begin(), stops.end());
    double base_t = static_cast<double>(k);
    for (std::size_t i = 0; i < stops.size(); ++i) {
      double h = height(stops[i]);
      if (std::fabs(h) <= epsilon) {
        found.push_back(length_to(base_t + stops[i]));
      } else if (i > 0) {
        double before = height(stops[i - 1]);
        if (std::fabs(before) > epsilon && (before < 0) != (h < 0))
          found.push_back(length_to(base_t + bisect(stops[i - 1], stops[i], height)));
      }
    }
  }
  std::sort(found.begin(), found.end());
  double same = 1e-9 * length();
  found.erase(std::unique(found.begin(), found.end(), [&](double a, double b) { return b - a <= same; }),
              found.end());
  return found;
}

}  // namespace garment::geometry
