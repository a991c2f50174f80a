#include <catch2/catch.hpp>
#include <map>
#include <regex>

#include "runtime/base/number.hpp"
#include "runtime/io/cut_lines.hpp"
#include "runtime/io/panel_drawing.hpp"
#include "runtime/io/svg_writer.hpp"
#include "tests/support/skirt_pattern.hpp"

using namespace garment;
using io::Extent;
using io::Point;

namespace {

/// Tags closed in the order they were opened.
bool well_formed(const std::string& svg) {
  std::vector<std::string> open;
  static const std::regex tag(R"(<(/?)([a-zA-Z]+)[^<>]*?(/?)>)");
  for (std::sregex_iterator it(svg.begin(), svg.end(), tag), end; it != end; ++it) {
    if ((*it)[1].length() > 0) {
      if (open.empty() || open.back() != (*it)[2]) return false;
      open.pop_back();
    } else if ((*it)[3].length() == 0) {
      open.push_back((*it)[2]);
    }
  }
  return open.empty();
}

/// Box of the first path of each group: the outlines of the panels, mm.
std::map<std::string, Extent> outlines(const std::string& svg) {
  std::map<std::string, Extent> out;
  static const std::regex group(R"~(<g id="([^"]*)">\s*<path d="([^"]*)")~"),
      number(R"([ML]([-0-9.e]+) ([-0-9.e]+))");
  for (std::sregex_iterator it(svg.begin(), svg.end(), group), end; it != end; ++it) {
    const std::string path = (*it)[2];
    Extent& box = out[(*it)[1]];
    for (std::sregex_iterator p(path.begin(), path.end(), number); p != end; ++p)
      box.grow({parse_number((*p)[1].str()).value(), parse_number((*p)[2].str()).value()});
  }
  return out;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

bool apart(const Extent& a, const Extent& b) {
  return a.high[0] < b.low[0] || b.high[0] < a.low[0] || a.high[1] < b.low[1] || b.high[1] < a.low[1];
}

}  // namespace

TEST_CASE("the pattern is drawn to scale, panels apart, seams lettered on both sides", "[writer]") {
  const std::string svg = io::write_pattern_svg(test::make_skirt_pattern());
  CHECK(well_formed(svg));
  const auto boxes = outlines(svg);
  REQUIRE(boxes.size() == 2);
  const Extent &front = boxes.at("front"), &back = boxes.at("back");
  CHECK(front.size()[0] == Approx(530).margin(0.01));
  CHECK(front.size()[1] == Approx(590).margin(0.01));
  CHECK(apart(front, back));
  CHECK(count(svg, ">A</text>") == 2);
  CHECK(count(svg, ">B</text>") == 2);
  CHECK(count(svg, "left.hip") == 2);
  CHECK(svg.find("100 mm") != std::string::npos);
  CHECK(svg.find("side.left") != std::string::npos);
  static const std::regex page(
      R"(width="([0-9.]+)mm" height="([0-9.]+)mm" viewBox="0 0 ([0-9.]+) ([0-9.]+)\")");
  std::smatch m;
  REQUIRE(std::regex_search(svg, m, page));
  CHECK(m[1] == m[3]);
  CHECK(m[2] == m[4]);
  for (const auto& [name, box] : boxes) {
    CHECK(box.low.minCoeff() > 0);
    CHECK(box.high[0] < parse_number(m[1].str()).value());
    CHECK(box.high[1] < parse_number(m[2].str()).value());
  }
}

TEST_CASE("many panels of odd sizes never overlap", "[writer]") {
  design::Garment g;
  for (int k = 0; k < 23; ++k) {
    design::Panel p;
    p.name = "p" + std::to_string(k);
    const double w = 0.03 + 0.05 * (k * 7 % 11), h = 0.02 + 0.09 * (k * 5 % 13);
    const geometry::Point2 corners[] = {{0, 0}, {w, 0}, {w, h}, {0, h}};
    for (int e = 0; e < 4; ++e)
      p.edges.push_back({"e", {}, geometry::Curve(corners[e], corners[(e + 1) % 4]), false});
    g.panels.push_back(p);
  }
  const auto boxes = outlines(io::write_pattern_svg(g));
  REQUIRE(boxes.size() == 23);
  for (const auto& [a, box_a] : boxes)
    for (const auto& [b, box_b] : boxes)
      if (a < b) CHECK(apart(box_a, box_b));
}

TEST_CASE("darts are cut away from the drawn outline on either sense of the loop", "[writer]") {
  design::Panel panel = test::make_skirt_panel("front", 0.09);
  auto apexes_inside = [](const design::Panel& p) {
    const io::PanelDrawing drawn(p, {}, {}, {0.5, 0.5, 0.5});
    int n = 0;
    double lowest = 1e9, highest = -1e9;
    for (const Point& q : drawn.outline()) {
      lowest = std::min(lowest, q[1]);
      highest = std::max(highest, q[1]);
      n += std::fabs(q[0]) > 90 && std::fabs(q[0]) < 130 && q[1] > 485 && q[1] < 505;
    }
    CHECK(highest == Approx(590).margin(0.1));
    CHECK(lowest == Approx(0).margin(0.1));
    return n;
  };
  CHECK(apexes_inside(panel) == 2);
  std::reverse(panel.edges.begin(), panel.edges.end());
  for (design::Edge& e : panel.edges) e.curve = e.curve.reversed();
  CHECK(apexes_inside(panel) == 2);
}

TEST_CASE("names are text, not markup, and gaps in the declaration do no harm", "[writer]") {
  design::Garment g = test::make_skirt_pattern();
  g.title = "a <b> & \"c\"";
  g.panels[0].name = "x<y";
  g.panels[1].fabric = 17;
  g.panels[1].darts[0].edge = "nowhere";
  g.panels[1].notches[0].edge = "nowhere";
  g.seams[0].sides[0].parts[0].panel = 9;
  g.seams[1].sides[0].parts[0].edge = -1;
  g.panels.emplace_back();  // no edges at all
  const std::string svg = io::write_pattern_svg(g);
  CHECK(well_formed(svg));
  CHECK(svg.find("a &lt;b&gt; &amp; &quot;c&quot;") != std::string::npos);
  CHECK(well_formed(io::write_pattern_svg({})));
}

TEST_CASE("area and mass come from the model", "[writer]") {
  model::Model m;
  model::PanelRange r;
  r.name = "front";
  r.area = 0.25;
  r.mass = 0.0512;
  m.panels.push_back(r);
  CHECK(io::write_pattern_svg(test::make_skirt_pattern(), m).find("2500 cm2, 51.2 g") != std::string::npos);
}

namespace {

/// 20 cm by 30 cm, counter-clockwise, with an allowance of `width` at every edge.
design::Panel sheet(double width) {
  design::Panel p;
  p.name = "sheet";
  const design::Point2 corners[] = {{0, 0}, {0.2, 0}, {0.2, 0.3}, {0, 0.3}};
  for (int k = 0; k < 4; ++k) {
    design::Edge edge;
    edge.name = "e" + std::to_string(k);
    edge.curve = geometry::Curve(corners[k], corners[(k + 1) % 4]);
    edge.allowance = width;
    p.edges.push_back(edge);
  }
  return p;
}

double area_of(const io::CutLine& line) {
  double twice = 0;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const design::Point2 &a = line[k], &b = line[(k + 1) % line.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

}  // namespace

TEST_CASE("cut lines lie outside the stitch line by the allowance, mitred at corners", "[writer]") {
  CHECK(io::cut_lines(sheet(0)).empty());
  design::Panel p = sheet(0.01);
  REQUIRE(io::cut_lines(p).size() == 1);
  CHECK(area_of(io::cut_lines(p)[0]) == Approx(0.22 * 0.32));
  p.edges[0].allowance = 0.04;
  p.edges[2].allowance = 0;
  CHECK(area_of(io::cut_lines(p)[0]) == Approx(0.22 * 0.34));
  // A notch cut into the top: at its inner corners the cut lines cross and end there.
  design::Panel q;
  const design::Point2 corners[] = {{0, 0}, {0.2, 0}, {0.2, 0.3}, {0.15, 0.3}, {0.15, 0.2}, {0.05, 0.2}, {0.05, 0.3}, {0, 0.3}};
  for (int k = 0; k < 8; ++k) {
    design::Edge edge;
    edge.curve = geometry::Curve(corners[k], corners[(k + 1) % 8]);
    edge.allowance = 0.01;
    q.edges.push_back(edge);
  }
  CHECK(area_of(io::cut_lines(q)[0]) == Approx(0.22 * 0.32 - 0.08 * 0.1));
}

TEST_CASE("a hole's cut line lies inside it", "[writer]") {
  design::Panel p = sheet(0);
  p.holes.push_back({"eye", {}, 0, 2});
  for (const double side : {0.03, -0.03}) {
    design::Edge edge;
    edge.curve = geometry::Curve({0.1 + side, 0.1}, {0.1 - side, 0.1}, geometry::Arc{-0.03});
    edge.allowance = 0.01;
    p.hole_edges.push_back(edge);
  }
  REQUIRE(io::cut_lines(p).size() == 1);
  CHECK(area_of(io::cut_lines(p)[0]) == Approx(M_PI * 4e-4).epsilon(1e-2));
}

TEST_CASE("what lies inside a panel is drawn with its name", "[writer]") {
  design::Garment garment;
  design::Panel p = sheet(0.01);
  design::Edge line;
  line.name = "roll_line";
  line.curve = geometry::Curve({0.02, 0.1}, {0.18, 0.12});
  p.lines.push_back(line);
  p.slits.push_back({"vent_slit", {}, 0});
  p.points.push_back({"bust_point", {}, {0.1, 0.2}});
  p.inside_darts.push_back({"fish_dart", {}, {0.05, 0.15}, {0.05, 0.25}, 0.02, 0.5});
  p.pleats.push_back({"box_pleat", {}, "e2", design::Pleat::Kind::box, 0.1, 0.01, 1, 0.04, 1, 0, false});
  garment.panels.push_back(p);
  const std::string svg = io::write_pattern_svg(garment);
  CHECK(well_formed(svg));
  for (const char* name : {"roll_line", "bust_point", "fish_dart", "box_pleat"}) CHECK(count(svg, name) == 1);
  CHECK(svg.find("thin ones outside cut lines") != std::string::npos);
}
