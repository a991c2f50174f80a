// Closest points against a search over the parts and against FCL.
#include <fcl/narrowphase/detail/primitive_shape_algorithm/triangle_distance.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "runtime/simulator/closest_point.hpp"
#include "tests/unit/simulator/collision_support.hpp"

using namespace garment;
using namespace garment::simulator;
using garment::test::Random;

namespace {

double distance(const Vector3d& p, const std::array<Vector3d, 3>& t, const TrianglePoint& q) {
  return (p - q.weights[0] * t[0] - q.weights[1] * t[1] - q.weights[2] * t[2]).norm();
}

/// Least distance over a grid of barycentric points, refined around the best one.
double searched(const Vector3d& p, const std::array<Vector3d, 3>& t) {
  double best = 1e300, u0 = 0.5, v0 = 0.5;
  for (double size = 0.5; size > 1e-9; size *= 0.6) {
    const double cu = u0, cv = v0;
    for (int i = -5; i <= 5; ++i)
      for (int j = -5; j <= 5; ++j) {
        const double u = std::clamp(cu + size * i / 5, 0.0, 1.0),
                     v = std::clamp(cv + size * j / 5, 0.0, 1.0 - u);
        const double d = (p - (1 - u - v) * t[0] - u * t[1] - v * t[2]).norm();
        if (d < best) {
          best = d;
          u0 = u;
          v0 = v;
        }
      }
  }
  return best;
}

double searched(const std::array<Vector3d, 4>& x) {
  double best = 1e300, s0 = 0.5, t0 = 0.5;
  for (double size = 0.5; size > 1e-9; size *= 0.6) {
    const double cs = s0, ct = t0;
    for (int i = -5; i <= 5; ++i)
      for (int j = -5; j <= 5; ++j) {
        const double s = std::clamp(cs + size * i / 5, 0.0, 1.0), t = std::clamp(ct + size * j / 5, 0.0, 1.0);
        const double d = (x[0] + s * (x[1] - x[0]) - x[2] - t * (x[3] - x[2])).norm();
        if (d < best) {
          best = d;
          s0 = s;
          t0 = t;
        }
      }
  }
  return best;
}

double distance(const std::array<Vector3d, 4>& x, const SegmentPair& p) {
  return (x[0] + p.s * (x[1] - x[0]) - x[2] - p.t * (x[3] - x[2])).norm();
}

}  // namespace

TEST_CASE("the closest point of a triangle is no farther than any other of its points", "[collision]") {
  Random random(1);
  for (int n = 0; n < 2000; ++n) {
    const std::array<Vector3d, 3> t{random.vector(1), random.vector(1), random.vector(1)};
    const Vector3d p = random.vector(2);
    const TrianglePoint q = closest_on_triangle(p, t[0], t[1], t[2]);
    CHECK(q.weights[0] + q.weights[1] + q.weights[2] == Approx(1).margin(1e-14));
    CHECK(std::min({q.weights[0], q.weights[1], q.weights[2]}) >= 0);
    CHECK(distance(p, t, q) == Approx(searched(p, t)).margin(1e-7));
  }
}

TEST_CASE("the closest point satisfies the conditions of a minimum over a convex set", "[collision]") {
  Random random(2);
  for (int n = 0; n < 20000; ++n) {
    std::array<Vector3d, 3> t{random.vector(1), random.vector(1), random.vector(1)};
    if (n % 3 == 1) t[2] = t[0] + 0.5 * (t[1] - t[0]) + random.vector(1e-4);  // a sliver
    const Vector3d p = n % 2 == 0 ? random.vector(2) : Vector3d(t[0] + random.vector(1e-3));
    const TrianglePoint q = closest_on_triangle(p, t[0], t[1], t[2]);
    const Vector3d on = q.weights[0] * t[0] + q.weights[1] * t[1] + q.weights[2] * t[2];
    for (const Vector3d& corner : t) REQUIRE((p - on).dot(corner - on) <= 1e-9 * (p - on).norm() + 1e-14);
  }
}

