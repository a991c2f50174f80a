// The certificate against brute force: separating axes in integers, on lattices where touching is common.
#include "runtime/simulator/certificate.hpp"

#include <catch2/catch.hpp>
#include <cstdint>
#include <random>

#include "runtime/base/parallel.hpp"
#include "runtime/geometry/triangle_hit.hpp"

using garment::model::Indices;
using garment::model::Vector3d;
using garment::simulator::Certificate;
using garment::simulator::certify;
using Int3 = std::array<std::int64_t, 3>;
using IntTriangle = std::array<Int3, 3>;

namespace {

Int3 minus(const Int3& a, const Int3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Int3 cross(const Int3& a, const Int3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
std::int64_t dot(const Int3& a, const Int3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

bool separates(const Int3& axis, const IntTriangle& s, const IntTriangle& t) {
  std::int64_t s_low = INT64_MAX, s_high = INT64_MIN, t_low = INT64_MAX, t_high = INT64_MIN;
  for (int k = 0; k < 3; ++k) {
    s_low = std::min(s_low, dot(axis, s[k]));
    s_high = std::max(s_high, dot(axis, s[k]));
    t_low = std::min(t_low, dot(axis, t[k]));
    t_high = std::max(t_high, dot(axis, t[k]));
  }
  return s_high < t_low || t_high < s_low;
}

/// Exact: every direction that can separate two triangles, segments or points in space, in a plane or on a
/// line.
bool apart(const IntTriangle& s, const IntTriangle& t) {
  std::vector<Int3> edges;
  for (int k = 0; k < 3; ++k) {
    edges.push_back(minus(s[(k + 1) % 3], s[k]));
    edges.push_back(minus(t[(k + 1) % 3], t[k]));
  }
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) edges.push_back(minus(s[k], t[l]));
  for (const Int3& e : edges)
    if (separates(e, s, t)) return true;
  for (const Int3& e : edges)
    for (const Int3& f : edges) {
      const Int3 normal = cross(e, f);
      if (separates(normal, s, t)) return true;
      if (separates(cross(normal, e), s, t) || separates(cross(normal, f), s, t)) return true;
    }
  return false;
}

std::size_t brute_force(const std::vector<IntTriangle>& soup) {
  std::size_t hits = 0;
  for (std::size_t i = 0; i < soup.size(); ++i)
    for (std::size_t j = i + 1; j < soup.size(); ++j) {
      const IntTriangle &s = soup[i], &t = soup[j];
      int shared = 0, a = 0, b = 0;
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          if (s[k] == t[l]) {
            ++shared;
            a = k;
            b = l;
          }
      if (shared == 0)
        hits += !apart(s, t);
      else if (shared == 1)
        hits += !apart({s[(a + 1) % 3], s[(a + 2) % 3], s[(a + 2) % 3]}, t) ||
                !apart({t[(b + 1) % 3], t[(b + 2) % 3], t[(b + 2) % 3]}, s);
    }
  return hits;
}

struct Mesh {
  std::vector<Indices<3>> triangles;
  std::vector<Vector3d> positions;
};

Mesh to_mesh(const std::vector<IntTriangle>& soup, double unit) {
  Mesh m;
  for (const IntTriangle& t : soup) {
    const int n = static_cast<int>(m.positions.size());
    m.triangles.push_back({n, n + 1, n + 2});
    for (const Int3& p : t)
      m.positions.emplace_back(static_cast<double>(p[0]) * unit, static_cast<double>(p[1]) * unit,
                               static_cast<double>(p[2]) * unit);
  }
  return m;
}

std::vector<IntTriangle> random_soup(std::mt19937& random, int n, int lattice, int reach) {
  auto in = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  std::vector<IntTriangle> soup(n);
  for (IntTriangle& t : soup) {
    const Int3 at{in(0, lattice), in(0, lattice), in(0, lattice)};
    for (Int3& p : t)
      for (int d = 0; d < 3; ++d) p[d] = at[d] + in(-reach, reach);
  }
  return soup;
}

/// Cloth strip of n x 4 cells, 1 cm, with points given by `place(x, y)`.
template <class Place>
Mesh strip(int n, const Place& place) {
  Mesh m;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= 4; ++j) m.positions.push_back(place(0.01 * i, 0.01 * j));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 4; ++j) {
      const int a = 5 * i + j, b = a + 5;
      m.triangles.push_back({a, b, b + 1});
      m.triangles.push_back({a, b + 1, a + 1});
    }
  return m;
}

garment::body::TriangleMesh cube(double half) {
  garment::body::TriangleMesh m;
  for (int k = 0; k < 8; ++k)
    m.vertices.emplace_back(k & 1 ? half : -half, k & 2 ? half : -half, k & 4 ? half : -half);
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return m;
}

}  // namespace

TEST_CASE("certificate counts what brute force in integers counts", "[certificate]") {
  std::mt19937 random(7);
  std::size_t all = 0;
  for (int round = 0; round < 30; ++round) {
    const auto soup = random_soup(random, 60, 4 + round % 7, 1 + round % 3);
    const std::size_t expected = brute_force(soup);
    const Mesh m = to_mesh(soup, round % 2 ? 0x1p-7 : 0x1p-10);
    const Certificate c = certify(m.triangles, m.positions);
    CHECK(c.self_intersections == expected);
    CHECK(c.self_hits.size() == c.self_intersections);
    all += expected;
  }
  CHECK(all > 1000);
}

