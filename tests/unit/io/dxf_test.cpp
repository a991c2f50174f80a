// AAMA and ASTM DXF in several dialects, in and out.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <sstream>

#include "runtime/io/dxf_curves.hpp"
#include "runtime/io/dxf_import.hpp"
#include "runtime/io/dxf_writer.hpp"
#include "runtime/io/pattern_panel.hpp"
#include "tests/unit/io/pattern_support.hpp"

using namespace garment;
using design::Point2;
using pattern_test::area;

namespace {

/// Writes pairs of a dialect.
struct Draft {
  std::string text;
  std::string end = "\n";
  double scale = 1;  // units per mm
  Draft& pair(int code, const std::string& value) {
    text += std::to_string(code) + end + value + end;
    return *this;
  }
  Draft& number(int code, double value) {
    std::ostringstream s;
    s.precision(12);
    s << value;
    return pair(code, s.str());
  }
  Draft& at(int code, Point2 p) { return number(code, p.x() * scale).number(code + 10, p.y() * scale); }
  Draft& entity(const char* type, const std::string& layer) { return pair(0, type).pair(8, layer); }
  Draft& words(const std::string& layer, const std::string& value) {
    return entity("TEXT", layer).at(10, {0, 0}).number(40, 5).pair(1, value);
  }
  Draft& polyline(const std::string& layer, const std::vector<Point2>& points, bool closed) {
    entity("POLYLINE", layer).pair(66, "1").pair(70, closed ? "1" : "0");
    for (const Point2& p : points) entity("VERTEX", layer).at(10, p);
    return entity("SEQEND", layer);
  }
  Draft& light(const std::string& layer, const std::vector<Point2>& points, bool closed) {
    entity("LWPOLYLINE", layer).pair(90, std::to_string(points.size())).pair(70, closed ? "1" : "0");
    for (const Point2& p : points) at(10, p);
    return *this;
  }
  Draft& lines(const std::string& layer, const std::vector<Point2>& points, bool shuffled) {
    const std::size_t n = points.size();
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = shuffled ? (k * 7 + 3) % n : k;
      const bool back = shuffled && k % 2 == 1;
      const Point2 &a = points[i], &b = points[(i + 1) % n];
      entity("LINE", layer).at(10, back ? b : a).at(11, back ? a : b);
    }
    return *this;
  }
  Draft& point(const std::string& layer, Point2 p) { return entity("POINT", layer).at(10, p); }
  Draft& block(const std::string& name) {
    return pair(0, "BLOCK").pair(8, "1").pair(2, name).pair(70, "0").at(10, {0, 0});
  }
  Draft& end_block() { return pair(0, "ENDBLK"); }
  Draft& section(const char* name) { return pair(0, "SECTION").pair(2, name); }
  Draft& end_section() { return pair(0, "ENDSEC"); }
  std::string finish() { return pair(0, "EOF").text; }
};

/// A front: straight hem, side, waist and middle, and a curved side; mm. 11 points, no two runs alike.
std::vector<Point2> front() {
  std::vector<Point2> p{{0, 0}, {300, 0}};
  for (int i = 1; i < 8; ++i) p.emplace_back(300 + 25 * std::sin(i * 0.3927), 75.0 * i);
  p.emplace_back(300, 600);
  p.emplace_back(0, 580);
  return p;
}
const std::vector<Point2> kTurns{{0, 0}, {300, 0}, {300, 600}, {0, 580}};

double polygon(const std::vector<Point2>& p) {  // m^2
  double a = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Point2 &u = p[i], &v = p[(i + 1) % p.size()];
    a += (u.x() * v.y() - u.y() * v.x()) / 2;
  }
  return std::fabs(a) * 1e-6;
}

void marks(Draft& d) {
  for (const Point2& p : kTurns) d.point("2", p);
  for (const Point2& p : front())
    if (std::find(kTurns.begin(), kTurns.end(), p) == kTurns.end()) d.point("3", p);
}

std::string style(const std::function<void(Draft&)>& body, const std::string& facts = "Units: METRIC",
                  Draft d = {}) {
  d.section("BLOCKS");
  body(d);
  d.end_section().section("ENTITIES");
  d.words("1", "Style Name: TEST").words("1", facts).words("1", "Sample Size: M");
  return d.end_section().finish();
}

io::DxfResult dxf_of(const std::string& text, const std::string& size = {}) {
  io::DxfOptions options;
  options.fabric.name = "cloth";
  options.size = size;
  return io::read_dxf(text, options);
}

