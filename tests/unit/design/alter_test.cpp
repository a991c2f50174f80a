// Slash and spread, moved edges, scaling: against what paper and scissors give.
#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/design/alter.hpp"
#include "runtime/geometry/curve_map.hpp"

using namespace garment;
using namespace garment::design;

namespace {

/// 20 cm by 30 cm, drawn counter-clockwise from (0, 0): bottom, right, top, left.
Panel sheet() {
  Panel p;
  p.name = "sheet";
  const Point2 corners[] = {{0, 0}, {0.2, 0}, {0.2, 0.3}, {0, 0.3}};
  const char* names[] = {"bottom", "right_side", "top", "left_side"};
  for (int k = 0; k < 4; ++k) {
    Edge edge;
    edge.name = names[k];
    edge.curve = geometry::Curve(corners[k], corners[(k + 1) % 4]);
    p.edges.push_back(edge);
  }
  return p;
}

void add_line(Panel& p, const std::string& name, const Point2& a, const Point2& b) {
  Edge edge;
  edge.name = name;
  edge.curve = geometry::Curve(a, b);
  p.lines.push_back(edge);
}

double area(const Panel& p) {
  double sum = 0;
  for (const Edge& e : p.edges) sum += e.curve.area_term();
  return sum;
}

void check_closed(const Panel& p) {
  for (std::size_t k = 0; k < p.edges.size(); ++k)
    CHECK((p.edges[k].curve.end() - p.edges[(k + 1) % p.edges.size()].curve.start()).norm() < 1e-12);
}

}  // namespace

TEST_CASE("a parallel spread adds a strip") {
  for (const bool backwards : {false, true}) {
    Panel p = sheet();
    add_line(p, "cut", backwards ? Point2(0.2, 0.1) : Point2(0, 0.1), backwards ? Point2(0, 0.1) : Point2(0.2, 0.1));
    p.points.push_back({"above", {}, {0.1, 0.2}});
    p.points.push_back({"below", {}, {0.1, 0.05}});
    p.notches.push_back({"n", {}, "right_side", 0.25});
    p.notches.push_back({"m", {}, "left_side", 0.25});
    REQUIRE(slash(p, "cut", 0.03, 0.03, "").empty());
    check_closed(p);
    CHECK(area(p) == Approx(0.2 * 0.33));
    CHECK(p.edges[1].curve.length() == Approx(0.33));
    CHECK(std::holds_alternative<geometry::Line>(p.edges[1].curve.shape()));
    CHECK(p.points[0].point.y() == Approx(0.23));
    CHECK(p.points[1].point.y() == Approx(0.05));
    CHECK(p.notches[0].at == Approx(0.28));  // above the cut it goes with the cloth
    CHECK(p.notches[1].at == Approx(0.28));  // 5 cm from the lower corner still
    CHECK(p.lines[0].curve.start().y() == Approx(0.1));
  }
}

TEST_CASE("a hinge opens one end and keeps all other lengths") {
  for (const bool at_end : {false, true}) {
    Panel p = sheet();
    add_line(p, "cut", {0.1, 0.3}, {0.1, 0});
    REQUIRE(slash(p, "cut", at_end ? 0 : 0.04, at_end ? 0.04 : 0, "").empty());
    check_closed(p);
    CHECK(p.edges[at_end ? 0 : 2].curve.length() == Approx(0.24));
    CHECK(p.edges[at_end ? 2 : 0].curve.length() == Approx(0.2));
    CHECK(p.edges[1].curve.length() == Approx(0.3));
    CHECK(p.edges[3].curve.length() == Approx(0.3));
    // The wedge is the triangle with two sides of 30 cm and one of 4 cm.
    CHECK(area(p) == Approx(0.06 + 0.5 * 0.04 * std::sqrt(0.09 - 0.0004)));
  }
}

TEST_CASE("both ends open by what is stated") {
  Panel p = sheet();
  add_line(p, "cut", {0.1, 0.3}, {0.1, 0});
  REQUIRE(slash(p, "cut", 0.05, 0.02, "").empty());
  check_closed(p);
  CHECK(p.edges[2].curve.length() == Approx(0.25));
  CHECK(p.edges[0].curve.length() == Approx(0.22));
}

