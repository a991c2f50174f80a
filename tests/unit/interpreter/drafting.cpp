// Drafting algebra against geometry worked out by hand.
#include "tests/unit/interpreter/support.hpp"

using namespace garment;
using namespace garment::interpreter;
using namespace garment::interpreter::test;

namespace {

double number_of(const std::string& expr, const std::string& before = "") {
  const Trial trial(before + "\nmeasure answer = " + expr + "\n");
  INFO(expr);
  INFO(trial.text());
  REQUIRE(trial.result.ok());
  REQUIRE(trial.result.measures.back().value);
  return *trial.result.measures.back().value;
}

/// A square of 40 cm with a round corner: 30 cm, quarter circle of radius 10 cm.
const char* const kPiece = R"(use fabrics
panel piece of fabrics.wool_suiting {
  outline from (0, 0) {
    edge hem to (40 cm, 0) free
    edge side by (0, 30 cm) free
    edge scye to (30 cm, 40 cm) arc radius -10 cm free
    edge top to (0, 40 cm) free
    close front free
  }
  notch mark on side at 12 cm
}
place piece flat at (0, 1 m, 0)
)";

}  // namespace

TEST_CASE("distances, angles and points along a way") {
  CHECK(value_of("distance((0, 0), (3 cm, 4 cm))") == "5 cm");
  CHECK(value_of("angle((0, 0), (3 cm, 3 cm))") == "45 deg");
  CHECK(value_of("angle(line((0, 0), (0, -2 cm)))") == "-90 deg");
  CHECK(value_of("angle((1 cm, 0), (0, 0), (0, 1 cm))") == "90 deg");
  CHECK(value_of("angle((1 cm, 1 mm), (0, 0), (1 cm, -1 mm)) < 12 deg") == "true");
  CHECK(value_of("polar((1 cm, 2 cm), +y, 3 cm)") == "(1 cm, 5 cm)");
  CHECK(value_of("polar((0, 0), -x, 3 cm)") == "(-3 cm, 0 cm)");
  CHECK(number_of("polar((0, 0), 60 deg, 10 cm).x") == Approx(0.05));
  CHECK(value_of("toward((0, 0), (30 cm, 0), 1/3)") == "(10 cm, 0 cm)");
  CHECK(value_of("toward((0, 0), (3 cm, 4 cm), 10 cm)") == "(6 cm, 8 cm)");
  CHECK(value_of("dot((1, 2), (3, 4))") == "11");
  CHECK(value_of("dot((1 cm, 2 cm), (3 cm, 4 cm))") == "11 cm^2");
  CHECK(value_of("length((3 cm, 4 cm))") == "5 cm");
}

TEST_CASE("curves: lengths, places and directions") {
  CHECK(value_of("length(line((0, 0), (3 cm, 4 cm)))") == "5 cm");
  CHECK(number_of("length(circle((0, 0), 10 cm))") == Approx(0.2 * 3.14159265358979));
  CHECK(number_of("length(arc((0, 0), (20 cm, 0), radius: 10 cm))") == Approx(0.1 * 3.14159265358979));
  CHECK(number_of("arc((0, 0), (20 cm, 0), bulge: 2 cm).middle.y") == Approx(0.02));
  CHECK(number_of("arc((0, 0), (20 cm, 0), through: (10 cm, -2 cm)).middle.y") == Approx(-0.02));
  CHECK(value_of("curve((0, 0), (20 cm, 0), through: [(5 cm, 3 cm), (15 cm, 3 cm)]).start") == "(0 cm, 0 cm)");
  CHECK(number_of("curve((0, 0), (20 cm, 0), control: (10 cm, 8 cm)).middle.y") == Approx(0.04));
  CHECK(number_of("tangent(curve((0, 0), (20 cm, 10 cm), start: +x, end: +y), 0)") == Approx(0).margin(1e-12));
  CHECK(value_of("tangent(line((0, 0), (1 cm, 1 cm)), 50%)") == "45 deg");
  CHECK(value_of("normal(line((0, 0), (1 cm, 0)), 0)") == "90 deg");
  CHECK(value_of("along(line((0, 0), (12 cm, 0)), 3 cm)") == "(3 cm, 0 cm)");
  CHECK(value_of("line((0, 0), (12 cm, 0)).at(1/4)") == "(3 cm, 0 cm)");
  CHECK(value_of("length(line((0, 0), (12 cm, 0))[1/4 .. 5 cm])") == "2 cm");
  CHECK(value_of("(line((0, 0), (12 cm, 0))[5 cm .. 2 cm]).end") == "(2 cm, 0 cm)");
  CHECK(value_of("length_to(line((0, 0), (12 cm, 0)), (5 cm, 0))") == "5 cm");
  CHECK(value_of("reverse(line((0, 0), (12 cm, 0))).start") == "(12 cm, 0 cm)");
  CHECK(value_of("(-line((0, 0), (12 cm, 0))).start") == "(12 cm, 0 cm)");
  CHECK(value_of("length(line((0, 0), (12 cm, 0)) + line((12 cm, 0), (12 cm, 5 cm)))") == "17 cm");
  CHECK(value_of("length(extended(line((0, 0), (12 cm, 0)), before: 1 cm, after: 2 cm))") == "15 cm");
}

