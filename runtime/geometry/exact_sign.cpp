#include "runtime/geometry/exact_sign.hpp"

#include <array>
#include <cmath>

namespace garment::geometry {
namespace {

/// Sum of doubles that do not overlap, smallest magnitude first; zeros are left out. Holds at most N of them.
template <int N>
struct Expansion {
  std::array<double, N> part;
  int n = 0;

  int sign() const { return n == 0 ? 0 : part[n - 1] > 0 ? 1 : -1; }
};

struct TwoSum {
  double high, low;
};

TwoSum two_sum(double a, double b) {
  const double high = a + b;
  const double b_virtual = high - a;
  const double a_virtual = high - b_virtual;
  return {high, (a - a_virtual) + (b - b_virtual)};
}

TwoSum split(double a) {
  const double c = 134217729.0 * a;  // 2^27 + 1
  const double high = c - (c - a);
  return {high, a - high};
}

TwoSum two_product(double a, double b) {
  const double high = a * b;
  const TwoSum x = split(a), y = split(b);
  const double low = x.low * y.low - (((high - x.high * y.high) - x.low * y.high) - x.high * y.low);
  return {high, low};
}

template <int N>
void add(Expansion<N>& e, double b) {  // Shewchuk's grow-expansion, zeros eliminated
  int kept = 0;
  double q = b;
  for (int i = 0; i < e.n; ++i) {
    const TwoSum s = two_sum(q, e.part[i]);
    if (s.low != 0) e.part[kept++] = s.low;
    q = s.high;
  }
  if (q != 0) e.part[kept++] = q;
  e.n = kept;
}

Expansion<2> difference(double a, double b) {
  const TwoSum s = two_sum(a, -b);
  Expansion<2> e;
  if (s.low != 0) e.part[e.n++] = s.low;
  if (s.high != 0) e.part[e.n++] = s.high;
  return e;
}

/// sum += factor * a * b
template <int N, int A, int B>
void add_product(Expansion<N>& sum, const Expansion<A>& a, const Expansion<B>& b, double factor) {
  for (int i = 0; i < a.n; ++i)
    for (int j = 0; j < b.n; ++j) {
      const TwoSum p = two_product(a.part[i], b.part[j]);
      add(sum, factor * p.low);
      add(sum, factor * p.high);
    }
}

using Difference = std::array<Expansion<2>, 3>;

Expansion<16> minor_of(const Difference& u, const Difference& v, int x, int y) {
  Expansion<16> e;
  add_product(e, u[x], v[y], 1);
  add_product(e, u[y], v[x], -1);
  return e;
}

int exact_orient_3d(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                    const Eigen::Vector3d& d) {
  Difference u, v, w;
  for (int k = 0; k < 3; ++k) {
    u[k] = difference(b[k], a[k]);
    v[k] = difference(c[k], a[k]);
    w[k] = difference(d[k], a[k]);
  }
  Expansion<192> sum;
  add_product(sum, minor_of(u, v, 1, 2), w[0], 1);
  add_product(sum, minor_of(u, v, 2, 0), w[1], 1);
  add_product(sum, minor_of(u, v, 0, 1), w[2], 1);
  return sum.sign();
}

}  // namespace

int orient_3d(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
              const Eigen::Vector3d& d) {
  const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
  const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
  const double wx = d[0] - a[0], wy = d[1] - a[1], wz = d[2] - a[2];
  const double yz = uy * vz, zy = uz * vy, zx = uz * vx, xz = ux * vz, xy = ux * vy, yx = uy * vx;
  const double value = (yz - zy) * wx + (zx - xz) * wy + (xy - yx) * wz;
  const double permanent = (std::fabs(yz) + std::fabs(zy)) * std::fabs(wx) +
                           (std::fabs(zx) + std::fabs(xz)) * std::fabs(wy) +
                           (std::fabs(xy) + std::fabs(yx)) * std::fabs(wz);
  const double bound = 8e-16 * permanent;  // Shewchuk: (7 + 56 eps) eps, eps = 2^-53
  if (value > bound) return 1;
  if (value < -bound) return -1;
  if (permanent == 0) return 0;  // differences vanish only when they are exactly zero
  return exact_orient_3d(a, b, c, d);
}

int orient_2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const double left = (b[0] - a[0]) * (c[1] - a[1]), right = (b[1] - a[1]) * (c[0] - a[0]);
  const double value = left - right;
  const double sum = std::fabs(left) + std::fabs(right);
  const double bound = 3.4e-16 * sum;  // Shewchuk: (3 + 16 eps) eps
  if (value > bound) return 1;
  if (value < -bound) return -1;
  if (sum == 0) return 0;
  Expansion<16> e;
  add_product(e, difference(b[0], a[0]), difference(c[1], a[1]), 1);
  add_product(e, difference(b[1], a[1]), difference(c[0], a[0]), -1);
  return e.sign();
}

}  // namespace garment::geometry