const design::Garment& garment_of(const io::DxfResult& result) {
  INFO(pattern_test::all_messages(result.findings));
  REQUIRE(result.garment);
  return *result.garment;
}

}  // namespace

TEST_CASE("an ASTM file and its AAMA twin give the same pieces") {
  const std::string astm = style([](Draft& d) {
    d.block("FRONT-M")
        .words("1", "Piece Name: FRONT")
        .words("1", "Size: M")
        .words("1", "Quantity: 2")
        .polyline("1", front(), true);
    marks(d);
    d.point("4", {150, 0})
        .entity("LINE", "7")
        .at(10, {100, 100})
        .at(11, {100, 300})
        .polyline("8", {{50, 100}, {50, 400}}, false);
    d.point("13", {150, 300}).polyline("84", front(), true).end_block();
  });
  Draft crlf;
  crlf.end = "\r\n";
  const std::string aama = style(
      [](Draft& d) {
        std::vector<Point2> twice = front();
        twice.push_back(twice.front());
        d.block("FRONT_M")
            .words("1", "PIECE NAME: FRONT")
            .words("1", "SIZE: m")
            .words("1", "QUANTITY: 2")
            .polyline("1", twice, false);
        marks(d);
        d.entity("LINE", "4")
            .at(10, {150, 0})
            .at(11, {150, 5})
            .polyline("7", {{100, 100}, {100, 300}}, false);
        d.entity("LINE", "8")
            .at(10, {50, 100})
            .at(11, {50, 400})
            .entity("CIRCLE", "13")
            .at(10, {150, 300})
            .number(40, 2)
            .end_block();
      },
      "UNITS: metric", crlf);
  for (const std::string& text : {astm, aama}) {
    const io::DxfResult result = dxf_of(text);
    const design::Garment& garment = garment_of(result);
    REQUIRE(garment.panels.size() == 1);
    const design::Panel& panel = garment.panels[0];
    CHECK(panel.name == "FRONT");
    CHECK(area(panel) == Approx(polygon(front())).epsilon(2e-3));
    REQUIRE(panel.edges.size() == 4);
    CHECK(std::holds_alternative<geometry::Line>(panel.edges[0].curve.shape()));
    CHECK(std::holds_alternative<geometry::Through>(panel.edges[1].curve.shape()));
    REQUIRE(panel.notches.size() == 1);
    CHECK(panel.notches[0].edge == "edge_1");
    CHECK(panel.notches[0].at == Approx(0.15));
    CHECK(panel.grain_angle == 0);
    REQUIRE(panel.lines.size() == 1);
    CHECK(panel.lines[0].curve.length() == Approx(0.3));
    REQUIRE(panel.points.size() == 1);
    CHECK(panel.points[0].point.isApprox(Point2(0.15, 0.3), 1e-6));
    CHECK(result.findings.empty());
  }
}

TEST_CASE("a boundary may come in many ways") {
  const double whole = polygon(front());
  const std::vector<std::function<void(Draft&)>> ways{
      [](Draft& d) { d.lines("1", front(), true); },
      [](Draft& d) { d.light("1", front(), true); },
      [](Draft& d) { d.light("L1", front(), true); },
      [](Draft& d) { d.polyline("CUT", front(), true); },
      [](Draft& d) {
        auto p = front();
        std::reverse(p.begin(), p.end());
        d.polyline("1", p, true);
      },
      [](Draft& d) { d.polyline("14", front(), true); },
      [](Draft& d) {
        auto p = front();
        d.polyline("1", {p.begin(), p.begin() + 5}, false)
            .polyline("1", {p.begin() + 4, p.end()}, false)
            .lines("1", {p.back(), p.front()}, false);
      },
  };
  for (std::size_t i = 0; i < ways.size(); ++i) {
    INFO("way " << i);
    const io::DxfResult result = dxf_of(style([&](Draft& d) {
      d.block("A").words("1", "Piece Name: A");
      ways[i](d);
      d.end_block();
    }));
    CHECK(area(garment_of(result).panels.at(0)) == Approx(whole).epsilon(2e-3));
  }
  Draft loose;  // no blocks at all
  loose.section("ENTITIES")
      .polyline("1", front(), true)
      .words("1", "Piece Name: LOOSE")
      .words("1", "Units: METRIC")
      .end_section();
  const io::DxfResult result = dxf_of(loose.finish());
  CHECK(area(garment_of(result).panels.at(0)) == Approx(whole).epsilon(2e-3));
  CHECK(result.garment->panels[0].name == "LOOSE");
}

