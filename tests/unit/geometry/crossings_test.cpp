#include "runtime/geometry/crossings.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "runtime/geometry/offset.hpp"

using namespace garment::geometry;

namespace {

Curve random_curve(std::mt19937& random) {
  auto number = [&random] { return static_cast<double>(random() % 10001) / 10000.0 * 0.6; };
  auto point = [&] { return Point2(number(), number()); };
  const Point2 a = point(), b = point();
  switch (random() % 5) {
    case 0:
      return Curve(a, b);
    case 1:
      return Curve(a, b, Quadratic{point()});
    case 2:
      return Curve(a, b, Cubic{point(), point()});
    case 3:
      return Curve(a, b, Arc{number() - 0.3});
    default:
      return Curve(a, b, Through{{point(), point(), point()}});
  }
}

/// Crossings of two polylines, counted by signs: an oracle that shares no code with the search.
std::size_t count_by_signs(const Curve& a, const Curve& b) {
  const std::vector<Point2> p = a.polyline(1e-6), q = b.polyline(1e-6);
  auto side = [](const Point2& u, const Point2& v, const Point2& w) {
    return (v - u).x() * (w - u).y() - (v - u).y() * (w - u).x() > 0;
  };
  std::size_t count = 0;
  for (std::size_t i = 1; i < p.size(); ++i)
    for (std::size_t j = 1; j < q.size(); ++j)
      if (side(p[i - 1], p[i], q[j - 1]) != side(p[i - 1], p[i], q[j]) &&
          side(q[j - 1], q[j], p[i - 1]) != side(q[j - 1], q[j], p[i]))
        ++count;
  return count;
}

}  // namespace

TEST_CASE("two lines cross where they should") {
  const Crossings c = crossings_of(Curve({0, 0}, {4, 4}), Curve({0, 2}, {4, 2}));
  REQUIRE(c.found.size() == 1);
  CHECK((c.found[0].point - Point2(2, 2)).norm() < 1e-12);
  CHECK(c.found[0].on_a == Approx(std::sqrt(8.0)));
  CHECK(c.found[0].on_b == Approx(2));
  CHECK_FALSE(c.found[0].touching);
  CHECK(crossings_of(Curve({0, 0}, {1, 1}), Curve({0, 2}, {4, 2})).found.empty());
  CHECK(crossings_of(Curve({0, 0}, {1, 0}), Curve({0, 0.01}, {1, 0.01})).found.empty());
}

TEST_CASE("a circle is met twice, once or never") {
  const Curve circle = chain({Curve({1, 0}, {-1, 0}, Arc{-1}), Curve({-1, 0}, {1, 0}, Arc{-1})});
  const Crossings two = crossings_of(circle, Curve({-2, 0.5}, {2, 0.5}));
  REQUIRE(two.found.size() == 2);
  CHECK((two.found[0].point - Point2(std::sqrt(0.75), 0.5)).norm() < 1e-9);  // first along the circle
  CHECK((two.found[1].point - Point2(-std::sqrt(0.75), 0.5)).norm() < 1e-9);
  const Crossings touch = crossings_of(circle, Curve({-2, 1}, {2, 1}));
  REQUIRE(touch.found.size() == 1);
  CHECK(touch.found[0].touching);
  CHECK((touch.found[0].point - Point2(0, 1)).norm() < 2e-4);
  CHECK(crossings_of(circle, Curve({-2, 1.0001}, {2, 1.0001})).found.empty());
  // Where the ring closes, its two ends are one point.
  CHECK(crossings_of(circle, Curve({0.5, 0}, {2, 0})).found.size() == 1);
  // Two circles of radius 1 whose centres are 1.2 apart meet at x = 0.6.
  const Crossings pair = crossings_of(circle, circle.transformed(Eigen::Isometry2d(Eigen::Translation2d(1.2, 0))));
  REQUIRE(pair.found.size() == 2);
  for (const Crossing& at : pair.found) CHECK(at.point.x() == Approx(0.6).margin(1e-9));
  CHECK(pair.found[0].point.y() == Approx(0.8).margin(1e-9));
}

TEST_CASE("ends that meet are found, and curves that run together are told") {
  const Crossings ends = crossings_of(Curve({0, 0}, {1, 0}), Curve({1, 0}, {1, 1}));
  REQUIRE(ends.found.size() == 1);
  CHECK(ends.found[0].touching);
  CHECK(crossings_of(Curve({0, 0}, {1, 0}), Curve({0.5, 0}, {2, 0})).overlap);
  const Curve arc({0, 0}, {1, 0}, Arc{0.2});
  CHECK(crossings_of(arc, arc).overlap);
  CHECK(crossings_of(arc, arc.reversed()).overlap);
  CHECK_FALSE(crossings_of(arc, Curve({0, 0}, {1, 0})).overlap);
}

