#include "runtime/geometry/curve.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "runtime/base/portable_math.hpp"

using garment::geometry::Arc;
using garment::geometry::Cubic;
using garment::geometry::Curve;
using garment::geometry::Point2;
using garment::geometry::Quadratic;
using garment::geometry::Through;

namespace {

constexpr double kPi = garment::portable::kPi;

/// Length of a fine polygon over the curve's own points: an oracle that does not use the arc-length table.
double chord_sum(const Curve& curve, double tolerance) {
  std::vector<Point2> p = curve.polyline(tolerance);
  double sum = 0;
  for (std::size_t i = 1; i < p.size(); ++i) sum += (p[i] - p[i - 1]).norm();
  return sum;
}

std::vector<Curve> samples() {
  return {
      Curve({0, 0}, {0.3, 0.4}),
      Curve({0.1, 0.2}, {0.5, 0.1}, Quadratic{{0.3, 0.5}}),
      Curve({0, 0}, {0.4, 0.1}, Cubic{{0.1, 0.3}, {0.35, -0.2}}),
      Curve({0, 0}, {0.4, 0.1}, Arc{0.05}),
      Curve({0, 0}, {0.4, 0.1}, Arc{-0.5}),
      Curve({0, 0}, {0.4, 0.1}, Arc{1e-7}),
      Curve({0, 0}, {0.6, 0}, Through{{{0.1, 0.1}, {0.3, -0.05}, {0.5, 0.02}}}),
      Curve({0, 0}, {0.3, 0}, Cubic{{0.3, 0.3}, {0, 0.3}}),  // a loop
      Curve({0, 0}, {0.3, 0}, Cubic{{0, 0}, {0.3, 0}}),      // control points on the ends
  };
}

}  // namespace

TEST_CASE("a straight curve") {
  Curve c({0, 0}, {3, 4});
  CHECK(c.length() == Approx(5).epsilon(1e-15));
  CHECK(c.point_at(2.5) == Point2(1.5, 2));
  CHECK(c.point_at(-1) == c.start());
  CHECK(c.point_at(9) == c.end());
  CHECK((c.tangent_at(1) - Point2(0.6, 0.8)).norm() < 1e-15);
  CHECK(c.polyline(1e-4).size() == 2);
  CHECK(c.nearest({0, 5}) == Approx(4));
  CHECK(c.crossings({1, 0}, 1.5) == std::vector<double>{c.nearest({1.5, 2})});
  CHECK(c.crossings({1, 0}, 3.5).empty());
}

TEST_CASE("arcs bulge to the left of the way walked and are exact") {
  Curve half({0, 0}, {2, 0}, Arc{1});
  CHECK(half.length() == Approx(kPi).epsilon(1e-15));
  CHECK((half.point_at(kPi / 2) - Point2(1, 1)).norm() < 1e-15);
  CHECK((half.tangent_at(0) - Point2(0, 1)).norm() < 1e-15);
  CHECK(half.area_term() == Approx(-kPi / 2).epsilon(1e-14));  // chord adds nothing, the loop is clockwise
  Curve right({0, 0}, {2, 0}, Arc{-1});
  CHECK((right.point_at(kPi / 2) - Point2(1, -1)).norm() < 1e-15);
  // Three quarters of a circle of radius 1: sagitta larger than half the chord.
  double r = std::sqrt(0.5);
  Curve large({-r, -r}, {r, -r}, Arc{1 + r});
  CHECK(large.length() == Approx(1.5 * kPi).epsilon(1e-14));
  CHECK((large.point_at(0.75 * kPi) - Point2(0, 1)).norm() < 1e-14);
  // A nearly straight arc loses no digits: s = c + 8 b^2/(3 c) to second order.
  Curve flat({0, 0}, {1, 0}, Arc{1e-6});
  CHECK(flat.length() - 1 == Approx(8e-12 / 3).epsilon(1e-3));
  CHECK(flat.area_term() == Approx(-2e-6 / 3).epsilon(1e-12));
  CHECK(flat.point_at(0.5 * flat.length()).y() == Approx(1e-6).epsilon(1e-9));
}

