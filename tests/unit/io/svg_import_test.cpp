// Drawings as panels.
#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/io/pattern_panel.hpp"
#include "runtime/io/svg_import.hpp"
#include "runtime/io/svg_path.hpp"
#include "runtime/io/svg_writer.hpp"
#include "tests/unit/io/pattern_support.hpp"

using namespace garment;
using design::Point2;
using pattern_test::area;

namespace {

constexpr double kPi = 3.14159265358979;

std::string drawing(const std::string& body,
                    const std::string& size = R"(width="200mm" height="100mm" viewBox="0 0 200 100")") {
  return "<?xml version=\"1.0\"?><svg xmlns=\"http://www.w3.org/2000/svg\" " + size + ">" + body + "</svg>";
}

io::SvgResult svg_of(const std::string& text) {
  io::SvgOptions options;
  options.fabric.name = "cloth";
  return io::read_svg(text, options);
}

const design::Garment& garment_of(const io::SvgResult& result) {
  INFO(pattern_test::all_messages(result.findings));
  REQUIRE(result.garment);
  return *result.garment;
}

}  // namespace

TEST_CASE("shapes and path commands have the areas that geometry says, mm") {
  struct Case {
    const char* body;
    double mm2;
    std::size_t edges;
  };
  const Case cases[] = {
      {R"(<path d="M10 10 L60 10 L60 40 L10 40 Z"/>)", 1500, 4},
      {R"(<path d="m10,10 50,0 0,30 -50,0z"/>)", 1500, 4},
      {R"(<path d="M10 10H60V40H10Z"/>)", 1500, 4},
      {R"(<path d="M10 10h50v30h-50v-30"/>)", 1500, 4},  // closed by its ends
      {R"(<polygon points="10,10 60,10 60,40 10,40"/>)", 1500, 4},
      {R"(<rect x="10" y="10" width="50" height="30"/>)", 1500, 4},
      {R"(<circle cx="50" cy="50" r="20"/>)", kPi * 400, 4},
      {R"(<path d="M 30 50 A 20 20 0 1 1 70 50 A 20 20 0 1 1 30 50 Z"/>)", kPi * 400, 2},
      {R"(<path d="M30 50a20 20 0 0140 0z"/>)", kPi * 200, 2},  // flags run together
      {R"(<path d="M 30 50 A 20 20 0 0 0 70 50 Z"/>)", kPi * 200, 2},
      {R"(<path d="M 0 0 Q 50 50 100 0 Z"/>)", 100 * 25 * 2.0 / 3, 2},
      {R"(<path d="M 0 0 Q 25 50 50 0 T 100 0 Z m 0 0"/>)", -1, 0},
      {R"(<path d="M 0 0 C 0 40 100 40 100 0 Z"/>)", 100 * 30 * 0.8, 2},
      {R"(<path d="M0 0H100V50H0Z M20 20H40V40H20Z"/>)", 5000, 4},
  };
  for (const Case& c : cases) {
    INFO(c.body);
    const io::SvgResult result = svg_of(drawing(c.body));
    if (c.edges == 0) continue;
    const design::Garment& garment = garment_of(result);
    REQUIRE(garment.panels.size() == 1);
    CHECK(area(garment.panels[0]) * 1e6 == Approx(c.mm2).epsilon(1e-6));
    CHECK(garment.panels[0].edges.size() == c.edges);
  }
  CHECK(garment_of(svg_of(drawing(cases[13].body))).panels[0].holes.size() == 1);
}

TEST_CASE("curves stay what they are") {
  const io::SvgResult result =
      svg_of(drawing(R"(<path d="M0 0 L50 0 Q 60 20 50 40 C 40 50 30 60 20 40 A 20 20 0 0 1 0 20 Z"/>)"));
  const design::Panel& panel = garment_of(result).panels.at(0);
  std::vector<int> kinds(6, 0);
  for (const design::Edge& edge : panel.edges) ++kinds[edge.curve.shape().index()];
  CHECK(kinds == std::vector<int>{2, 1, 1, 1, 0, 0});
}

TEST_CASE("transforms move, turn, mirror and stretch") {
  const double circle = kPi * 100;
  struct Case {
    const char* transform;
    double factor;
    bool arcs;
  };
  for (const Case& c : {Case{"translate(10,20)", 1, true}, Case{"rotate(30 5 5) scale(2)", 4, true},
                        Case{"scale(-1,1)", 1, true}, Case{"scale(2 1)", 2, false},
                        Case{"skewX(30)", 1, false}, Case{"matrix(0 1 -1 0 3 4)", 1, true}}) {
    INFO(c.transform);
    const io::SvgResult result = svg_of(drawing(std::string("<g transform=\"") + c.transform +
                                                "\"><circle cx=\"20\" cy=\"20\" r=\"10\"/></g>"));
    const design::Panel& panel = garment_of(result).panels.at(0);
    CHECK(area(panel) * 1e6 == Approx(circle * c.factor).epsilon(5e-4));
    CHECK(std::holds_alternative<geometry::Arc>(panel.edges[0].curve.shape()) == c.arcs);
  }
  CHECK(!io::svg_transform("turn(3)"));
  CHECK(pattern_test::has_code(
      svg_of(drawing("<g transform=\"turn(3)\"><circle r=\"10\"/></g><rect width=\"9\" height=\"9\"/>"))
          .findings,
      "G0971"));
}

