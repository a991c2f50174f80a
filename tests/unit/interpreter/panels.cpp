// Outlines, folds, darts, notches, like blocks, assignments.
#include <cmath>

#include "tests/unit/interpreter/support.hpp"

using namespace garment;
using namespace garment::interpreter;
using namespace garment::interpreter::test;

namespace {

const std::string kHead = "use fabrics\nfabric f = fabrics.poplin\n";

/// A panel p of f with this outline block and what follows it.
std::string panel(const std::string& outline, const std::string& rest = "", const std::string& head = "") {
  return kHead + "panel p of f " + head + " {\n  outline from (0, 0) {\n" + outline + "  }\n" + rest + "}\n";
}

const std::string kSquare =
    "    edge bottom to (20 cm, 0) free\n    edge right_side to (20 cm, 30 cm) free\n    edge top to (0, 30 "
    "cm) free\n"
    "    close left_side free\n";
const std::string kHalf =
    "    edge hem to (20 cm, 0) free\n    edge side to (18 cm, 30 cm) free\n    edge waist to (0, 30 cm) "
    "free\n"
    "    close cf\n";

const geometry::Curve& edge(const design::Panel& p, const std::string& name) {
  for (const design::Edge& e : p.edges)
    if (e.name == name) return e.curve;
  FAIL("no edge " + name);
  return p.edges[0].curve;
}

double area_of(const design::Panel& p) {
  double sum = 0;
  for (const design::Edge& e : p.edges) sum += e.curve.area_term();
  return sum;
}

}  // namespace

TEST_CASE("every way of walking an edge") {
  const Trial trial(
      panel("    edge a by (20 cm, 0) free\n"
            "    edge b heading +y length 10 cm free\n"
            "    edge c to (20 cm, 20 cm) arc radius 6 cm free\n"
            "    edge d to (20 cm, 30 cm) arc through (25 cm, 25 cm) free\n"
            "    edge e by (-5 cm, 0) control (-2 cm, 3 cm) free\n"
            "    edge g by (-5 cm, 0) controls (-1 cm, 2 cm), (-4 cm, 2 cm) free\n"
            "    edge h to (0, 30 cm) through (7 cm, 31 cm), (3 cm, 32 cm) free\n"
            "    edge k to (-5 cm, 15 cm) tangents start -y end -y free\n"
            "    close z bulge 1 cm free\n"));
  const design::Panel& p = last_panel(trial);
  REQUIRE(p.edges.size() == 9);
  CHECK((p.edges[1].curve.end() - design::Point2(0.2, 0.1)).norm() < 1e-15);
  // A positive radius bulges to the left of the way walked: upwards, so towards smaller x.
  CHECK(p.edges[2].curve.point_at(p.edges[2].curve.length() / 2).x() < 0.2);
  CHECK(p.edges[2].curve.length() == Approx(2 * 0.06 * std::asin(5.0 / 6)).epsilon(1e-9));
  CHECK(p.edges[3].curve.length() == Approx(M_PI * 0.05).epsilon(1e-9));
  CHECK(p.edges[3].curve.point_at(p.edges[3].curve.length() / 2).x() == Approx(0.25));
  const auto quadratic = std::get<geometry::Quadratic>(p.edges[4].curve.shape());
  CHECK((quadratic.control - design::Point2(0.18, 0.33)).norm() < 1e-12);
  const auto cubic = std::get<geometry::Cubic>(p.edges[7].curve.shape());
  CHECK(cubic.control_1.x() == Approx(0).margin(1e-15));
  CHECK(cubic.control_2.x() == Approx(-0.05));
  CHECK(std::get<geometry::Arc>(p.edges[8].curve.shape()).bulge == Approx(0.01));
}

TEST_CASE("tangents: a missing one aims at the other handle") {
  const Trial trial(
      panel("    edge a to (30 cm, 9 cm) tangents start +x free\n    edge b to (0, 30 cm) free\n    close c "
            "free\n"));
  const auto cubic = std::get<geometry::Cubic>(last_panel(trial).edges[0].curve.shape());
  const double handle = std::hypot(0.3, 0.09) / 3;
  CHECK((cubic.control_1 - design::Point2(handle, 0)).norm() < 1e-12);
  const design::Point2 way = (cubic.control_1 - design::Point2(0.3, 0.09)).normalized();
  CHECK((cubic.control_2 - (design::Point2(0.3, 0.09) + handle * way)).norm() < 1e-12);
}

