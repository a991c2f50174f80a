#include <cmath>

#include "runtime/base/portable_math.hpp"
#include "runtime/body/index.hpp"

namespace garment::body {

TrianglePoint closest_on_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                                  const Vector3d& c) {
  Vector3d ab = b - a, ac = c - a, ap = p - a;
  double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {a, Feature::corner_0};
  Vector3d bp = p - b;
  double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {b, Feature::corner_1};
  double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {a + d1 / (d1 - d3) * ab, Feature::edge_0};
  Vector3d cp = p - c;
  double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {c, Feature::corner_2};
  double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {a + d2 / (d2 - d6) * ac, Feature::edge_2};
  double va = d3 * d6 - d5 * d4;
  double e4 = d4 - d3, e5 = d5 - d6;
  if (va <= 0 && e4 >= 0 && e5 >= 0) return {b + e4 / (e4 + e5) * (c - b), Feature::edge_1};
  double scale = 1 / (va + vb + vc);
  return {a + ab * (vb * scale) + ac * (vc * scale), Feature::face};
}

// Van Oosterom & Strackee 1983.
double solid_angle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  Vector3d x = a - p, y = b - p, z = c - p;
  double lx = x.norm(), ly = y.norm(), lz = z.norm();
  double numerator = x.dot(y.cross(z));
  double denominator = lx * ly * lz + x.dot(y) * lz + y.dot(z) * lx + z.dot(x) * ly;
  if (numerator == 0 && denominator == 0) return 0;
  return portable::atan2(numerator, denominator) / (2 * portable::kPi);
}

}  // namespace garment::body
