// Points in regions: curves, halves, set operations.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/design/region.hpp"

using namespace garment;
using design::EdgePart;
using design::Panel;
using design::Point2;
using design::RegionShape;
using design::RegionTest;
using Kind = RegionShape::Kind;

namespace {

constexpr double kExact = 1e-4;  // m: what is promised

RegionShape shape_of(Kind kind) {
  RegionShape shape;
  shape.kind = kind;
  return shape;
}

RegionShape circle(Point2 centre, double radius) {
  RegionShape shape = shape_of(Kind::circle);
  shape.points = {centre};
  shape.size = radius;
  return shape;
}

/// A half disc of 20 cm: edge 0 is straight along x, edge 1 the arc back over the top.
Panel half_disc() {
  Panel panel;
  panel.name = "disc";
  panel.edges.resize(2);
  panel.edges[0].curve = geometry::Curve(Point2(-0.2, 0), Point2(0.2, 0));
  panel.edges[1].curve = geometry::Curve(Point2(0.2, 0), Point2(-0.2, 0), geometry::Arc{-0.2});
  return panel;
}

RegionShape near(const Panel& panel, int edge, double distance, double from = 0, double to = -1) {
  RegionShape shape = shape_of(Kind::near);
  shape.size = distance;
  const double length = panel.edges[static_cast<std::size_t>(edge)].curve.length();
  shape.parts = {{0, edge, from, to < 0 ? length : to}};
  return shape;
}

}  // namespace

TEST_CASE("a strip along an arc ends where a circle does, to 0.1 mm") {
  const Panel panel = half_disc();
  const RegionTest strip(panel, near(panel, 1, 0.03));
  for (int k = 1; k < 40; ++k) {
    const double a = 3.14159265358979 * k / 40;
    const Point2 way(std::cos(a), std::sin(a));
    CHECK(strip.contains((0.17 + kExact) * way));
    CHECK_FALSE(strip.contains((0.17 - kExact) * way));
    CHECK(strip.contains((0.23 - kExact) * way));
    CHECK_FALSE(strip.contains((0.23 + kExact) * way));
  }
}

TEST_CASE("a part of an edge has round ends") {
  const Panel panel = half_disc();
  const RegionTest strip(panel, near(panel, 0, 0.05, 0.1, 0.2));  // x from -0.1 to 0
  CHECK(strip.contains(Point2(0.05 - kExact, 0)));
  CHECK_FALSE(strip.contains(Point2(0.05 + kExact, 0)));
  CHECK_FALSE(strip.contains(Point2(0.04, 0.04)));
  CHECK(strip.contains(Point2(-0.15 + kExact, 0)));
  CHECK_FALSE(strip.contains(Point2(-0.15 - kExact, 0)));
}

TEST_CASE("the sides of a curve follow the way it is walked, straight on beyond its ends") {
  const Panel panel = half_disc();
  RegionShape left = shape_of(Kind::left_of);
  left.parts = {{0, 1, 0, panel.edges[1].curve.length()}};  // counter-clockwise: inside lies to the left
  const RegionTest inside(panel, left);
  left.kind = Kind::right_of;
  const RegionTest outside(panel, left);
  for (int k = 1; k < 40; ++k) {
    const double a = 3.14159265358979 * k / 40;
    const Point2 way(std::cos(a), std::sin(a));
    CHECK(inside.contains((0.2 - kExact) * way));
    CHECK_FALSE(inside.contains((0.2 + kExact) * way));
    CHECK(outside.contains((0.2 + kExact) * way));
  }
  RegionShape base = shape_of(Kind::left_of);
  base.parts = {{0, 0, 0, 0.4}};
  const RegionTest up(panel, base);
  CHECK(up.contains(Point2(5, 0.01)));
  CHECK_FALSE(up.contains(Point2(5, -0.01)));
  base.parts = {{0, 0, 0.4, 0}};  // walked backwards
  CHECK(RegionTest(panel, base).contains(Point2(5, -0.01)));
}

TEST_CASE("set operations are those of sets") {
  const Panel panel = half_disc();
  const RegionShape a = circle({0, 0}, 0.1), b = circle({0.1, 0}, 0.1);
  auto both = [&](Kind kind) {
    RegionShape shape = shape_of(kind);
    shape.children = {a, b};
    return RegionTest(panel, shape);
  };
  const RegionTest in_a(panel, a), in_b(panel, b), all = both(Kind::all_of), any = both(Kind::any_of),
                                                   minus = both(Kind::minus);
  RegionShape no = shape_of(Kind::opposite);
  no.children = {a};
  const RegionTest not_a(panel, no);
  for (double x = -0.25; x < 0.3; x += 0.013)
    for (double y = -0.2; y < 0.2; y += 0.017) {
      const Point2 p(x, y);
      CHECK(all.contains(p) == (in_a.contains(p) && in_b.contains(p)));
      CHECK(any.contains(p) == (in_a.contains(p) || in_b.contains(p)));
      CHECK(minus.contains(p) == (in_a.contains(p) && !in_b.contains(p)));
      CHECK(not_a.contains(p) == !in_a.contains(p));
    }
}

TEST_CASE("a polygon may be walked either way and need not be convex") {
  const Panel panel = half_disc();
  RegionShape shape = shape_of(Kind::polygon);
  shape.points = {{0, 0}, {0.2, 0}, {0.2, 0.2}, {0.1, 0.05}, {0, 0.2}};
  const RegionTest forward(panel, shape);
  std::reverse(shape.points.begin(), shape.points.end());
  const RegionTest backward(panel, shape);
  for (double x = -0.05; x < 0.25; x += 0.0117)
    for (double y = -0.05; y < 0.25; y += 0.0113)
      CHECK(forward.contains(Point2(x, y)) == backward.contains(Point2(x, y)));
  CHECK(forward.contains(Point2(0.02, 0.12)));
  CHECK_FALSE(forward.contains(Point2(0.1, 0.12)));  // in the notch
}

TEST_CASE("what was drawn on a half holds for its mirror image") {
  Panel panel = half_disc();
  panel.fold_x = 0.05;
  for (int side : {1, -1}) {
    RegionShape shape = circle({0.05 + side * 0.08, 0.1}, 0.03);
    shape.drawn_side = side;
    const RegionTest test(panel, shape);
    for (double x = -0.1; x < 0.2; x += 0.0111)
      for (double y = 0; y < 0.2; y += 0.0111)
        CHECK(test.contains(Point2(x, y)) == test.contains(Point2(0.1 - x, y)));
    CHECK(test.contains(Point2(0.13, 0.1)));
    CHECK(test.contains(Point2(-0.03, 0.1)));
    CHECK_FALSE(test.contains(Point2(0.05, 0.1)));
  }
  RegionShape one = circle({0.13, 0.1}, 0.03);  // named by its half: no image
  CHECK_FALSE(RegionTest(panel, one).contains(Point2(-0.03, 0.1)));
}

TEST_CASE("factors of overlapping regions multiply") {
  design::RegionFactors a, b;
  a.bend_warp = 2;
  a.mass = 1.5;
  b.bend_warp = 3;
  b.friction = 0.5;
  const design::RegionFactors c = a * b;
  CHECK(c.bend_warp == 6);
  CHECK(c.mass == 1.5);
  CHECK(c.friction == 0.5);
  CHECK(c.bend_weft == 1);
}
