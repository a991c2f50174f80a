#include "runtime/simulator/closest_point.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace garment::simulator {
namespace {

constexpr double kFlat = 1e-24;     // squared sine of an angle below which a triangle counts as a segment
constexpr double kParallel = 1e-8;  // squared sine below which both ends of parallel segments are tried too

/// How far p lies beyond u in the direction of w: the same bits whoever asks.
double towards(const Vector3d& p, const Vector3d& u, const Vector3d& w) { return (w - u).dot(p - u); }

double unit(double t) { return t < 0 ? 0 : (t > 1 ? 1 : t); }

TrianglePoint at_corner(int k) {
  TrianglePoint out;
  out.weights[k] = 1;
  out.feature = static_cast<Feature>(static_cast<int>(Feature::corner_a) + k);
  return out;
}

/// `k` names the edge by its first corner; t runs from there.
TrianglePoint on_edge(int k, double t) {
  TrianglePoint out;
  out.weights[k] = 1 - t;
  out.weights[(k + 1) % 3] = t;
  out.feature = static_cast<Feature>(static_cast<int>(Feature::edge_ab) + k);
  return out;
}

double edge_parameter(double from_u, double from_w) { return from_u / (from_u + from_w); }

TrianglePoint closest_on_flat(const Vector3d& p, const std::array<const Vector3d*, 3>& corner) {
  TrianglePoint best;
  double least = -1;
  for (int k = 0; k < 3; ++k) {
    const Vector3d &u = *corner[k], &w = *corner[(k + 1) % 3];
    const SegmentPoint s = closest_on_segment(p, u, w);
    const double d = (p - u - s.t * (w - u)).squaredNorm();
    if (least >= 0 && d >= least) continue;
    least = d;
    best = s.feature == Feature::edge_ab ? on_edge(k, s.t)
                                         : at_corner(s.feature == Feature::corner_a ? k : (k + 1) % 3);
  }
  return best;
}

}  // namespace

SegmentPoint closest_on_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const double from_a = towards(p, a, b), from_b = towards(p, b, a);
  if (from_a <= 0) return {0, Feature::corner_a};
  if (from_b <= 0) return {1, Feature::corner_b};
  return {edge_parameter(from_a, from_b), Feature::edge_ab};
}

TrianglePoint closest_on_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                                  const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a, ap = p - a;
  const Vector3d n = ab.cross(ac);
  const double nn = n.squaredNorm();
  if (!(nn > kFlat * ab.squaredNorm() * ac.squaredNorm())) return closest_on_flat(p, {&a, &b, &c});
  const double a_b = ab.dot(ap), a_c = ac.dot(ap);
  if (a_b <= 0 && a_c <= 0) return at_corner(0);
  const double b_a = towards(p, b, a), b_c = towards(p, b, c);
  if (b_a <= 0 && b_c <= 0) return at_corner(1);
  const double c_a = towards(p, c, a), c_b = towards(p, c, b);
  if (c_a <= 0 && c_b <= 0) return at_corner(2);
  const double wc = ab.cross(ap).dot(n);
  if (wc <= 0 && a_b > 0 && b_a > 0) return on_edge(0, edge_parameter(a_b, b_a));
  const double wa = (c - b).cross(p - b).dot(n);
  if (wa <= 0 && b_c > 0 && c_b > 0) return on_edge(1, edge_parameter(b_c, c_b));
  const double wb = ap.cross(ac).dot(n);
  if (wb <= 0 && c_a > 0 && a_c > 0) return on_edge(2, edge_parameter(c_a, a_c));
  if (wa <= 0 || wb <= 0 || wc <= 0) return closest_on_flat(p, {&a, &b, &c});  // rounding beside a corner
  const double sum = wa + wb + wc;
  return {{wa / sum, wb / sum, wc / sum}, Feature::face};
}

SegmentPair closest_of_segments(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const Vector3d u = b - a, v = d - c, r = a - c;
  const double uu = u.squaredNorm(), vv = v.squaredNorm();
  if (uu <= 0 && vv <= 0) return {0, 0};
  if (uu <= 0) return {0, unit(v.dot(r) / vv)};
  if (vv <= 0) return {unit(-u.dot(r) / uu), 0};
  const double uv = u.dot(v), ur = u.dot(r), vr = v.dot(r);
  const double determinant = uu * vv - uv * uv;
  SegmentPair out;
  if (determinant > kParallel * uu * vv) {
    out.s = unit((uv * vr - ur * vv) / determinant);
    out.t = unit((uv * out.s + vr) / vv);
    out.s = unit((uv * out.t - ur) / uu);
    return out;
  }
  double least = -1;
  auto try_pair = [&](double s, double t) {
    const double distance = (r + s * u - t * v).squaredNorm();
    if (least >= 0 && distance >= least) return;
    least = distance;
    out = {s, t};
  };
  for (double end : {0.0, 1.0}) {
    try_pair(end, unit((uv * end + vr) / vv));
    try_pair(unit((uv * end - ur) / uu), end);
  }
  if (determinant > 0) {
    double s = unit((uv * vr - ur * vv) / determinant);
    const double t = unit((uv * s + vr) / vv);
    s = unit((uv * t - ur) / uu);
    try_pair(s, t);
  }
  return out;
}

}  // namespace garment::simulator
