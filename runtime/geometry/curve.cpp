#include "runtime/geometry/curve.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/base/portable_math.hpp"
#include "runtime/geometry/gauss.hpp"

namespace garment::geometry {
namespace {

Point2 rotated(const Point2& v, double angle) {
  double c = portable::cos(angle), s = portable::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

/// (2a - sin 2a) / sin^3 a, even and smooth in `a`; its limit is 4/3. The plain form cancels for flat arcs.
double segment_factor(double a) {
  double s = portable::sin(a);
  if (std::fabs(a) > 0.3) return (2 * a - portable::sin(2 * a)) / (s * s * s);
  double x2 = 4 * a * a, term = 8.0 / 6, sum = 0;  // (x - sin x)/a^3 with x = 2a
  for (int n = 4; n < 26; n += 2) {
    sum += term;
    term *= -x2 / (n * (n + 1));
  }
  double ratio = a == 0 ? 1 : a / s;
  return sum * ratio * ratio * ratio;
}

}  // namespace

//   An arc is walked from its chord, without its centre, so that nearly straight arcs lose no digits:
//   point(t) = start + sin(a t)/sin(a) * R(a (1 - t)) (end - start),   a = half the angle turned
Point2 Curve::Piece::point(double t) const {
  if (t <= 0) return p[0];
  if (t >= 1) return p[3];
  if (bezier) {
    double u = 1 - t;
    return u * u * u * p[0] + 3 * u * u * t * p[1] + 3 * u * t * t * p[2] + t * t * t * p[3];
  }
  if (half == 0) return p[0] + t * (p[3] - p[0]);
  double ratio = portable::sin(half * t) / portable::sin(half);
  return p[0] + ratio * rotated(p[3] - p[0], half * (1 - t));
}

Point2 Curve::Piece::derivative(double t) const {
  if (bezier) {
    double u = 1 - t;
    return 3 * (u * u * (p[1] - p[0]) + 2 * u * t * (p[2] - p[1]) + t * t * (p[3] - p[2]));
  }
  if (half == 0) return p[3] - p[0];
  return half / portable::sin(half) * rotated(p[3] - p[0], half * (1 - 2 * t));
}

Point2 Curve::Piece::direction(double t) const {
  double scale = (p[3] - p[0]).norm();
  if (bezier) scale += (p[1] - p[0]).norm() + (p[2] - p[0]).norm();
  Point2 d = derivative(t);
  if (bezier && !(d.norm() > 1e-9 * scale)) {
    // The derivative vanishes where control points coincide, and at cusps: there the way onward counts.
    d = t < 1 ? derivative(std::min(1.0, t + 1e-5)) : derivative(1 - 1e-5);
  }
  double norm = d.norm();
  if (!(norm > 0)) return {1, 0};
  return d / norm;
}

double Curve::Piece::arc_length() const {
  double chord = (p[3] - p[0]).norm();
  return half == 0 ? chord : chord * half / portable::sin(half);
}

Curve::Curve(Point2 start, Point2 end, Shape shape) : start_(start), end_(end), shape_(std::move(shape)) {
  if (const auto* q = std::get_if<Quadratic>(&shape_)) {
    add_bezier(start_, start_ + 2.0 / 3 * (q->control - start_), end_ + 2.0 / 3 * (q->control - end_), end_);
  } else if (const auto* c = std::get_if<Cubic>(&shape_)) {
    add_bezier(start_, c->control_1, c->control_2, end_);
  } else if (const auto* through = std::get_if<Through>(&shape_)) {
    add_through(through->points);
  } else if (const auto* chain = std::get_if<Chain>(&shape_)) {
    for (const Curve& link : *chain->links)
      pieces_.insert(pieces_.end(), link.pieces_.begin(), link.pieces_.end());
  } else {
    Piece piece;
    piece.p[0] = piece.p[1] = start_;
    piece.p[2] = piece.p[3] = end_;
    double chord = (end_ - start_).norm();
    if (const auto* arc = std::get_if<Arc>(&shape_); arc && chord > 0)
      piece.half = 2 * portable::atan(2 * arc->bulge / chord);
    pieces_.push_back(piece);
  }
  make_table();
  if (std::isfinite(length())) return;
  // Numbers that no drawing has (infinite, or so large that squares overflow): keep a length that can be
  // worked with.
  pieces_.clear();
  make_table();
}

void Curve::make_table() {
  table_s_.assign(1, 0);
  table_t_.assign(1, 0);
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    if (!piece.bezier) {
      table_s_.push_back(table_s_.back() + piece.arc_length());
      table_t_.push_back(static_cast<double>(i) + 1);
      continue;
    }
    auto speed = [&](double t) { return piece.derivative(t).norm(); };
    double scale = (piece.p[1] - piece.p[0]).norm() + (piece.p[2] - piece.p[1]).norm() +
                   (piece.p[3] - piece.p[2]).norm();
    for (int k = 0; k < 4; ++k)
      add_table(i, k / 4.0, (k + 1) / 4.0, integrate(kGauss8, k / 4.0, (k + 1) / 4.0, 0.0, speed), scale, 0);
  }
}

void Curve::add_bezier(const Point2& p0, const Point2& p1, const Point2& p2, const Point2& p3) {
  Piece piece;
  piece.p[0] = p0;
  piece.p[1] = p1;
  piece.p[2] = p2;
  piece.p[3] = p3;
  piece.bezier = true;
  pieces_.push_back(piece);
}

// Centripetal Catmull-Rom: knots at sums of sqrt(distance); beyond each end the next point is mirrored in the
// end. (Yuksel, Schaefer, Keyser 2011: no cusps and no loops within a piece.)
void Curve::add_through(const std::vector<Point2>& interior) {
  std::vector<Point2> q{start_};
  for (const Point2& p : interior)
    if (p != q.back()) q.push_back(p);
  if (q.size() > 1 && q.back() == end_) q.pop_back();
  q.push_back(end_);
  q.insert(q.begin(), 2 * q[0] - q[1]);
  q.push_back(2 * q.back() - q[q.size() - 2]);
  for (std::size_t i = 1; i + 2 < q.size(); ++i) {
    double d0 = std::sqrt((q[i] - q[i - 1]).norm()), d1 = std::sqrt((q[i + 1] - q[i]).norm()),
           d2 = std::sqrt((q[i + 2] - q[i + 1]).norm());
    Point2 chord = q[i + 1] - q[i];
    if (!(d0 > 0 && d1 > 0 && d2 > 0)) {
      add_bezier(q[i], q[i] + chord / 3, q[i + 1] - chord / 3, q[i + 1]);
      continue;
    }
    Point2 m1 = chord + d1 * ((q[i] - q[i - 1]) / d0 - (q[i + 1] - q[i - 1]) / (d0 + d1));
    Point2 m2 = chord + d1 * ((q[i + 2] - q[i + 1]) / d2 - (q[i + 2] - q[i]) / (d1 + d2));
    add_bezier(q[i], q[i] + m1 / 3, q[i + 1] - m2 / 3, q[i + 1]);
  }
}

void Curve::add_table(std::size_t piece, double t0, double t1, double whole, double scale, int depth) {
  constexpr double kTolerance = 1e-14;
  constexpr int kMaxDepth = 14;
  auto speed = [&](double t) { return pieces_[piece].derivative(t).norm(); };
  double middle = 0.5 * (t0 + t1);
  double left = integrate(kGauss8, t0, middle, 0.0, speed),
         right = integrate(kGauss8, middle, t1, 0.0, speed);
  if (std::fabs(left + right - whole) > kTolerance * scale && depth < kMaxDepth) {
    add_table(piece, t0, middle, left, scale, depth + 1);
    add_table(piece, middle, t1, right, scale, depth + 1);
    return;
  }
  table_s_.push_back(table_s_.back() + whole);
  table_t_.push_back(static_cast<double>(piece) + t1);
}

double Curve::length() const { return table_s_.empty() ? 0 : table_s_.back(); }

double Curve::length_to(double t) const {
  if (pieces_.empty() || t <= 0) return 0;
  if (t >= static_cast<double>(pieces_.size())) return length();
  std::size_t i = std::upper_bound(table_t_.begin(), table_t_.end(), t) - table_t_.begin() - 1;
  std::size_t k = static_cast<std::size_t>(table_t_[i]);  // an interval never spans two pieces
  const Piece& piece = pieces_[k];
  if (!piece.bezier) return table_s_[i] + (t - table_t_[i]) * (table_s_[i + 1] - table_s_[i]);
  double base = static_cast<double>(k);
  auto speed = [&](double x) { return piece.derivative(x).norm(); };
  return std::min(table_s_[i] + integrate(kGauss8, table_t_[i] - base, t - base, 0.0, speed),
                  table_s_[i + 1]);
}

double Curve::parameter_at(double s) const {
  if (pieces_.empty() || !(s > 0)) return 0;
  if (s >= length()) return static_cast<double>(pieces_.size());
  std::size_t i = std::upper_bound(table_s_.begin(), table_s_.end(), s) - table_s_.begin() - 1;
  double t0 = table_t_[i], t1 = table_t_[i + 1], s0 = table_s_[i], s1 = table_s_[i + 1];
  std::size_t k = static_cast<std::size_t>(t0);
  double t = t0 + (t1 - t0) * (s - s0) / (s1 - s0);
  const Piece& piece = pieces_[k];
  if (!piece.bezier) return t;
  // Newton, kept inside a shrinking bracket: at a cusp the speed is zero.
  double base = static_cast<double>(k), low = t0, high = t1;
  auto speed = [&](double x) { return piece.derivative(x).norm(); };
  for (int iteration = 0; iteration < 60; ++iteration) {
    double error = integrate(kGauss8, t0 - base, t - base, 0.0, speed) - (s - s0);
    if (std::fabs(error) <= 1e-16 * length()) break;
    (error > 0 ? high : low) = t;
    double next = t - error / speed(t - base);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == t) break;
    t = next;
  }
  return t;
}