TEST_CASE("a half is opened about its mirror line") {
  const std::vector<Point2> half{{0, 0}, {200, 0}, {220, 300}, {150, 500}, {0, 480}};
  const std::string text = style([&](Draft& d) {
    d.block("BACK")
        .words("1", "Piece Name: BACK")
        .polyline("1", half, true)
        .entity("LINE", "6")
        .at(10, {0, 0})
        .at(11, {0, 480});
    for (const Point2& p : half) d.point("2", p);
    d.point("4", {100, 0}).point("13", {100, 200}).end_block();
  });
  const io::DxfResult result = dxf_of(text);
  const design::Panel& panel = garment_of(result).panels.at(0);
  CHECK(area(panel) == Approx(2 * polygon(half)));
  CHECK(panel.notches.size() == 2);
  CHECK(panel.points.size() == 2);
  CHECK(panel.edges.size() == 7);  // the hem is one edge; at the neck there is a corner of 16 degrees
  // Open along the fold, it is the same.
  const std::string open = style([&](Draft& d) {
    d.block("BACK")
        .polyline("1", half, false)
        .entity("LINE", "6")
        .at(10, {0, -5})
        .at(11, {0, 500})
        .end_block();
  });
  CHECK(area(garment_of(dxf_of(open)).panels.at(0)) == Approx(2 * polygon(half)));
}

TEST_CASE("cut and stitch lines make allowances") {
  const std::vector<Point2> inner{{10, 10}, {290, 10}, {290, 390}, {10, 390}},
      outer{{0, 0}, {300, 0}, {300, 400}, {0, 400}};
  for (bool swapped : {false, true}) {
    const io::DxfResult result = dxf_of(style([&](Draft& d) {
      d.block("A")
          .polyline(swapped ? "14" : "1", outer, true)
          .polyline(swapped ? "1" : "14", inner, true)
          .point("4", {150, 0})
          .end_block();
    }));
    const design::Panel& panel = garment_of(result).panels.at(0);
    CHECK(area(panel) == Approx(polygon(inner)));
    for (const design::Edge& edge : panel.edges) CHECK(edge.allowance == Approx(0.01));
    CHECK(panel.notches.size() == 1);
  }
}

TEST_CASE("sizes: the sample size, a chosen one, those in block names") {
  for (bool texts : {true, false}) {
    const std::string text = style([&](Draft& d) {
      for (const char* name : {"FRONT", "BACK"})
        for (int k = 0; k < 3; ++k) {
          const char* size = k == 0 ? "S" : k == 1 ? "M" : "L";
          const double w = 200 + 20 * k;
          d.block(std::string(name) + "-" + size);
          if (texts)
            d.words("1", std::string("Piece Name: ") + name).words("1", std::string("Size: ") + size);
          d.polyline("1", {{0, 0}, {w, 0}, {w, 400}, {0, 400}}, true).end_block();
        }
    });
    io::DxfResult result = dxf_of(text);
    CHECK(result.sizes == std::vector<std::string>{"S", "M", "L"});
    REQUIRE(garment_of(result).panels.size() == 2);
    CHECK(result.garment->panels[1].name == "BACK");
    CHECK(area(result.garment->panels[0]) == Approx(0.22 * 0.4));
    CHECK(area(garment_of(dxf_of(text, "l")).panels.at(0)) == Approx(0.24 * 0.4));
    result = dxf_of(text, "XXL");
    CHECK(!result.garment);
    CHECK(pattern_test::all_messages(result.findings).find("`S`, `M`, `L`") != std::string::npos);
    CHECK(pattern_test::has_code(result.findings, "G0967"));
  }
}

TEST_CASE("units: stated, and what cannot be") {
  auto square = [](double side) {
    return [side](Draft& d) {
      d.block("A").polyline("1", {{0, 0}, {side, 0}, {side, side}, {0, side}}, true).end_block();
    };
  };
  struct Case {
    const char* facts;
    double side, metres;
    bool warns;
  };
  for (const Case& c : {Case{"Units: METRIC", 400, 0.4, false}, Case{"Units: ENGLISH", 10, 0.254, false},
                        Case{"units: METRIC", 31, 0.31, true}, Case{"Nothing: x", 400, 0.4, true},
                        Case{"Units: ENGLISH", 500, 0.5, true}, Case{"Units: METRIC", 9000, 0.9, true}}) {
    INFO(c.facts << " " << c.side);
    const io::DxfResult result = dxf_of(style(square(c.side), c.facts));
    CHECK(area(garment_of(result).panels.at(0)) == Approx(c.metres * c.metres));
    CHECK(pattern_test::has_code(result.findings, "G0966") == c.warns);
  }
}