TEST_CASE("edges are curves too") {
  CHECK(number_of("length(piece.scye)", kPiece) == Approx(0.05 * 3.14159265358979));
  CHECK(value_of("length(piece.side[0 .. 1/3])", kPiece) == "10 cm");
  CHECK(value_of("length(piece.side[mark .. end])", kPiece) == "18 cm");
  CHECK(value_of("piece.side.at(5 cm)", kPiece) == "(40 cm, 5 cm)");
  CHECK(value_of("foot((10 cm, 20 cm), piece.side)", kPiece) == "(40 cm, 20 cm)");
  CHECK(number_of("tangent(piece.scye, 0)", kPiece) == Approx(0.5 * 3.14159265358979));
  CHECK(value_of("intersection(piece.hem, line((10 cm, -1 cm), (10 cm, 1 cm)))", kPiece) == "(10 cm, 0 cm)");
  CHECK(value_of("intersection(piece.side + piece.scye, line((0, 30 cm), (50 cm, 30 cm)), which: 1)", kPiece) ==
        "(40 cm, 30 cm)");
  CHECK(number_of("length(offset(piece.scye, 2 cm))", kPiece) == Approx(0.04 * 3.14159265358979));
  CHECK(value_of("length(piece.side[0 .. 1/3] + line((40 cm, 10 cm), (44 cm, 13 cm)))", kPiece) == "15 cm");
}

TEST_CASE("feet, crossings and pieces") {
  CHECK(value_of("foot((5 cm, 3 cm), line((0, 0), (12 cm, 0)))") == "(5 cm, 0 cm)");
  CHECK(number_of("foot((20 cm, 0), circle((0, 0), 5 cm)).x") == Approx(0.05));
  CHECK(value_of("nearest((15 cm, 3 cm), line((0, 0), (12 cm, 0)))") == "(12 cm, 0 cm)");
  CHECK(value_of("intersection(line((0, 0), (8 cm, 8 cm)), line((0, 4 cm), (8 cm, 4 cm)))") == "(4 cm, 4 cm)");
  const std::string circle = "circle((0, 0), 5 cm), line((-9 cm, 3 cm), (9 cm, 3 cm))";
  CHECK(number_of("intersection(" + circle + ", which: 1).x") == Approx(0.04));
  CHECK(number_of("intersection(" + circle + ", which: 2).x") == Approx(-0.04));
  CHECK(number_of("intersection(" + circle + ", near: (-9 cm, 0)).x") == Approx(-0.04));
  CHECK(value_of("count(intersections(" + circle + "))") == "2");
  CHECK(value_of("count(intersections(circle((0, 0), 5 cm), line((-9 cm, 6 cm), (9 cm, 6 cm))))") == "0");
  CHECK(value_of("length(first_of(split(line((0, 0), (12 cm, 0)), 1/3)))") == "4 cm");
  CHECK(value_of("length(last_of(split(line((0, 0), (12 cm, 0)), (5 cm, 0))))") == "7 cm");
}

TEST_CASE("moving points and curves") {
  CHECK(value_of("mirror((3 cm, 1 cm), line((0, 0), (0, 10 cm)))") == "(-3 cm, 1 cm)");
  CHECK(value_of("mirror((3 cm, 1 cm), (0, 0), (1 cm, 0))") == "(3 cm, -1 cm)");
  CHECK(number_of("rotate((10 cm, 0), (0, 0), 90 deg).y") == Approx(0.1));
  CHECK(value_of("shift((1 cm, 0), (0, 2 cm))") == "(1 cm, 2 cm)");
  CHECK(value_of("shift(line((0, 0), (1 cm, 0)), (0, 2 cm)).end") == "(1 cm, 2 cm)");
  CHECK(value_of("last_of(shift([(0, 0), (1 cm, 0)], (0, 2 cm)))") == "(1 cm, 2 cm)");
  // A mirrored arc bulges to the other side.
  CHECK(number_of("mirror(arc((0, 0), (20 cm, 0), bulge: 2 cm), (0, 0), (1 cm, 0)).middle.y") == Approx(-0.02));
}

TEST_CASE("drafting that has no result is refused with its values") {
  refuses("let p = «intersection(line((0, 0), (1 cm, 0)), line((0, 1 cm), (1 cm, 1 cm)))»", "G0346", "1 cm of each other");
  refuses("let p = «intersection(circle((0, 0), 5 cm), line((-9 cm, 0), (9 cm, 0)))»", "G0347", "2 points");
  refuses("let l = line((0, 0), (1 cm, 0))\nlet p = «intersection(l, l)»", "G0345", "run along");
  refuses("let p = «foot((15 cm, 3 cm), line((0, 0), (12 cm, 0)))»", "G0344", "3 cm beyond its end");
  refuses("let p = split(line((0, 0), (12 cm, 0)), «(5 cm, 1 cm)»)", "G0344", "1 cm off the curve");
  refuses("let p = (1 cm, 0)\nlet c = «line(p, p)»", "G0341", "same point");
  refuses("let c = curve((0, 0), (3 cm, 0), through: «[(1 cm, 0), (1 cm, 0)]»)", "G0341", "fall together");
  refuses("let c = «curve((0, 0), (3 cm, 0))»", "G0307", "through");
  refuses("let c = arc((0, 0), (20 cm, 0), radius: «5 cm»)", "G0309", "10 cm at least");
  refuses("let c = arc((0, 0), (20 cm, 0), through: «(5 cm, 0)»)", "G0341", "on a line");
  refuses("let a = «angle((1 cm, 0), (1 cm, 0))»", "G0342", "no direction");
  refuses("let a = mirror((1 cm, 0), «circle((0, 0), 1 cm)»)", "G0343", "straight");
  refuses("let o = «offset(arc((0, 0), (2 cm, 0), bulge: 1 cm), -2 cm)»", "G0348", "tighter");
  refuses("let o = «line((0, 0), (1 cm, 0)) + line((2 cm, 0), (3 cm, 0))»", "G0340", "1 cm from where");
  refuses("let p = along(line((0, 0), (12 cm, 0)), «13 cm»)", "G0309", "12 cm long");
  refuses("let p = along(«3 cm», 1 cm)", "G0306", "takes a curve");
}