TEST_CASE("a circle of two arcs has its exact area and centroid") {
  Point2 centre(0.7, -0.2);
  Point2 a = centre + Point2(0.3, 0), b = centre - Point2(0.3, 0);
  Curve upper(a, b, Arc{-0.3}), lower(b, a, Arc{-0.3});  // counter-clockwise
  double area = upper.area_term() + lower.area_term();
  CHECK(area == Approx(kPi * 0.09).epsilon(1e-14));
  CHECK(((upper.moment_term() + lower.moment_term()) / area - centre).norm() < 1e-14);
  // Unequal arcs of the same circle: a quarter and the rest.
  Point2 c = centre + Point2(0, 0.3);
  double sagitta = 0.3 * (1 - std::sqrt(0.5));
  Curve quarter(a, c, Arc{-sagitta}), rest(c, a, Arc{-(0.6 - sagitta)});
  area = quarter.area_term() + rest.area_term();
  CHECK(area == Approx(kPi * 0.09).epsilon(1e-14));
  CHECK(((quarter.moment_term() + rest.moment_term()) / area - centre).norm() < 1e-14);
}

TEST_CASE("a parabola has its closed-form length, area and centroid") {
  // y = x^2 from (-1, 1) to (1, 1): control point (0, -1).
  Curve parabola({-1, 1}, {1, 1}, Quadratic{{0, -1}});
  double length = std::sqrt(5.0) + std::asinh(2.0) / 2;
  CHECK(parabola.length() == Approx(length).epsilon(1e-14));
  CHECK((parabola.point_at(length / 2)).norm() < 1e-14);
  Curve back({1, 1}, {-1, 1});
  double area = parabola.area_term() + back.area_term();
  CHECK(area == Approx(4.0 / 3).epsilon(1e-14));
  CHECK(((parabola.moment_term() + back.moment_term()) / area - Point2(0, 0.6)).norm() < 1e-14);
}

TEST_CASE("arc length is the parameter on every curve") {
  for (const Curve& c : samples()) {
    INFO("start to end " << (c.end() - c.start()).norm() << ", length " << c.length());
    CHECK(c.length() == Approx(chord_sum(c, 1e-9)).epsilon(1e-6));
    CHECK(c.point_at(0) == c.start());
    CHECK(c.point_at(c.length()) == c.end());
    double walked = 0;
    Point2 before = c.start();
    constexpr int kSteps = 4000;
    for (int i = 1; i <= kSteps; ++i) {
      Point2 p = c.point_at(c.length() * i / kSteps);
      double step = (p - before).norm();
      CHECK(step <= c.length() / kSteps * (1 + 1e-9));
      walked += step;
      before = p;
    }
    CHECK(walked == Approx(c.length()).epsilon(1e-4));
    double h = 1e-6 * c.length(), s = 0.37 * c.length();
    Point2 difference = (c.point_at(s + h) - c.point_at(s - h)) / (2 * h);
    CHECK((difference - c.tangent_at(s)).norm() < 1e-6);
    CHECK(std::fabs(c.tangent_at(0).norm() - 1) < 1e-12);
    CHECK(std::fabs(c.tangent_at(c.length()).norm() - 1) < 1e-12);
  }
}

TEST_CASE("polylines keep their tolerance and their arc lengths") {
  for (const Curve& c : samples())
    for (double tolerance : {1e-2, 1e-3, 1e-5}) {
      std::vector<double> at;
      std::vector<Point2> p = c.polyline(tolerance, &at);
      REQUIRE(p.size() == at.size());
      REQUIRE(p.size() >= 2);
      CHECK(p.front() == c.start());
      CHECK(p.back() == c.end());
      CHECK(at.front() == 0);
      CHECK(at.back() == c.length());
      for (std::size_t i = 1; i < p.size(); ++i) {
        CHECK(at[i] > at[i - 1]);
        CHECK((c.point_at(at[i]) - p[i]).norm() < 1e-12);
        for (int k = 1; k < 8; ++k) {
          Point2 q = c.point_at(at[i - 1] + (at[i] - at[i - 1]) * k / 8);
          Curve chord(p[i - 1], p[i]);
          CHECK((chord.point_at(chord.nearest(q)) - q).norm() <= tolerance * (1 + 1e-6));
        }
      }
    }
}

TEST_CASE("reversing, mirroring, moving and scaling") {
  Eigen::Isometry2d motion = Eigen::Translation2d(0.2, -0.1) * Eigen::Rotation2Dd(0.7);
  for (const Curve& c : samples()) {
    double l = c.length();
    Curve r = c.reversed(), m = c.mirrored_x(0.25), t = c.transformed(motion), k = c.scaled(2.5),
          n = c.scaled(-1);
    CHECK(r.length() == Approx(l).epsilon(1e-13));
    CHECK(r.area_term() == Approx(-c.area_term()).epsilon(1e-12).margin(1e-15));
    CHECK(k.length() == Approx(2.5 * l).epsilon(1e-13));
    CHECK(k.area_term() == Approx(6.25 * c.area_term()).epsilon(1e-12).margin(1e-15));
    for (double f : {0.0, 0.2, 0.61, 1.0}) {
      Point2 p = c.point_at(f * l);
      CHECK((r.point_at((1 - f) * l) - p).norm() < 1e-12);
      CHECK((m.point_at(f * l) - Point2(0.5 - p.x(), p.y())).norm() < 1e-12);
      CHECK((t.point_at(f * l) - motion * p).norm() < 1e-12);
      CHECK((k.point_at(f * k.length()) - 2.5 * p).norm() < 1e-12);
      CHECK((n.point_at(f * l) + p).norm() < 1e-12);
    }
  }
}