TEST_CASE("what an outline may not be") {
  refuses(panel("    edge a to (20 cm, 0)\n    edge «b» to (20 cm, 30 cm)\n"), "G0401", "close NAME");
  refuses(panel("    edge «a» to (20 cm, 20 cm)\n    edge b to (20 cm, 0)\n    edge c to (0, 20 cm)\n    "
                "close d\n"),
          "G0402", "(10 cm, 10 cm)");
  refuses(panel("    edge «a» to (0, 0)\n    edge b to (20 cm, 0)\n    edge c to (0, 20 cm)\n    close d\n"),
          "G0403");
  refuses(panel("    edge a to (20 cm, 0)\n    edge «a» to (20 cm, 30 cm)\n    close c\n"), "G0302");
  refuses(panel("    edge «a»\n    edge b to (20 cm, 30 cm)\n    close c\n"), "G0312", "has no end");
  refuses(panel("    edge «a» to (20 cm, 0) by (1 cm, 0)\n    edge b to (20 cm, 30 cm)\n    close c\n"),
          "G0415");
  refuses(panel("    edge «a» to (20 cm, 0) bulge 1 cm control (1 cm, 0)\n    edge b to (20 cm, 30 cm)\n    "
                "close c\n"),
          "G0415", "two curves");
  refuses(panel("    edge a to (20 cm, 0) arc radius «5 cm»\n    edge b to (20 cm, 30 cm)\n    close c\n"),
          "G0413", "10 cm at least");
  refuses(panel("    edge a to «(20, 0)»\n    edge b to (20 cm, 30 cm)\n    close c\n"), "G0308", "10 cm");
  refuses(panel("    edge a to (20 cm, 0) «tangents middle +x»\n    edge b to (20 cm, 30 cm)\n    close c\n"),
          "G0313");
  refuses(panel("    edge a heading «45» length 3 cm\n    edge b to (20 cm, 30 cm)\n    close c\n"), "G0308",
          "30 deg");
  refuses(panel("    edge «start» to (20 cm, 0)\n    edge b to (20 cm, 30 cm)\n    close c\n"), "G0303");
  refuses(kHead + "«panel p» of f {\n grain +y\n}\n", "G0411");
  refuses("«panel p» {\n outline circle((0, 0), 10 cm) free\n}\n", "G0312", "fabric");
  refuses(kHead + "panel p of f {\n outline circle((0, 0), «1 mm») free\n}\n", "G0309");
  refuses("panel p of «3» {\n outline circle((0, 0), 10 cm) free\n}\n", "G0306");
}

TEST_CASE("a circle has one edge with a name") {
  const Trial rim(kHead +
                  "panel p of f { outline circle((1 cm, 2 cm), 10 cm) }\nmeasure a = length(p.rim)\n");
  CHECK(area_of(last_panel(rim)) == Approx(M_PI * 0.01).epsilon(1e-12));
  CHECK(*rim.result.measures[0].value == Approx(2 * M_PI * 0.1));
  REQUIRE(rim.result.diagnostics.size() == 1);
  CHECK(rim.result.diagnostics[0].code == "G0505");
  CHECK(rim.result.diagnostics[0].message.find("p.rim") != std::string::npos);
  accepts(Trial(
      kHead +
      "panel p of f { outline circle((0, 0), 10 cm) as edge_name free }\nmeasure a = length(p.edge_name)\n"));
}

TEST_CASE("a panel on the fold is opened") {
  const Trial trial(
      panel(kHalf,
            "  dart d on waist at 50% width 2 cm depth 8 cm\n  notch hip on side at 10 cm before end\n",
            "on fold cf") +
      "measure whole = length(p.waist)\nmeasure cut = cut_length(p.waist)\nmeasure half = "
      "length(p.left.waist)\n"
      "measure part = length(p.left.side[start .. hip])\nmeasure cloth = area(p)\n");
  const design::Panel& p = last_panel(trial);
  REQUIRE(p.edges.size() == 6);
  for (std::size_t k = 0; k < 6; ++k)
    CHECK((p.edges[k].curve.end() - p.edges[(k + 1) % 6].curve.start()).norm() < 1e-12);
  CHECK(area_of(p) == Approx(0.114));
  CHECK(edge(p, "left.side").start().x() == Approx(0.2));
  CHECK(edge(p, "right.side").end().x() == Approx(-0.2));
  REQUIRE(p.darts.size() == 2);
  CHECK(p.darts[0].at == Approx(0.09));
  CHECK(p.darts[1].at == Approx(0.09));
  REQUIRE(p.notches.size() == 2);
  // The mirrored edge is walked the other way, so the mark lies 10 cm from its start.
  CHECK(p.notches[1].edge == "right.side");
  CHECK(p.notches[1].at == Approx(0.10));
  const auto& m = trial.result.measures;
  CHECK(*m[0].value == Approx(0.32));
  CHECK(*m[1].value == Approx(0.36));
  CHECK(*m[2].value == Approx(0.16));
  CHECK(*m[3].value == Approx(std::hypot(0.02, 0.30) - 0.10));
  CHECK(*m[4].value == Approx(0.114 - 2 * 0.02 * 0.08 / 2));
}