TEST_CASE("segments and triangles on a lattice meet as in integers, degenerate ones too", "[certificate]") {
  std::mt19937 random(11);
  int met = 0;
  for (int round = 0; round < 4000; ++round) {
    const auto soup = random_soup(random, 2, 1, 1 + round % 2);
    const Mesh m = to_mesh(soup, 0x1p-6);
    const garment::geometry::Triangle3 s{m.positions[0], m.positions[1], m.positions[2]};
    const garment::geometry::Triangle3 t{m.positions[3], m.positions[4], m.positions[5]};
    const bool expected = !apart(soup[0], soup[1]);
    REQUIRE(garment::geometry::triangles_hit(s, t) == expected);
    REQUIRE(garment::geometry::triangles_hit(t, s) == expected);
    const IntTriangle segment{soup[0][0], soup[0][1], soup[0][1]};
    REQUIRE(garment::geometry::segment_hits_triangle(s[0], s[1], t) == !apart(segment, soup[1]));
    met += expected;
  }
  CHECK(met > 1000);
  CHECK(met < 3900);
}

TEST_CASE("a flat strip is clean, a strip folded onto itself is not", "[certificate]") {
  const Mesh flat = strip(40, [](double x, double y) { return Vector3d(x, y, 0); });
  CHECK(certify(flat.triangles, flat.positions).clean());
  const Mesh apart_by_a_hair = strip(
      41, [](double x, double y) { return x < 0.205 ? Vector3d(x, y, 0) : Vector3d(0.41 - x, y, 1e-12); });
  CHECK(certify(apart_by_a_hair.triangles, apart_by_a_hair.positions).self_intersections == 0);
  const Mesh touching = strip(41, [](double x, double y) {
    return x < 0.205 ? Vector3d(x, y, 0) : Vector3d(0.403 - x, y + 0.003, 0);
  });
  CHECK(certify(touching.triangles, touching.positions).self_intersections > 100);
  const Mesh through = strip(41, [](double x, double y) {
    return x < 0.205 ? Vector3d(x, y, 0) : Vector3d(0.41 - x, y, 0.05 - (x - 0.205) * 0.5);
  });
  const Certificate crossing = certify(through.triangles, through.positions);
  CHECK(crossing.self_intersections > 0);
  CHECK(std::is_sorted(crossing.self_hits.begin(), crossing.self_hits.end(),
                       [](auto p, auto q) { return p.a != q.a ? p.a < q.a : p.b < q.b; }));
}

TEST_CASE("cloth in and about a body: crossings and winding", "[certificate]") {
  const garment::body::TriangleMesh box = cube(0.25);
  const Mesh outside = strip(20, [](double x, double y) { return Vector3d(x, y, 0.2501); });
  CHECK(certify(outside.triangles, outside.positions, {&box}).clean());
  const Mesh on_top = strip(20, [](double x, double y) { return Vector3d(x, y, 0.25); });
  CHECK(certify(on_top.triangles, on_top.positions, {&box}).body_intersections > 0);
  const Mesh within = strip(20, [](double x, double y) { return Vector3d(x, y, 0.1); });
  const Certificate inside = certify(within.triangles, within.positions, {&box});
  CHECK(inside.body_intersections == 0);
  CHECK(inside.inside_body == within.positions.size());
  const Mesh across = strip(40, [](double x, double y) { return Vector3d(x + 0.1, y, 0.1); });
  const Certificate cut = certify(across.triangles, across.positions, {&box, &box});
  CHECK(cut.body_intersections > 0);
  CHECK(cut.inside_body == 2 * 5 * 16);  // x = 0.10 .. 0.25: the last column lies on the face
  CHECK(cut.body_hits.front().body == 0);
  CHECK(cut.body_hits.back().body == 1);
}

TEST_CASE("inside is decided on lattice points: rays through corners and edges count once", "[certificate]") {
  const garment::body::TriangleMesh box = cube(0.25);
  std::vector<Vector3d> grid;
  std::size_t expected = 0;
  for (int i = -4; i <= 4; ++i)
    for (int j = -4; j <= 4; ++j)
      for (int k = -4; k <= 4; ++k) {
        if (std::abs(i) == 2 || std::abs(j) == 2 || std::abs(k) == 2)
          continue;  // not on the planes of the faces
        grid.emplace_back(i * 0.125, j * 0.125, k * 0.125);
        expected += std::abs(i) < 2 && std::abs(j) < 2 && std::abs(k) < 2;
      }
  CHECK(certify({}, grid, {&box}).inside_body == expected);
}

TEST_CASE("positions that are not numbers are never certified", "[certificate]") {
  Mesh m = strip(3, [](double x, double y) { return Vector3d(x, y, 0); });
  m.positions[4][1] = std::numeric_limits<double>::quiet_NaN();
  const Certificate c = certify(m.triangles, m.positions);
  CHECK_FALSE(c.finite);
  CHECK_FALSE(c.clean());
}

TEST_CASE("the certificate does not depend on the number of threads", "[certificate]") {
  std::mt19937 random(3);
  const Mesh m = to_mesh(random_soup(random, 1500, 40, 3), 0.004);
  const garment::body::TriangleMesh box = cube(0.1);
  const int before = garment::thread_count();
  garment::set_thread_count(1);
  const Certificate one = certify(m.triangles, m.positions, {&box});
  garment::set_thread_count(4);
  const Certificate four = certify(m.triangles, m.positions, {&box});
  garment::set_thread_count(before);
  CHECK(one.self_hits == four.self_hits);
  CHECK(one.body_hits == four.body_hits);
  CHECK(one.inside_hits == four.inside_hits);
  CHECK(one.self_intersections > 0);
  CHECK(one.body_intersections > 0);
}
