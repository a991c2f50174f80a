#include "runtime/geometry/triangulate.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <set>

using Eigen::Vector2d;
using garment::geometry::triangulate;
using garment::geometry::Triangulation;

namespace {

using Points = std::vector<Vector2d>;
using Segments = std::vector<std::array<int, 2>>;

double area2(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

double total_area(const Points& p, const Triangulation& t) {
  double sum = 0;
  for (const auto& v : t.triangles) sum += area2(p[v[0]], p[v[1]], p[v[2]]) / 2;
  return sum;
}

Segments loop(int first, int n) {
  Segments s;
  for (int i = 0; i < n; ++i) s.push_back({first + i, first + (i + 1) % n});
  return s;
}

struct Random {  // xorshift, the same everywhere
  std::uint64_t state = 88172645463325252ull;
  double operator()() {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return static_cast<double>(state >> 11) / 9007199254740992.0;
  }
};

/// Every border segment is a side of exactly one triangle; every other side belongs to two; all triangles
/// turn left.
void check_conforming(const Points& p, const Segments& border, const Triangulation& t) {
  REQUIRE(t.ok);
  std::map<std::array<int, 2>, int> sides;
  for (const auto& v : t.triangles) {
    REQUIRE(area2(p[v[0]], p[v[1]], p[v[2]]) > 0);
    for (int k = 0; k < 3; ++k) ++sides[{v[k], v[(k + 1) % 3]}];
  }
  std::set<std::array<int, 2>> wanted(border.begin(), border.end());
  for (const auto& s : border) REQUIRE(sides[s] == 1);
  for (const auto& [s, n] : sides) {
    if (n == 0) continue;
    REQUIRE(n == 1);
    if (!wanted.count(s)) REQUIRE(sides.count({s[1], s[0]}) == 1);
  }
}

}  // namespace

TEST_CASE("a square with a square hole and a point inside") {
  Points p{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {0.5, 2}};
  Segments border = loop(0, 4), hole = loop(4, 4);
  border.insert(border.end(), hole.begin(), hole.end());
  Triangulation t = triangulate(p, border);
  check_conforming(p, border, t);
  CHECK(total_area(p, t) == Approx(12));
  CHECK(t.triangles.size() == 10);
}

TEST_CASE("a comb forces long constraints through many points") {
  Points p;
  for (int i = 0; i <= 20; ++i) p.emplace_back(i * 0.1, i % 2 ? 0.02 : 1.0);
  p.emplace_back(2.0, -0.001);
  p.emplace_back(0.0, -0.001);
  std::reverse(p.begin(), p.end());
  Segments border = loop(0, static_cast<int>(p.size()));
  double polygon = 0;
  for (auto [a, b] : border) polygon += (p[a].x() * p[b].y() - p[a].y() * p[b].x()) / 2;
  REQUIRE(polygon > 0);
  Triangulation t = triangulate(p, border);
  check_conforming(p, border, t);
  CHECK(total_area(p, t) == Approx(polygon).epsilon(1e-6));
}

TEST_CASE("random star polygons with random points inside keep border, area and Delaunay") {
  Random random;
  for (int run = 0; run < 60; ++run) {
    int n = 5 + static_cast<int>(random() * 60);
    Points p;
    for (int i = 0; i < n; ++i) {
      double a = 6.283185307179586 * i / n, r = 0.3 + random();
      p.emplace_back(r * std::cos(a), r * std::sin(a));
    }
    for (int i = 0; i < 200; ++i) p.emplace_back(0.4 * (random() - 0.5), 0.4 * (random() - 0.5));
    Segments border = loop(0, n);
    double polygon = 0;
    for (auto [a, b] : border) polygon += (p[a].x() * p[b].y() - p[a].y() * p[b].x()) / 2;
    Triangulation t = triangulate(p, border);
    check_conforming(p, border, t);
    CHECK(total_area(p, t) == Approx(polygon).epsilon(1e-6));
    std::set<int> used;
    for (const auto& v : t.triangles) used.insert(v.begin(), v.end());
    CHECK(used.size() == p.size());
    // Euler: V - E + F = 1 on a disc
    CHECK(t.triangles.size() == 2 * 200 + static_cast<std::size_t>(n) - 2);
  }
}

TEST_CASE("grids with many cocircular points and points on sides") {
  Points p;
  for (int j = 0; j < 12; ++j)
    for (int i = 0; i < 12; ++i) p.emplace_back(i * 0.1, j * 0.1);
  Segments border;
  for (int k = 0; k < 11; ++k) {
    border.push_back({k, k + 1});
    border.push_back({12 * k + 11, 12 * k + 23});
    border.push_back({143 - k, 142 - k});
    border.push_back({132 - 12 * k, 120 - 12 * k});
  }
  Triangulation t = triangulate(p, border);
  check_conforming(p, border, t);
  CHECK(t.triangles.size() == 242);
  CHECK(total_area(p, t) == Approx(1.21).epsilon(1e-6));
}

TEST_CASE("crossing borders, coinciding points and borders through points are refused and named") {
  Points p{{0, 0}, {1, 1}, {1, 0}, {0, 1}};
  Triangulation t = triangulate(p, loop(0, 4));
  CHECK_FALSE(t.ok);
  CHECK(t.bad[0] >= 0);
  Points q{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}};
  t = triangulate(q, loop(0, 5));
  CHECK_FALSE(t.ok);
  CHECK(t.bad == std::array<int, 2>{0, 4});
  Points r{{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}};
  CHECK_FALSE(triangulate(r, loop(0, 5)).ok);
  CHECK_FALSE(triangulate({{0, 0}, {1, 0}}, {{0, 1}}).ok);
}