TEST_CASE("arcs, circles and blocks in blocks") {
  const io::DxfResult result = dxf_of(style([](Draft& d) {
    d.block("PART").entity("LINE", "1").at(10, {0, 0}).at(11, {200, 0}).end_block();
    d.block("D").pair(0, "INSERT").pair(8, "1").pair(2, "PART").at(10, {0, 0});
    d.entity("ARC", "1").at(10, {100, 0}).number(40, 100 * d.scale).number(50, 0).number(51, 180);
    d.entity("CIRCLE", "11").at(10, {100, 40}).number(40, 10).end_block();
  }));
  const design::Panel& panel = garment_of(result).panels.at(0);
  CHECK(area(panel) == Approx(3.14159265 * 0.01 / 2).epsilon(1e-4));
  CHECK(panel.holes.size() == 1);
  const std::string loop = style([](Draft& d) {
    d.block("A")
        .polyline("1", front(), true)
        .pair(0, "INSERT")
        .pair(8, "1")
        .pair(2, "B")
        .at(10, {0, 0})
        .end_block();
    d.block("B").pair(0, "INSERT").pair(8, "1").pair(2, "B").at(10, {0, 0}).end_block();
  });
  const io::DxfResult deep = dxf_of(loop);
  CHECK(garment_of(deep).panels.size() == 1);
  CHECK(pattern_test::has_code(deep.findings, "G0964"));
}

namespace {

/// Basis function of Cox and de Boor by its own recursion.
double basis(const std::vector<double>& t, std::size_t i, int p, double u) {
  if (p == 0) return t[i] <= u && u < t[i + 1] ? 1 : 0;
  const auto k = static_cast<std::size_t>(p);
  const double left = t[i + k] - t[i], right = t[i + k + 1] - t[i + 1];
  return (left > 0 ? (u - t[i]) / left * basis(t, i, p - 1, u) : 0) +
         (right > 0 ? (t[i + k + 1] - u) / right * basis(t, i + 1, p - 1, u) : 0);
}

Point2 spline_point(const io::DxfSpline& s, double u) {
  Point2 sum(0, 0);
  double weight = 0;
  for (std::size_t i = 0; i < s.control.size(); ++i) {
    const double b = basis(s.knots, i, s.degree, u) * (s.weights.empty() ? 1 : s.weights[i]);
    sum += b * s.control[i];
    weight += b;
  }
  return sum / weight;
}

double polygon_distance(const std::vector<Point2>& polygon, bool closed, const Point2& p) {
  double best = 1e300;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < polygon.size(); ++i) {
    const Point2 &a = polygon[i], d = polygon[(i + 1) % polygon.size()] - a;
    best = std::min(best, (a + std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) * d - p).norm());
  }
  return best;
}

}  // namespace

TEST_CASE("a flattened spline lies on the curve of its basis functions") {
  const std::vector<Point2> control{{0, 0}, {60, 90}, {150, -40}, {210, 120}, {320, 60}, {300, -90}, {180, -80}};
  struct Case {
    int degree;
    std::vector<double> knots, weights;
  };
  const std::vector<Case> cases{
      {3, {0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4}, {}},
      {3, {0, 0, 0, 0, 0.3, 0.3, 0.9, 2, 2, 2, 2}, {1, 2, 0.5, 4, 1, 1, 3}},
      {3, {-3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7}, {}},  // not clamped
      {2, {0, 0, 0, 1, 1, 2, 3, 4, 4, 4}, {}},       // with a corner at the double knot
      {1, {0, 0, 1, 2, 3, 4, 5, 6, 6}, {}},
      {6, {0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1}, {}},
  };
  for (const Case& c : cases) {
    INFO("degree " << c.degree << ", first inner knot " << c.knots[4]);
    const io::DxfSpline spline{c.degree, false, c.knots, c.weights, control, {}};
    const io::DxfFlattened flat = io::flattened(spline);
    CHECK(flat.fault == "");
    CHECK(!flat.closed);
    const double diagonal = (Point2(320, 120) - Point2(0, -90)).norm();
    const auto p = static_cast<std::size_t>(c.degree);
    const double from = c.knots[p], to = c.knots[control.size()];
    double farthest = 0;
    for (int k = 0; k < 3000; ++k)
      farthest = std::max(farthest,
                          polygon_distance(flat.points, false, spline_point(spline, from + (to - from) * k / 3000)));
    CHECK(farthest < io::kDxfFlatness * diagonal);
    CHECK((flat.points.front() - spline_point(spline, from)).norm() < 1e-9);
    CHECK((flat.points.back() - spline_point(spline, to - 1e-9)).norm() < 1e-5);
    CHECK(flat.points.size() < 1500);
  }
  io::DxfSpline plain{3, false, {}, {}, control, {}};  // no knots: clamped and uniform
  const io::DxfFlattened uniform = io::flattened(plain);
  plain.knots = cases[0].knots;
  CHECK(uniform.points == io::flattened(plain).points);
}