Point2 Curve::point_at(double s) const {
  if (pieces_.empty()) return start_;
  double t = parameter_at(s);
  std::size_t k = std::min(static_cast<std::size_t>(t), pieces_.size() - 1);
  return pieces_[k].point(t - static_cast<double>(k));
}

Point2 Curve::tangent_at(double s) const {
  if (pieces_.empty()) return {1, 0};
  double t = parameter_at(s);
  std::size_t k = std::min(static_cast<std::size_t>(t), pieces_.size() - 1);
  return pieces_[k].direction(t - static_cast<double>(k));
}

//   An arc's segment between chord and arc: area c^2/8 * (2a - sin 2a)/sin^2 a, positive where it lies to the
//   left, where it takes area away from the loop.
double Curve::area_term() const {
  double sum = 0;
  for (const Piece& piece : pieces_) {
    if (piece.bezier) {
      sum += 0.5 * integrate(kGauss5, 0, 1, 0.0,
                             [&](double t) { return cross(piece.point(t), piece.derivative(t)); });
    } else {
      double chord = (piece.p[3] - piece.p[0]).norm();
      sum += 0.5 * cross(piece.p[0], piece.p[3]) -
             chord * chord / 8 * segment_factor(piece.half) * portable::sin(piece.half);
    }
  }
  return sum;
}