TEST_CASE("crossings lie on both curves, are complete, and do not depend on the order") {
  std::mt19937 random(7);
  std::size_t met = 0;
  for (int round = 0; round < 150; ++round) {
    const Curve a = random_curve(random), b = random_curve(random);
    if (!(a.length() > 1e-3 && b.length() > 1e-3)) continue;
    const Crossings ab = crossings_of(a, b), ba = crossings_of(b, a);
    CAPTURE(round);
    CHECK(ab.found.size() == ba.found.size());
    for (std::size_t k = 0; k < ab.found.size(); ++k) {
      const Crossing& at = ab.found[k];
      CHECK((a.point_at(at.on_a) - at.point).norm() < 1e-7);
      CHECK((b.point_at(at.on_b) - at.point).norm() < 1e-7);
      if (k > 0) CHECK(ab.found[k - 1].on_a <= at.on_a);
      double near = 1;
      for (const Crossing& other : ba.found) near = std::min(near, (other.point - at.point).norm());
      CHECK(near < 1e-6);
    }
    CHECK(ab.found.size() == count_by_signs(a, b));
    met += ab.found.size();
  }
  CHECK(met > 100);
}

TEST_CASE("the nearest approach of two curves apart") {
  const Approach near = nearest_approach(Curve({0, 0}, {1, 0}), Curve({0, 1}, {1, 0.25}));
  CHECK(near.distance == Approx(0.25).margin(1e-5));
  CHECK(near.on_a == Approx(1).margin(1e-5));
}

TEST_CASE("parts of curves lie on them and add up") {
  std::mt19937 random(3);
  for (int round = 0; round < 60; ++round) {
    const Curve whole = random_curve(random);
    if (!(whole.length() > 1e-3)) continue;
    const double cut = whole.length() * 0.37;
    const Curve a = whole.part(0, cut), b = whole.part(cut, whole.length());
    CAPTURE(round);
    CHECK(a.length() + b.length() == Approx(whole.length()).epsilon(1e-9));
    CHECK((a.end() - b.start()).norm() < 1e-12);
    CHECK((a.point_at(0.6 * a.length()) - whole.point_at(0.6 * a.length())).norm() < 1e-9);
    CHECK((b.point_at(0.2 * b.length()) - whole.point_at(cut + 0.2 * b.length())).norm() < 1e-9);
    const Curve back = whole.part(whole.length(), cut);
    CHECK((back.start() - whole.end()).norm() < 1e-12);
    CHECK((back.point_at(0.3 * back.length()) - b.point_at(0.7 * b.length())).norm() < 1e-9);
    const Curve joined = chain({a, b});
    CHECK(joined.length() == Approx(whole.length()).epsilon(1e-9));
    CHECK(joined.area_term() == Approx(whole.area_term()).margin(1e-9));
    CHECK((joined.reversed().point_at(0.1) - joined.point_at(joined.length() - 0.1)).norm() < 1e-9);
  }
}

TEST_CASE("an offset keeps its distance") {
  const Curve arc({0, 0}, {2, 0}, Arc{1});  // radius 1 about (1, 0), the left side is outward
  const OffsetResult wider = offset_curve(arc, 0.5), smaller = offset_curve(arc, -0.5);
  REQUIRE(wider.curve);
  REQUIRE(smaller.curve);
  CHECK(wider.curve->length() == Approx(1.5 * 3.14159265358979).epsilon(1e-9));
  CHECK(smaller.curve->length() == Approx(0.5 * 3.14159265358979).epsilon(1e-9));
  CHECK(offset_curve(arc, -1.2).tight);
  const Curve cubic({0, 0}, {0.4, 0.1}, Cubic{{0.1, 0.2}, {0.3, 0.2}});
  for (double d : {0.01, -0.01, -0.03, 0.05}) {
    const OffsetResult beside = offset_curve(cubic, d);
    REQUIRE(beside.curve);
    for (int k = 0; k <= 40; ++k) {
      const Point2 p = beside.curve->point_at(beside.curve->length() * k / 40);
      CHECK((cubic.point_at(cubic.nearest(p)) - p).norm() == Approx(std::fabs(d)).margin(3e-6));
    }
  }
  // Corners: outside they are filled, inside they are cut.
  const Curve corner = chain({Curve({0, 0}, {1, 0}), Curve({1, 0}, {1, 1})});
  const OffsetResult inside = offset_curve(corner, 0.1), outside = offset_curve(corner, -0.1);
  REQUIRE(inside.curve);
  CHECK(inside.curve->length() == Approx(1.8));
  REQUIRE(outside.curve);
  CHECK(outside.curve->length() == Approx(2.2));
}