TEST_CASE("splines through fit points") {
  const io::DxfFlattened three = io::flattened(io::DxfSpline{3, false, {}, {}, {}, {{0, 0}, {1, 1}, {2, 0}}});
  // By hand: slopes 3/sqrt(8), 0 and -3/sqrt(8) of y over the chord's length.
  CHECK(polygon_distance(three.points, false, {0.5, 0.6875}) < 3e-5);
  CHECK(polygon_distance(three.points, false, {1.5, 0.6875}) < 3e-5);
  CHECK(polygon_distance(three.points, false, {1, 1}) < 1e-12);
  io::DxfSpline bent{3, false, {}, {}, {}, {{0, 0}, {100, 0}}};
  bent.start = {0, 2}, bent.end = {0, -3};  // only their directions count: a cubic of the chord's length
  const io::DxfFlattened arch = io::flattened(bent);
  CHECK(polygon_distance(arch.points, false, {50, 25}) < 2e-3);
  std::vector<Point2> round;
  for (int k = 0; k < 24; ++k) round.emplace_back(100 * std::cos(k * M_PI / 12), 100 * std::sin(k * M_PI / 12));
  const io::DxfFlattened ring = io::flattened(io::DxfSpline{3, true, {}, {}, {}, round});
  CHECK(ring.closed);
  CHECK(polygon(ring.points) == Approx(M_PI * 0.01).epsilon(1e-4));
  for (const Point2& p : ring.points) CHECK(p.norm() == Approx(100).epsilon(1e-4));
  for (const Point2& p : round) CHECK(polygon_distance(ring.points, true, p) < 1e-9);
  round.push_back(round.front());  // stated twice, it is the same
  CHECK(io::flattened(io::DxfSpline{3, true, {}, {}, {}, round}).points == ring.points);
}

TEST_CASE("an ellipse and its parts") {
  const io::DxfFlattened whole = io::flattened(io::DxfEllipse{{50, 20}, {30, 40}, 0.4});
  CHECK(whole.closed);
  CHECK(polygon(whole.points) == Approx(M_PI * 50 * 20 * 1e-6).epsilon(1e-4));
  for (bool flipped : {false, true}) {
    const io::DxfFlattened part = io::flattened(io::DxfEllipse{{0, 0}, {2, 0}, 0.5, -0.5, 2, flipped});
    CHECK(!part.closed);
    const double sense = flipped ? -1 : 1;
    CHECK((part.points.front() - Point2(2 * std::cos(0.5), -sense * std::sin(0.5))).norm() < 1e-12);
    CHECK((part.points.back() - Point2(2 * std::cos(2), sense * std::sin(2))).norm() < 1e-12);
    for (const Point2& p : part.points) CHECK(p.x() * p.x() / 4 + p.y() * p.y() == Approx(1).epsilon(1e-9));
    for (int k = 0; k <= 1000; ++k) {
      const double t = -0.5 + 2.5 * k / 1000;
      CHECK(polygon_distance(part.points, false, {2 * std::cos(t), sense * std::sin(t)}) < 5e-5);
    }
  }
}