TEST_CASE("degenerate triangles are segments and points", "[collision]") {
  const Vector3d a(0, 0, 0), b(1, 0, 0), c(2, 0, 0);
  CHECK(distance({0.25, 1, 0}, {a, b, c}, closest_on_triangle({0.25, 1, 0}, a, b, c)) == Approx(1));
  CHECK(distance({1.75, 1, 0}, {a, c, b}, closest_on_triangle({1.75, 1, 0}, a, c, b)) == Approx(1));
  CHECK(distance({5, 0, 0}, {a, a, a}, closest_on_triangle({5, 0, 0}, a, a, a)) == Approx(5));
  CHECK(distance({3, 0, 0}, {a, a, c}, closest_on_triangle({3, 0, 0}, a, a, c)) == Approx(1));
}

TEST_CASE("features name the part that is closest", "[collision]") {
  const Vector3d a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  CHECK(closest_on_triangle({0.2, 0.2, 1}, a, b, c).feature == Feature::face);
  CHECK(closest_on_triangle({0.5, -1, 1}, a, b, c).feature == Feature::edge_ab);
  CHECK(closest_on_triangle({1, 1, 1}, a, b, c).feature == Feature::edge_bc);
  CHECK(closest_on_triangle({-1, 0.5, 1}, a, b, c).feature == Feature::edge_ca);
  CHECK(closest_on_triangle({-1, -1, 1}, a, b, c).feature == Feature::corner_a);
  CHECK(closest_on_triangle({3, -1, 1}, a, b, c).feature == Feature::corner_b);
  CHECK(closest_on_triangle({-1, 3, 1}, a, b, c).feature == Feature::corner_c);
}

TEST_CASE("segments: skew, parallel and degenerate", "[collision]") {
  Random random(3);
  for (int n = 0; n < 3000; ++n) {
    std::array<Vector3d, 4> x{random.vector(1), random.vector(1), random.vector(1), random.vector(1)};
    if (n % 4 == 1) x[3] = x[2] + random.uniform(-2, 2) * (x[1] - x[0]);
    if (n % 4 == 2) x[3] = x[2] + random.uniform(-2, 2) * (x[1] - x[0]) + random.vector(1e-7);
    if (n % 40 == 3) x[1] = x[0];
    if (n % 80 == 3) x[3] = x[2];
    const SegmentPair p = closest_of_segments(x[0], x[1], x[2], x[3]);
    CHECK(p.s >= 0);
    CHECK(p.s <= 1);
    CHECK(p.t >= 0);
    CHECK(p.t <= 1);
    CHECK(distance(x, p) == Approx(searched(x)).margin(3e-5));
    CHECK(distance(x, p) <= searched(x) + 1e-9);
  }
}

TEST_CASE("triangle distances made of our parts agree with FCL", "[collision]") {
  Random random(4);
  for (int n = 0; n < 300; ++n) {
    const std::array<Vector3d, 3> s{random.vector(1), random.vector(1), random.vector(1)};
    const Vector3d away = Vector3d(4, 0, 0) + random.vector(1);
    const std::array<Vector3d, 3> t{away + random.vector(1), away + random.vector(1),
                                    away + random.vector(1)};
    double ours = 1e300;
    for (int i = 0; i < 3; ++i) {
      ours = std::min(ours, distance(s[i], t, closest_on_triangle(s[i], t[0], t[1], t[2])));
      ours = std::min(ours, distance(t[i], s, closest_on_triangle(t[i], s[0], s[1], s[2])));
      for (int j = 0; j < 3; ++j) {
        const std::array<Vector3d, 4> x{s[i], s[(i + 1) % 3], t[j], t[(j + 1) % 3]};
        ours = std::min(ours, distance(x, closest_of_segments(x[0], x[1], x[2], x[3])));
      }
    }
    Vector3d p, q;
    const double theirs = fcl::detail::TriangleDistanced::triDistance(s.data(), t.data(), p, q);
    CHECK(ours == Approx(theirs).margin(1e-9));
  }
}