TEST_CASE("the nearest point is not beaten by any sample") {
  for (const Curve& c : samples())
    for (int i = 0; i < 40; ++i) {
      Point2 p(0.9 * garment::portable::sin(1.7 * i), 0.6 * garment::portable::cos(2.3 * i));
      double found = (c.point_at(c.nearest(p)) - p).norm();
      for (int k = 0; k <= 500; ++k) CHECK(found <= (c.point_at(c.length() * k / 500) - p).norm() + 1e-12);
    }
}

TEST_CASE("crossings are all found") {
  for (const Curve& c : samples())
    for (int i = 0; i < 24; ++i) {
      double angle = 0.131 + kPi * i / 12;
      Point2 normal(garment::portable::cos(angle), garment::portable::sin(angle));
      double offset = normal.dot(Point2(0.21, 0.043));
      std::vector<double> s = c.crossings(normal, offset);
      CHECK(std::is_sorted(s.begin(), s.end()));
      for (double x : s) CHECK(std::fabs(normal.dot(c.point_at(x)) - offset) < 1e-12);
      int changes = 0;
      constexpr int kSteps = 3000;
      double before = normal.dot(c.start()) - offset;
      for (int k = 1; k <= kSteps; ++k) {
        double h = normal.dot(c.point_at(c.length() * k / kSteps)) - offset;
        if ((h < 0) != (before < 0)) ++changes;
        before = h;
      }
      CHECK(static_cast<int>(s.size()) == changes);
    }
  Curve half({-1, 0}, {1, 0}, Arc{1});
  CHECK(half.crossings({0, 1}, 0.5).size() == 2);
  CHECK(half.crossings({0, 1}, 0).size() == 2);  // its ends lie on the line
  CHECK(half.crossings({0, 1}, 1).size() == 1);  // it touches
  CHECK(half.crossings({1, 0}, 0).size() == 1);
}

TEST_CASE("a spline goes through its points") {
  std::vector<Point2> points{{0.1, 0.1}, {0.1, 0.1}, {0.3, -0.05}, {0.5, 0.02}};
  Curve c({0, 0}, {0.6, 0}, Through{points});
  for (const Point2& p : points) CHECK((c.point_at(c.nearest(p)) - p).norm() < 1e-13);
  Curve straight({0, 0}, {1, 1}, Through{{{0.25, 0.25}, {0.5, 0.5}}});
  CHECK(straight.length() == Approx(std::sqrt(2.0)).epsilon(1e-12));
  CHECK(Curve({0, 0}, {1, 0}, Through{}).length() == Approx(1).epsilon(1e-13));
}

TEST_CASE("degenerate and unsound curves answer without hanging") {
  Curve none;
  CHECK(none.length() == 0);
  CHECK(none.polyline(1e-3).size() == 2);
  CHECK(none.point_at(1) == Point2(0, 0));
  Curve point({1, 2}, {1, 2}, Arc{0.3});
  CHECK(point.length() == 0);
  CHECK(point.point_at(0.5) == Point2(1, 2));
  CHECK(Curve({1, 2}, {1, 2}, Through{{{1, 2}}}).length() == 0);
  double nan = std::numeric_limits<double>::quiet_NaN(), huge = 1e300;
  for (double bad : {nan, huge, -huge, std::numeric_limits<double>::infinity()}) {
    for (Curve::Shape shape :
         {Curve::Shape{Cubic{{bad, 0}, {0, bad}}}, Curve::Shape{Arc{bad}}, Curve::Shape{Quadratic{{0, bad}}},
          Curve::Shape{Through{{{bad, bad}, {1, 1}}}}}) {
      Curve c({0, 0}, {1, 0}, shape);
      CHECK(c.polyline(1e-3).size() < 100000);
      c.point_at(0.3);
      c.nearest({0.1, 0.2});
      c.crossings({1, 0}, 0.2);
    }
  }
}