TEST_CASE("the part with the fixed edge stays") {
  Panel p = sheet();
  add_line(p, "cut", {0.1, 0}, {0.1, 0.3});
  Panel q = p;
  REQUIRE(slash(p, "cut", 0.02, 0.02, "left_side").empty());
  CHECK(p.edges[3].curve.start().x() == Approx(0));
  CHECK(p.edges[1].curve.start().x() == Approx(0.22));
  REQUIRE(slash(q, "cut", 0.02, 0.02, "right_side").empty());
  CHECK(q.edges[1].curve.start().x() == Approx(0.2));
  CHECK(q.edges[3].curve.start().x() == Approx(-0.02));
  check_closed(q);
}

TEST_CASE("a slash from corner to corner leaves a gap on one edge of each corner") {
  Panel p = sheet();
  add_line(p, "cut", {0, 0}, {0.2, 0.3});
  REQUIRE(slash(p, "cut", 0.01, 0.01, "").empty());
  check_closed(p);
  CHECK(area(p) == Approx(0.06 + 0.01 * std::hypot(0.2, 0.3)));
}

TEST_CASE("a slash needs a line from edge to edge and nothing across it") {
  Panel p = sheet();
  add_line(p, "cut", {0.05, 0.1}, {0.15, 0.1});
  REQUIRE(slash(p, "cut", 0.01, 0.01, "").size() == 1);
  CHECK(slash(p, "cut", 0.01, 0.01, "")[0].code == "G0434");
  Panel q = sheet();
  add_line(q, "cut", {0, 0.1}, {0.2, 0.1});
  add_line(q, "other", {0.1, 0.05}, {0.1, 0.2});
  REQUIRE_FALSE(slash(q, "cut", 0.01, 0.01, "").empty());
  CHECK(slash(q, "cut", 0.01, 0.01, "")[0].code == "G0435");
}

TEST_CASE("a moved edge draws its neighbours and the lines on them along") {
  Panel p = sheet();
  add_line(p, "yoke", {0, 0.2}, {0.2, 0.2});
  p.notches.push_back({"n", {}, "right_side", 0.15});
  REQUIRE(move(p, {"top"}, {0.02, 0.06}));
  check_closed(p);
  CHECK(p.edges[2].curve.length() == Approx(0.2));
  CHECK(p.edges[2].curve.start().x() == Approx(0.22));
  CHECK((p.lines[0].curve.end() - p.edges[1].curve.point_at(2.0 / 3 * p.edges[1].curve.length())).norm() < 1e-12);
  CHECK(p.notches[0].at == Approx(p.edges[1].curve.length() / 2));
  CHECK_FALSE(move(p, {"nothing"}, {0.1, 0}));
}

TEST_CASE("scaling scales area by the product of the factors, arcs too") {
  Panel p = sheet();
  p.edges[1].curve = geometry::Curve({0.2, 0}, {0.2, 0.3}, geometry::Arc{-0.05});
  p.darts.push_back({"d", {}, "top", 0.1, 0.02, 0.1, {}});
  const double before = area(p);
  scale(p, 2, 1.5);
  check_closed(p);
  CHECK(area(p) == Approx(3 * before).epsilon(1e-5));
  CHECK(p.darts[0].at == Approx(0.2));
  CHECK(p.darts[0].width == Approx(0.04));
  CHECK(p.darts[0].depth == Approx(0.15));
}

TEST_CASE("warped curves go from and to where they should, and keep what lies between in proportion") {
  const geometry::Curve c({0, 0}, {0.3, 0}, geometry::Through{{{0.1, 0.02}, {0.2, -0.01}}});
  const geometry::Curve w = geometry::warped(c, {0, 0}, {0.03, 0.3});
  CHECK((w.end() - Point2(0.33, 0.3)).norm() < 1e-15);
  const auto& points = std::get<geometry::Through>(w.shape()).points;
  CHECK((points[0] - Point2(0.11, 0.12)).norm() < 1e-12);
}
