// Lines, points, holes, slits, pairs, pleats, allowances, and darts that do not open on an edge.
#include <cmath>

#include "tests/unit/interpreter/support.hpp"

using namespace garment;
using namespace garment::interpreter;
using namespace garment::interpreter::test;

namespace {

/// A panel p, 20 cm by 30 cm, with this in its block and that below it.
std::string square(const std::string& inside, const std::string& below = "") {
  return "use fabrics\nfabric f = fabrics.poplin\npanel p of f {\n  outline from (0, 0) {\n    edge bottom to (20 cm, 0) "
         "free\n    edge right_side to (20 cm, 30 cm) free\n    edge top to (0, 30 cm) free\n    close left_side free\n"
         "  }\n  " +
         inside + "\n}\n" + below;
}

/// Half a panel p on the fold `middle`, 20 cm by 30 cm.
std::string half(const std::string& inside, const std::string& below = "") {
  return "use fabrics\nfabric f = fabrics.poplin\npanel p of f on fold middle {\n  outline from (0, 0) {\n    edge hem to "
         "(20 cm, 0) free\n    edge side to (20 cm, 30 cm) free\n    edge waist to (0, 30 cm) free\n    close middle\n"
         "  }\n  " +
         inside + "\n}\n" + below;
}

double loop_area(const design::Panel& p, const design::Hole& hole) {
  double area = 0;
  for (int k = hole.first; k < hole.first + hole.count; ++k)
    area += p.hole_edges[static_cast<std::size_t>(k)].curve.area_term();
  return area;
}

}  // namespace

TEST_CASE("what does not lie in the cloth is refused, each with its code") {
  refuses(square("line l from (1 cm, 1 cm) to (9 cm, 1 cm)\n  dart d «on l» width 1 cm depth 1 cm"), "G0418");
  refuses(square("hole «h» circle((19 cm, 5 cm), 2 cm)"), "G0419");
  refuses(square("hole g circle((5 cm, 5 cm), 2 cm) free\n  hole «h» circle((7 cm, 5 cm), 2 cm) free"), "G0420");
  refuses(square("line «l» from (1 cm, 1 cm) to (25 cm, 1 cm)"), "G0421");
  refuses(square("point «q» at (1 cm, -1 cm)"), "G0422");
  refuses(square("line l from (0, 1 cm) to (9 cm, 1 cm)\n  slit «s» along l"), "G0423");
}

TEST_CASE("what takes cloth in must fit, each with its code") {
  refuses(square("pleat p on top underlay 1 cm count 3 «every 1 cm»"), "G0424", "`every 2 cm` would fit");
  const Trial notch(square("notch n on top at 10 cm\n  pleat p on top at 10 cm underlay 1 cm"));
  CHECK(notch.text().find("G0425") != std::string::npos);
  CHECK(notch.result.ok());
  refuses(square("dart «d» inside from (1 cm, 1 cm) to (1 cm, 29 cm) width 3 cm"), "G0426");
  refuses(square("dart «d» inside from (5 cm, 5 cm) to (6 cm, 5 cm) width 3 cm"), "G0427");
  refuses(square("dart «d»: bottom to top"), "G0428");
  refuses(square("line l from (1 cm, 1 cm) to (9 cm, 1 cm)\n  allowance 1 cm «on l»"), "G0430");
}

TEST_CASE("the help for unequal legs names the place that fits") {
  const std::string script =
      "use fabrics\nfabric f = fabrics.poplin\npanel p of f {\n  outline from (0, 0) {\n    edge bottom to (20 cm, 0) "
      "free\n    edge right_side to (20 cm, 30 cm) free\n    edge top_1 to (A, 30 cm) free\n    edge leg_a to (10 cm, 20 "
      "cm)\n    edge leg_b to (9 cm, 30 cm)\n    edge top_2 to (0, 30 cm) free\n    close left_side free\n  }\n  dart «d»: "
      "leg_a to leg_b\n}\n";
  auto with = [&](const std::string& a) {
    std::string text = script;
    return text.replace(text.find("A,"), 1, a);
  };
  refuses(with("13 cm"), "G0429", "let `leg_a` start at");
  accepts(Trial(with("11 cm")));
}

TEST_CASE("allowances that meet in a narrow cut-out are refused") {
  auto script = [](const std::string& width) {
    return "use fabrics\nfabric f = fabrics.poplin\npanel p of f {\n  outline from (0, 0) {\n    edge bottom to (20 cm, 0) "
           "free\n    edge right_side to (20 cm, 30 cm) free\n    edge top_1 to (11 cm, 30 cm) free\n    edge down to (11 "
           "cm, 10 cm) free\n    edge across to (9 cm, 10 cm) free\n    edge up to (9 cm, 30 cm) free\n    edge top_2 to "
           "(0, 30 cm) free\n    close left_side free\n  }\n  allowance " +
           width + "\n}\n";
  };
  refuses(script("15 mm"), "G0431", "1 cm on each would fit");
  accepts(Trial(script("9 mm")));
}