TEST_CASE("the fold is straight and met squarely") {
  const std::string slanted =
      "    edge hem to (20 cm, 0) free\n    edge side to (18 cm, 30 cm) free\n    edge waist to (0, 28 cm) "
      "free\n    close cf\n";
  refuses(panel(slanted, "", "on fold cf"), "G0405", "deg");
  refuses(panel("    edge hem to (20 cm, 0)\n    edge side to (18 cm, 30 cm)\n    edge waist to (3 cm, 30 "
                "cm)\n    close cf\n",
                "", "on fold cf"),
          "G0404");
  refuses(panel("    edge hem to (20 cm, 0)\n    edge side to (-8 cm, 15 cm)\n    edge s2 to (18 cm, 30 "
                "cm)\n    edge waist to (0, "
                "30 cm)\n    close cf\n",
                "", "on fold cf"),
          "G0402");
  refuses(panel("    edge hem to (20 cm, 0)\n    edge side to (20 cm, 50 cm)\n    edge over to (-5 cm, 40 "
                "cm)\n    edge waist "
                "to (0, 30 cm) tangents end +x\n    close cf\n",
                "", "on fold cf"),
          "G0406", "crosses the fold");
  refuses(panel(kHalf, "", "on fold «cb»"), "G0301", "did you mean `cf`?");
  refuses(panel(kHalf, "  notch «n» on cf at 5 cm\n", "on fold cf"), "G0414", "fold");
}

TEST_CASE("darts and notches stay where they can be") {
  const std::string dart = "  dart «d» on top at ";
  refuses(panel(kSquare, dart + "50% width 2 cm depth 31 cm\n"), "G0407", "30 cm deep there");
  refuses(panel(kSquare, dart + "1 cm width 4 cm depth 8 cm\n"), "G0408");
  refuses(panel(kSquare, dart + "50% width 2 cm to (50 cm, 3 cm)\n"), "G0407");
  refuses(panel(kSquare, dart + "50% width 2 cm\n"), "G0312", "tip");
  refuses(panel(kSquare, "  «dart» d on top at 50% depth 8 cm\n"), "G0312", "width");
  refuses(panel(kSquare, "  dart d on «tpo» at 50% width 2 cm depth 8 cm\n"), "G0301", "did you mean `top`?");
  refuses(panel(kSquare, "  dart d on top at 50% width «90 cm» depth 8 cm\n"), "G0309");
  refuses(panel(kSquare,
                "  dart a on top at 9 cm width 2 cm depth 8 cm\n  dart «b» on top at 10 cm width 2 cm depth "
                "8 cm\n"),
          "G0417");
  refuses(panel(kSquare, "  notch n on top «at 25 cm»\n"), "G0414", "20 cm");
  refuses(panel(kSquare, "  notch n on top at «3»\n"), "G0309", "3 cm");
  accepts(Trial(panel(kSquare,
                      "  notch a on top at 50%\n  notch b on top at 2 cm after a\n  dart d on top at a width "
                      "2 cm to (10 cm, 20 cm)\n")));
}

TEST_CASE("resolution, grain, label") {
  const Trial trial(panel(kSquare, "  resolution 5 mm\n  grain 45 deg\n  label \"arm\"\n"));
  const design::Panel& p = last_panel(trial);
  CHECK(p.resolution == Approx(0.005));
  CHECK(p.grain_angle == Approx(-M_PI / 4));
  CHECK(p.label == "arm");
  CHECK(last_panel(Trial(panel(kSquare, "  grain +y\n"))).grain_angle == 0);
  refuses(panel(kSquare, "  resolution «20 cm»\n"), "G0409", "1 mm .. 10 cm");
  refuses(panel(kSquare, "  resolution «5»\n"), "G0308", "5 cm");
  refuses(panel(kSquare, "  label «\"hat\"»\n"), "G0309");
  const Trial coarse(panel(kSquare, "  resolution 10 cm\n") + "p.resolution = 10 cm\n");
  CHECK(coarse.result.ok());
  const Trial narrow(kHead + "panel p of f { outline circle((0, 0), 15 mm) free; resolution 2 cm }\n");
  REQUIRE(narrow.result.diagnostics.size() == 1);
  CHECK(narrow.result.diagnostics[0].code == "G0410");
  CHECK(narrow.result.diagnostics[0].severity == Severity::warning);
}