Point2 Curve::moment_term() const {
  Point2 sum(0, 0);
  for (const Piece& piece : pieces_) {
    if (piece.bezier) {
      sum += integrate(kGauss5, 0, 1, Point2(0, 0),
                       [&](double t) -> Point2 {
                         Point2 p = piece.point(t);
                         return p * cross(p, piece.derivative(t));
                       }) /
             3;
      continue;
    }
    sum += cross(piece.p[0], piece.p[3]) / 6 * (piece.p[0] + piece.p[3]);
    if (piece.half == 0) continue;
    // segment area * chord middle, and the rest of its first moment along the normal (from its centroid)
    Point2 along = piece.p[3] - piece.p[0],
           normal(-along.y(), along.x());  // normal: |chord| long, to the left
    double chord2 = along.squaredNorm(), factor = segment_factor(piece.half);
    double area = chord2 / 8 * factor * portable::sin(piece.half);
    double lift = chord2 * (1.0 / 12 - factor * portable::cos(piece.half) / 16);
    sum -= area * 0.5 * (piece.p[0] + piece.p[3]) + lift * normal;
  }
  return sum;
}

template <class Map>
Curve Curve::mapped(const Map& map, double bulge_factor) const {
  Shape shape = shape_;
  if (auto* q = std::get_if<Quadratic>(&shape)) q->control = map(q->control);
  if (auto* c = std::get_if<Cubic>(&shape)) *c = Cubic{map(c->control_1), map(c->control_2)};
  if (auto* arc = std::get_if<Arc>(&shape)) arc->bulge *= bulge_factor;
  if (auto* through = std::get_if<Through>(&shape))
    for (Point2& p : through->points) p = map(p);
  if (auto* links = std::get_if<Chain>(&shape)) {
    auto made = std::make_shared<std::vector<Curve>>();
    for (const Curve& link : *links->links) made->push_back(link.mapped(map, bulge_factor));
    links->links = std::move(made);
  }
  return Curve(map(start_), map(end_), std::move(shape));
}

Curve Curve::reversed() const {
  Shape shape = shape_;
  if (auto* c = std::get_if<Cubic>(&shape)) std::swap(c->control_1, c->control_2);
  if (auto* arc = std::get_if<Arc>(&shape)) arc->bulge = -arc->bulge;
  if (auto* through = std::get_if<Through>(&shape))
    std::reverse(through->points.begin(), through->points.end());
  if (auto* links = std::get_if<Chain>(&shape)) {
    auto made = std::make_shared<std::vector<Curve>>();
    for (std::size_t k = links->links->size(); k-- > 0;) made->push_back((*links->links)[k].reversed());
    links->links = std::move(made);
  }
  return Curve(end_, start_, std::move(shape));
}

Curve Curve::mirrored_x(double axis_x) const {
  return mapped([&](const Point2& p) { return Point2(2 * axis_x - p.x(), p.y()); }, -1);
}

Curve Curve::transformed(const Eigen::Isometry2d& motion) const {
  double sense = motion.linear().determinant() < 0 ? -1 : 1;
  return mapped([&](const Point2& p) -> Point2 { return motion * p; }, sense);
}

Curve Curve::scaled(double factor) const {
  return mapped([&](const Point2& p) -> Point2 { return factor * p; }, std::fabs(factor));
}

}  // namespace garment::geometry