TEST_CASE("lines and points of a half are there twice, and joined where they meet the fold") {
  const Trial trial(half("line yoke from (20 cm, 20 cm) to (0, 20 cm) bulge 1 cm\n  line centre from (0, 2 cm) to (0, 9 cm)\n"
                         "  point q at (5 cm, 5 cm)\n  point m at (0, 5 cm)",
                         "let whole = length(p.yoke) - length(p.left.yoke) - length(p.right.yoke)\nassert whole == 0 cm\n"
                         "assert p.yoke.middle == (0, 20 cm) within 1 um\nassert p.right.q == (-5 cm, 5 cm)\n"
                         "assert length(p.centre) == 7 cm\nassert p.m == (0, 5 cm)\n"));
  const design::Panel& p = last_panel(trial);
  CHECK(p.lines.size() == 3);
  CHECK(p.points.size() == 3);
  CHECK((p.lines[0].curve.point_at(0.05) - design::Point2(-p.lines[1].curve.point_at(0.05).x(),
                                                          p.lines[1].curve.point_at(0.05).y()))
            .norm() < 1e-12);
}

TEST_CASE("a hole with an edge on the fold becomes one hole of twice its area") {
  const Trial trial(half("hole h from (0, 10 cm) { edge a to (4 cm, 12 cm) bulge -5 mm\n    edge b to (0, 16 cm)\n    close c\n"
                         "  }\n  hole eye circle((12 cm, 8 cm), 2 cm)"));
  const design::Panel& p = last_panel(trial);
  REQUIRE(p.holes.size() == 3);
  CHECK(p.holes[0].name == "h");
  CHECK(p.holes[0].count == 4);
  for (int k = 0; k < 4; ++k) {  // each edge starts where the one before it ends
    const auto& here = p.hole_edges[static_cast<std::size_t>(k)].curve;
    const auto& next = p.hole_edges[static_cast<std::size_t>((k + 1) % 4)].curve;
    CHECK((here.end() - next.start()).norm() < 1e-12);
  }
  const Trial open(square("hole h from (0.1 cm, 10 cm) { edge a to (4.1 cm, 12 cm) bulge -5 mm\n    edge b to (0.1 cm, 16 "
                          "cm)\n    close c\n  }"));
  CHECK(std::fabs(loop_area(p, p.holes[0])) ==
        Approx(2 * std::fabs(loop_area(last_panel(open), last_panel(open).holes[0]))).epsilon(1e-9));
  CHECK(loop_area(p, p.holes[1]) == Approx(M_PI * 4e-4));
  CHECK(loop_area(p, p.holes[2]) == Approx(-M_PI * 4e-4));
}

TEST_CASE("pleats and tucks shorten the sewn edge by what they fold away") {
  accepts(Trial(square("pleat k on top at 4 cm underlay 1 cm count 2 every 5 cm\n  pleat b on bottom box underlay 2 cm\n  "
                       "tuck t on right_side width 5 mm count 3",
                       "assert length(p.top) == 16 cm\nassert length(p.bottom) == 12 cm\nassert length(p.right_side) == 27 "
                       "cm\nassert cut_length(p.top) == 20 cm\nassert length(p.top[start .. 5 cm]) == 3 cm\n")));
}

TEST_CASE("halves fold their pleats to the same side of the wearer") {
  const Trial trial(half("pleat k on waist at 4 cm underlay 1 cm count 2 every 5 cm toward -x"));
  const design::Panel& p = last_panel(trial);
  REQUIRE(p.pleats.size() == 2);
  for (const design::Pleat& pleat : p.pleats)
    for (const design::Edge& e : p.edges) {
      if (e.name != pleat.edge) continue;
      const double side = pleat.name == "left.k" ? 1 : -1;
      const bool left = side > 0;  // the image is walked the other way
      CHECK(e.curve.point_at(pleat.at).x() == Approx(side * (left ? 0.16 : 0.11)));
      CHECK(e.curve.point_at(pleat.at + pleat.spacing).x() == Approx(side * (left ? 0.11 : 0.16)));
      CHECK(e.curve.tangent_at(pleat.at).x() * pleat.toward == Approx(-side));
    }
}

TEST_CASE("holes and darts inside are no cloth") {
  accepts(Trial(square("hole h circle((5 cm, 20 cm), 2 cm)\n  dart d inside from (10 cm, 5 cm) to (10 cm, 25 cm) width 2 cm",
                       "assert area(p) == 600 cm^2 - 20 cm^2 - pi * 4 cm^2 within 0.1 mm^2\n")));
}