TEST_CASE("like takes the statements again, with changes") {
  const std::string base = panel(
      kHalf, "  dart d on waist at 50% width 2 cm depth 8 cm\n  notch hip on side at 50%\n", "on fold cf");
  const Trial changed(base +
                      "panel q of f like p {\n  d.depth = 12 cm\n  rename cf as cb\n  rename side as flank\n "
                      " resolution = 5 mm\n"
                      "  dart d2 on flank at 20% width 1 cm depth 3 cm\n}\n");
  const design::Panel& q = last_panel(changed);
  CHECK(q.darts[0].depth == Approx(0.12));
  CHECK(q.darts.size() == 4);
  CHECK(q.resolution == Approx(0.005));
  CHECK(q.notches[0].edge == "left.flank");
  CHECK(changed.result.garment.panels[0].darts[0].depth == Approx(0.08));

  const Trial removed(
      base +
      "panel q of f like p {\n  remove d, hip\n  replace edge waist to (0, 35 cm) tangents end -x free\n}\n");
  CHECK(last_panel(removed).darts.empty());
  CHECK(edge(last_panel(removed), "left.waist").end().y() == Approx(0.35));

  const Trial mirrored(
      panel("    edge a to (20 cm, 0) free\n    edge b to (0, 30 cm) free\n    close c free\n",
            "  grain 30 deg\n") +
      "panel q like p mirrored { }\n");
  CHECK(last_panel(mirrored).edges[0].curve.end().x() == Approx(-0.2));
  CHECK(last_panel(mirrored).grain_angle == Approx(-mirrored.result.garment.panels[0].grain_angle));

  refuses(base + "panel q like p {\n  rename «dd» as e\n}\n", "G0416", "did you mean `d`?");
  refuses(base + "panel q like p {\n  remove «sid»\n}\n", "G0416", "did you mean `side`?");
  refuses(base + "panel q like p {\n  «d.deep» = 3 cm\n}\n", "G0311");
  refuses(base + "panel q like «r» { }\n", "G0301");
  refuses(panel(kSquare, "  «rename» top as bottom\n"), "G0322");
  refuses(kHead + "panel p like q { }\npanel q like «p» { }\n", "G0304");
}

TEST_CASE("assignments from outside") {
  const std::string base = panel(kHalf, "  dart d on waist at 50% width 2 cm depth 8 cm\n", "on fold cf");
  CHECK(last_panel(Trial(base + "p.d.depth = 11 cm\np.resolution = 5 mm\n")).darts[0].depth == Approx(0.11));
  CHECK(Trial(base + "f.W = 300 g/m^2\n").result.garment.fabrics[0].areal_density == Approx(0.3));
  CHECK(
      Trial(base + "f.bend = 3 * fabrics.poplin.bend_warp\n").result.garment.fabrics[0].bending_rigidity[1] ==
      Approx(3 * 5.884e-6).epsilon(1e-4));
  refuses(base + "«p.d.deep» = 11 cm\n", "G0311");
  refuses(base + "«p.resoltion» = 5 mm\n", "G0311");
  refuses(base + "p.d.depth = 11 cm\n«p.d.depth» = 12 cm\n", "G0321");
  refuses(base + "«q.d.depth» = 11 cm\n", "G0301");
  refuses(base + "«fabrics.poplin.W» = 1 g/m^2\n", "G0311", "with");
}

TEST_CASE("loops and conditions inside panels") {
  const Trial trial(
      panel(kSquare, "  for i in 1 .. 3 { notch n_{i} on top at i * 4 cm }\n  if 2 > 1 { grain +x }\n"));
  CHECK(last_panel(trial).notches.size() == 3);
  CHECK(last_panel(trial).grain_angle == Approx(-M_PI / 2));
  const Trial gores(kHead + "for i in 1 .. 4 {\n  panel gore_{i} of f {\n    outline from (0, 0) {\n" +
                    kSquare + "    }\n  }\n}\nseam s_one: gore_1.right_side to gore_2.left_side\n");
  REQUIRE(gores.result.ok());
  CHECK(gores.result.garment.panels.size() == 4);
  CHECK(gores.result.garment.panels[2].name == "gore_3");
}