TEST_CASE("units come from width, height and viewBox") {
  const char* square = R"(<rect x="1" y="1" width="50" height="50"/>)";
  struct Case {
    const char* size;
    double side;  // m
    bool warns;
  };
  for (const Case& c : {Case{R"(width="100mm" height="100mm" viewBox="0 0 100 100")", 0.05, false},
                        Case{R"(width="10cm" height="10cm" viewBox="0 0 1000 1000")", 0.005, false},
                        Case{R"(width="10in" viewBox="0 0 100 100")", 0.127, false},
                        Case{R"(width="960" height="960")", 50 * 0.0254 / 96, false},
                        Case{R"(viewBox="0 0 960 960")", 50 * 0.0254 / 96, true},
                        Case{R"(width="100%" height="100%")", 50 * 0.0254 / 96, true}}) {
    INFO(c.size);
    const io::SvgResult result = svg_of(drawing(square, c.size));
    CHECK(area(garment_of(result).panels.at(0)) == Approx(c.side * c.side));
    CHECK(pattern_test::has_code(result.findings, "G0972") == c.warns);
  }
}

TEST_CASE("names come from labels, ids and groups; what is not shown is not read") {
  const io::SvgResult result = svg_of(drawing(
      R"(<defs><rect id="no" width="20" height="20"/></defs><rect width="200" height="100"/>)"
      R"(<g id="layer" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"><rect inkscape:label="Front 1" id="r1" width="20" height="20"/>)"
      R"(<rect id="back" x="30" width="20" height="20"/><rect x="60" width="20" height="20"/></g>)"
      R"(<g style="display:none"><rect id="hidden" width="20" height="20"/></g><path d="M0 0L10 10"/>)"));
  const design::Garment& garment = garment_of(result);
  std::vector<std::string> names;
  for (const design::Panel& panel : garment.panels) names.push_back(panel.name);
  CHECK(names == std::vector<std::string>{"Front_1", "back", "layer"});
}

TEST_CASE("a drawing of ours comes back as the same panels") {
  design::Garment garment;
  garment.title = "both";
  garment.fabrics.emplace_back().name = "cloth";
  for (int k = 0; k < 2; ++k) {
    design::Panel panel;
    panel.name = k == 0 ? "front" : "back";
    auto edge = [&](const char* name, Point2 a, Point2 b, geometry::Curve::Shape shape = geometry::Line{}) {
      design::Edge e;
      e.name = name;
      e.curve = geometry::Curve(a, b, std::move(shape));
      panel.edges.push_back(std::move(e));
    };
    edge("hem", {0, 0}, {0.3, 0}, geometry::Quadratic{{0.15, -0.02}});
    edge("side", {0.3, 0}, {0.28, 0.6}, geometry::Through{{{0.32, 0.2}, {0.31, 0.4}}});
    edge("neck", {0.28, 0.6}, {0.1, 0.58}, geometry::Arc{k == 0 ? 0.03 : -0.02});
    edge("middle", {0.1, 0.58}, {0, 0}, geometry::Cubic{{0.05, 0.4}, {-0.02, 0.2}});
    panel.notches.push_back({"hip", {}, "side", 0.2});
    garment.panels.push_back(std::move(panel));
  }
  const io::SvgResult result = svg_of(io::write_pattern_svg(garment));
  CHECK(result.findings.empty());
  const design::Garment& back = garment_of(result);
  REQUIRE(back.panels.size() == 2);
  for (std::size_t p = 0; p < 2; ++p) {
    CHECK(back.panels[p].name == garment.panels[p].name);
    CHECK(area(back.panels[p]) == Approx(area(garment.panels[p])).epsilon(1e-7));
    REQUIRE(back.panels[p].edges.size() == 4);
    for (std::size_t e = 0; e < 4; ++e) {
      CHECK(back.panels[p].edges[e].name == garment.panels[p].edges[e].name);
      CHECK(back.panels[p].edges[e].curve.length() ==
            Approx(garment.panels[p].edges[e].curve.length()).epsilon(1e-7));
    }
  }
}

TEST_CASE("what is wrong with a drawing is said") {
  struct Case {
    std::string text;
    const char* code;
    bool read;
  };
  std::string deep;
  for (int i = 0; i < 100; ++i) deep += "<g>";
  deep += "<circle r=\"9\"/>";
  for (int i = 0; i < 100; ++i) deep += "</g>";
  const Case cases[] = {{"", "G0970", false},
                        {"<svg><path", "G0970", false},
                        {"<html/>", "G0970", false},
                        {drawing("<text>skirt</text>"), "G0973", false},
                        {drawing("<path d=\"M0 0 L50 0 L50 50 Z L 3 x\"/>"), "G0971", true},
                        {drawing("<path d=\"M0 0 L1e400 0 Z\"/>"), "G0971", false},
                        {drawing("<path d=\"nonsense\"/><rect width=\"9\" height=\"9\"/>"), "G0971", true},
                        {drawing(deep), "G0974", false}};
  for (const Case& c : cases) {
    const io::SvgResult result = svg_of(c.text);
    INFO(c.text.substr(0, 100) << pattern_test::all_messages(result.findings));
    CHECK(pattern_test::has_code(result.findings, c.code));
    CHECK(result.garment.has_value() == c.read);
    CHECK(result.garment.has_value() != has_errors(result.findings));
  }
}