TEST_CASE("pieces with splines, ellipses and bulges, seen from the front and from behind") {
  auto spline = [](Draft& d, const std::string& layer, const std::vector<Point2>& control,
                   const std::vector<double>& weights) {
    d.entity("SPLINE", layer).pair(70, "12").pair(71, "2").pair(72, "6").pair(73, "3");
    for (double knot : {0, 0, 0, 1, 1, 1}) d.number(40, knot);
    for (double w : weights) d.number(41, w);
    for (const Point2& p : control) d.at(10, p).number(30, 0);
  };
  // A square of 200 mm with a quarter disc at each end: an exact rational quadratic, and the same as an ellipse.
  const double quarter = M_PI * 0.04 / 4;
  const io::DxfResult result = dxf_of(style([&](Draft& d) {
    d.block("A").lines("1", {{0, 200}, {0, 0}, {200, 0}}, false);
    d.text.resize(d.text.rfind("LINE") - 2);  // without the line that would close it
    spline(d, "1", {{200, 0}, {400, 0}, {400, 200}}, {1, std::sqrt(0.5), 1});
    d.entity("LINE", "1").at(10, {400, 200}).at(11, {0, 200});
    d.entity("ELLIPSE", "11").at(10, {120, 100}).at(11, {40, 0}).number(40, 0.5).number(41, 0).number(42, 2 * M_PI);
    d.end_block();
    d.block("B").entity("LWPOLYLINE", "1").pair(90, "2").pair(70, "1");
    d.at(10, {0, 0}).number(42, 1).at(10, {200, 0}).number(42, 0.5).end_block();
  }));
  const design::Panel& panel = garment_of(result).panels.at(0);
  CHECK(area(panel) == Approx(0.04 + quarter).epsilon(1e-4));
  CHECK(panel.edges.size() == 4);
  REQUIRE(panel.holes.size() == 1);
  double hole = 0;
  for (const design::Edge& edge : panel.hole_edges) hole += edge.curve.area_term();
  CHECK(std::fabs(hole) == Approx(M_PI * 0.04 * 0.02).epsilon(1e-3));
  // A half disc, and the segment of an arc that turns by 4 atan 1/2.
  const double angle = 4 * std::atan(0.5), r = 0.1 / std::sin(angle / 2);
  CHECK(area(result.garment->panels.at(1)) ==
        Approx(M_PI * 0.01 / 2 + r * r / 2 * (angle - std::sin(angle))).epsilon(1e-6));
  CHECK(result.findings.empty());

  // Seen from behind, what has a plane of its own is mirrored; lines, splines and ellipses are not.
  const std::vector<std::function<void(Draft&)>> ways{
      [](Draft& d) { d.entity("ARC", "1").at(10, {-100, 0}).number(40, 100).number(50, 0).number(51, 90).number(230, -1); },
      [](Draft& d) {
        d.entity("LWPOLYLINE", "1").pair(90, "2").pair(70, "0").number(230, -1);
        d.at(10, {0, 0}).number(42, std::tan(M_PI / 8)).at(10, {-100, 100});
      },
      [](Draft& d) {
        d.entity("ELLIPSE", "1").at(10, {100, 0}).at(11, {100, 0}).number(40, 1).number(41, -M_PI).number(42, -M_PI / 2);
        d.number(230, -1);
      },
      [&](Draft& d) {
        spline(d, "1", {{0, 0}, {0, 100}, {100, 100}}, {1, std::sqrt(0.5), 1});
        d.number(230, -1);
      },
      [](Draft& d) {  // an arc in a block that is turned round
        d.pair(0, "INSERT").pair(8, "1").pair(2, "PART").at(10, {-100, 0}).number(230, -1);
      },
  };
  for (std::size_t i = 0; i < ways.size(); ++i) {
    INFO("way " << i);
    const io::DxfResult turned = dxf_of(style([&](Draft& d) {
      if (i + 1 == ways.size())
        d.block("PART").entity("ARC", "1").at(10, {0, 0}).number(40, 100).number(50, 0).number(51, 90).end_block();
      d.block("A").lines("1", {{100, 100}, {300, 100}, {300, 0}, {0, 0}}, false);
      d.text.resize(d.text.rfind("LINE") - 2);
      ways[i](d);
      d.end_block();
    }));
    // The arc runs on smoothly into a line: both are one edge, fitted by a spline.
    CHECK(area(garment_of(turned).panels.at(0)) == Approx(0.02 + M_PI * 0.01 / 4).epsilon(5e-4));
    CHECK(turned.findings.empty());
  }
}