TEST_CASE("allowances: all edges, one edge, and the edge's own word") {
  const Trial trial(
      "use fabrics\nfabric f = fabrics.poplin\npanel p of f {\n  outline from (0, 0) {\n    edge a to (20 cm, 0) allowance 3 "
      "cm free\n    edge b to (20 cm, 30 cm) free\n    edge c to (0, 30 cm) free\n    close d free\n  }\n  allowance 0 cm on "
      "b\n  allowance 1 cm\n}\np.a.allowance = 4 cm\n");
  const design::Panel& p = last_panel(trial);
  CHECK(p.edges[0].allowance == Approx(0.04));
  CHECK(p.edges[1].allowance == 0);
  CHECK(p.edges[2].allowance == Approx(0.01));
}

TEST_CASE("a pair is a panel and its image, and `both` speaks of each side") {
  const Trial trial(
      "use fabrics\nfabric f = fabrics.poplin\npair panel sl of f {\n  outline from (0, 0) {\n    edge hem to (20 cm, 0)\n    "
      "edge under to (20 cm, 30 cm)\n    edge cap to (0, 30 cm) bulge -2 cm free\n    close over free\n  }\n  grain 80 "
      "deg\n}\npair panel cuff of f {\n  outline from (0, 0) {\n    edge low to (20 cm, 0) free\n    edge right_end to (20 "
      "cm, 6 cm)\n    edge high to (0, 6 cm)\n    close left_end free\n  }\n}\nboth seam wrist: sl.hem to cuff.high\nseam "
      "both_unders: sl.left.under to sl.right.under\nsl.hem.free = 1\n");
  CHECK_FALSE(trial.result.ok());  // `free` stands alone
  const Trial good(
      "use fabrics\nfabric f = fabrics.poplin\npair panel sl of f {\n  outline from (0, 0) {\n    edge hem to (20 cm, 0)\n    "
      "edge under to (20 cm, 30 cm)\n    edge cap to (0, 30 cm) bulge -2 cm free\n    close over free\n  }\n  grain 80 "
      "deg\n}\nseam both_unders: sl.left.under to sl.right.under\nsl.left.resolution = 5 mm\n");
  INFO(good.text());
  REQUIRE(good.result.ok());
  const auto& panels = good.result.garment.panels;
  REQUIRE(panels.size() == 2);
  CHECK(panels[0].name == "sl.left");
  CHECK(panels[1].name == "sl.right");
  CHECK(panels[0].grain_angle == Approx(-panels[1].grain_angle));
  CHECK(panels[1].edges[1].curve.end().x() == Approx(-0.2));
  CHECK(panels[0].resolution == Approx(5e-3));
  CHECK(panels[1].resolution == Approx(1e-2));
}

TEST_CASE("notches of one name come in one order, and meet") {
  auto script = [](const std::string& one, const std::string& two) {
    return "use fabrics\nfabric f = fabrics.poplin\npanel a of f {\n  outline from (0, 0) {\n    edge low to (20 cm, 0) "
           "free\n    edge outer to (20 cm, 30 cm)\n    edge high to (0, 30 cm) free\n    close inner free\n  }\n  " +
           one +
           "\n}\npanel b of f {\n  outline from (0, 0) {\n    edge low to (20 cm, 0) free\n    edge outer to (20 cm, 30 cm) "
           "free\n    edge high to (0, 30 cm) free\n    close inner\n  }\n  " +
           two + "\n}\nseam middle: a.outer to b.inner\n";
  };
  const std::string ordered = "notch m on outer at 5 cm\n  notch n on outer at 20 cm";
  accepts(Trial(script(ordered, "notch n on inner at 10 cm\n  notch m on inner at 25 cm")));
  CHECK(Trial(script(ordered, "notch n on inner at 10 cm\n  notch m on inner at 25 cm")).text().find("G0438") ==
        std::string::npos);
  refuses(script(ordered, "notch n on inner at 25 cm\n  notch m on inner at 10 cm"), "G0432");
  const Trial apart(script(ordered, "notch n on inner at 9 cm"));
  accepts(apart);
  CHECK(apart.text().find("G0438") != std::string::npos);
}

TEST_CASE("what a whole script never uses is told, where it is asked for") {
  InterpretOptions options;
  options.warn_unused = true;
  const std::string script = "let a = 2 cm\nlet b = a\n";
  CHECK(Trial(script, options).text().find("`b` is declared and never used") != std::string::npos);
  CHECK(Trial(script, options).text().find("`a` is declared") == std::string::npos);
  CHECK(Trial(script).text().find("G0439") == std::string::npos);
}