TEST_CASE("entities that are not read are told with their numbers") {
  const io::DxfResult result = dxf_of(style([](Draft& d) {
    d.block("A").polyline("1", front(), true);
    for (int k = 0; k < 3; ++k) d.entity("HATCH", "8").at(10, {10, 10}).number(40, 1);
    d.entity("DIMENSION", "8").at(10, {10, 10}).end_block();
  }));
  garment_of(result);
  REQUIRE(result.findings.size() == 1);
  CHECK(result.findings[0].code == "G0969");
  CHECK(result.findings[0].severity == Severity::warning);
  CHECK(result.findings[0].message.find("4 entities") != std::string::npos);
  CHECK(result.findings[0].message.find("1 `DIMENSION`, 3 `HATCH`") != std::string::npos);
  struct Case {
    std::function<void(Draft&)> draw;
    const char* words;
  };
  const std::vector<Case> cases{
      {[](Draft& d) { d.pair(71, "3").at(10, {0, 0}).at(10, {50, 50}); }, "2 control points"},
      {[](Draft& d) { d.pair(71, "1").number(40, 0).at(10, {0, 0}).at(10, {50, 50}); }, "1 knots, expected 4"},
      {[](Draft& d) { d.pair(71, "1").number(41, -1).number(41, 1).at(10, {0, 0}).at(10, {50, 50}); }, "not positive"},
      {[](Draft& d) { d.pair(71, "0").at(10, {0, 0}).at(10, {50, 50}); }, "degree 0"},
      {[](Draft& d) { d.pair(71, "3").at(11, {0, 0}); }, "1 fit points"},
  };
  for (const Case& c : cases) {
    const io::DxfResult bad = dxf_of(style([&](Draft& d) {
      d.block("A").polyline("1", front(), true).entity("SPLINE", "8");
      c.draw(d);
      d.end_block();
    }));
    INFO(c.words << "\n" << pattern_test::all_messages(bad.findings));
    CHECK(garment_of(bad).panels.size() == 1);
    CHECK(pattern_test::has_code(bad.findings, "G0969"));
    CHECK(pattern_test::all_messages(bad.findings).find(c.words) != std::string::npos);
  }
  io::DxfOptions small;  // points that a curve is made of count too
  small.limits.max_points = 60;
  const std::string much = style([](Draft& d) {
    d.block("A").entity("ELLIPSE", "1").at(10, {0, 0}).at(11, {200, 0}).number(40, 0.5).number(41, 0).number(42, 6.28).end_block();
  });
  CHECK(pattern_test::has_code(io::read_dxf(much, small).findings, "G0962"));
  CHECK(!pattern_test::has_code(dxf_of(much).findings, "G0962"));
}

TEST_CASE("formatted text, grade rules, other layers, nested sizes") {
  const io::DxfResult mtext = dxf_of(style([](Draft& d) {
    d.block("A")
        .entity("MTEXT", "1")
        .at(10, {0, 0})
        .pair(1, "{\\fArial|b0;Piece Name : COLLAR}\\PQuantity: 2")
        .words("2", "# 14")
        .polyline("1", front(), true);
    d.polyline("1", {{20, 20}, {280, 20}, {280, 500}, {20, 500}}, true)
        .polyline("1", {{100, 100}, {120, 100}, {120, 120}}, true)
        .end_block();
  }));
  CHECK(garment_of(mtext).panels.at(0).name == "COLLAR");
  CHECK(mtext.garment->panels[0].holes.size() == 1);
  for (const std::string& note : mtext.notes) CHECK(note.find('#') == std::string::npos);
  const io::DxfResult layers =
      dxf_of(style([](Draft& d) { d.block("A").polyline("PIECES", front(), true).end_block(); }));
  CHECK(garment_of(layers).panels.size() == 1);
}

TEST_CASE("lines rounded to hundredths of an inch are chained") {
  Draft inch;
  std::vector<Point2> points;
  for (Point2 p : front())
    points.emplace_back(std::round(p.x() / 0.254) / 100, std::round(p.y() / 0.254) / 100);
  const std::string text = style(
      [&](Draft& d) {
        d.block("A");
        for (std::size_t i = 0; i < points.size(); ++i)
          d.entity("LINE", "1")
              .at(10, points[i])
              .at(11, points[(i + 1) % points.size()] + Point2(0.01, 0.01));
        d.end_block();
      },
      "Units: ENGLISH", inch);
  CHECK(area(garment_of(dxf_of(text)).panels.at(0)) == Approx(polygon(front())).epsilon(1e-2));
}

TEST_CASE("what is wrong with a file is said with its line") {
  const std::string good = style([](Draft& d) { d.block("A").polyline("1", front(), true).end_block(); });
  auto replaced = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  struct Case {
    std::string text;
    const char* code;
    const char* words;
    bool read;
  };
  const std::vector<Case> cases{
      {"AutoCAD Binary DXF\r\n\x1a", "G0960", "line 1", false},
      {replaced("\n300\n", "\nNaN\n"), "G0961", "line 3", false},
      {replaced("\n300\n", "\n1e999\n"), "G0961", "finite", false},
      {replaced("\n70\n", "\nx70\n"), "G0961", "group code", false},
      {"", "G0968", "no pattern piece", false},
      {"  0\nEOF\n", "G0968", "no pattern piece", false},
      {good.substr(0, good.size() - 12), "G0963", "breaks off", true},
  };
  for (const Case& c : cases) {
    const io::DxfResult result = dxf_of(c.text);
    INFO(c.code << " " << c.words << "\n" << pattern_test::all_messages(result.findings));
    CHECK(pattern_test::has_code(result.findings, c.code));
    CHECK(pattern_test::all_messages(result.findings).find(c.words) != std::string::npos);
    CHECK(result.garment.has_value() == c.read);
    CHECK(result.garment.has_value() != has_errors(result.findings));
  }
  const io::DxfResult open = dxf_of(style([](Draft& d) {
    d.block("A").polyline("1", front(), true).end_block();
    d.block("B").polyline("1", {{0, 0}, {100, 0}, {100, 100}}, false).end_block();
  }));
  CHECK(garment_of(open).panels.size() == 1);
  CHECK(pattern_test::has_code(open.findings, "G0965"));
  io::DxfOptions small;
  small.limits.max_points = 5;
  CHECK(pattern_test::has_code(io::read_dxf(good, small).findings, "G0962"));
}

TEST_CASE("a file cut anywhere is read or refused, and says why") {
  const std::string good = style([](Draft& d) {
    d.block("A").polyline("1", front(), true).point("4", {150, 0}).end_block();
  });
  for (std::size_t n = 0; n < good.size(); n += 3) {
    const io::DxfResult result = dxf_of(good.substr(0, n));
    CHECK(result.garment.has_value() != has_errors(result.findings));
    CHECK(!result.findings.empty());
  }
}

TEST_CASE("text comes as UTF-8, Latin-1 or escapes") {
  for (const char* name : {"\xC3\x89L\xC3\x89GANT", "\xC9L\xC9GANT", "\\U+00C9L\\U+00C9GANT"}) {
    const io::DxfResult result = dxf_of(style([&](Draft& d) {
      d.block("A").words("1", std::string("Annotation: ") + name).polyline("1", front(), true).end_block();
    }));
    garment_of(result);
    bool told = false;
    for (const std::string& note : result.notes)
      told = told || note.find("\xC3\x89L\xC3\x89GANT") != std::string::npos;
    CHECK(told);
  }
}

TEST_CASE("what is written is read back as the same pieces") {
  const io::DxfResult first = dxf_of(style([](Draft& d) {
    d.block("FRONT").words("1", "Piece Name: FRONT").polyline("1", front(), true);
    marks(d);
    d.point("4", {150, 0})
        .entity("LINE", "7")
        .at(10, {100, 100})
        .at(11, {200, 200})
        .polyline("8", {{50, 100}, {50, 400}}, false);
    d.point("13", {150, 300}).entity("CIRCLE", "11").at(10, {200, 400}).number(40, 10).end_block();
    d.block("ROUND").entity("CIRCLE", "1").at(10, {0, 0}).number(40, 100).end_block();
  }));
  design::Garment garment = garment_of(first);
  for (double allowance : {0.0, 0.01}) {
    for (design::Edge& edge : garment.panels[0].edges) edge.allowance = allowance;
    const std::string text = io::write_dxf(garment).text;
    CHECK(text == io::write_dxf(garment).text);
    const io::DxfResult again = dxf_of(text);
    const design::Garment& back = garment_of(again);
    CHECK(again.findings.empty());
    REQUIRE(back.panels.size() == garment.panels.size());
    for (std::size_t p = 0; p < back.panels.size(); ++p) {
      CHECK(back.panels[p].name == garment.panels[p].name);
      CHECK(area(back.panels[p]) == Approx(area(garment.panels[p])).epsilon(1e-4));
      CHECK(back.panels[p].notches.size() == garment.panels[p].notches.size());
      CHECK(back.panels[p].points.size() == garment.panels[p].points.size());
      CHECK(back.panels[p].holes.size() == garment.panels[p].holes.size());
      CHECK(back.panels[p].lines.size() == garment.panels[p].lines.size());
      CHECK(back.panels[p].grain_angle == Approx(garment.panels[p].grain_angle).margin(1e-5));
    }
    for (const design::Edge& edge : back.panels[0].edges)
      CHECK(edge.allowance == Approx(allowance).margin(1e-9));
  }
}
