// `solve`: values found by drawing panels for trial.
#include "tests/unit/interpreter/support.hpp"

using namespace garment;
using namespace garment::interpreter;
using namespace garment::interpreter::test;

namespace {

/// A cap whose height is solved for; `tail` follows.
std::string sleeve(const std::string& solve, const std::string& tail = "") {
  return R"(use fabrics
param wide = 34 cm in 20 cm .. 60 cm
let armhole = 46 cm
)" + solve + R"(
panel sleeve of fabrics.wool_suiting {
  outline from (0, 0) {
    edge cuff to (wide, 0) free
    edge seam_a to (wide, 40 cm) free
    edge cap to (0, 40 cm) through (wide / 2, 40 cm + cap_height) free
    close seam_b free
  }
}
)" + tail;
}

const SolvedValue& only_solved(const Trial& trial) {
  INFO(trial.text());
  REQUIRE(trial.result.ok());
  REQUIRE(trial.result.solved.size() == 1);
  return trial.result.solved[0];
}

}  // namespace

TEST_CASE("a cap is drawn to fit its armhole") {
  const Trial trial(sleeve("solve cap_height in 5 cm .. 30 cm so length(sleeve.cap) == 1.04 * armhole",
                           "measure cap = length(sleeve.cap)\n"));
  const SolvedValue& found = only_solved(trial);
  CHECK(found.name == "cap_height");
  CHECK(found.bound.empty());
  CHECK(std::fabs(found.residual_value) < 1e-9);
  CHECK(found.trials < 20);
  CHECK(*trial.result.measures[0].value == Approx(1.04 * 0.46).epsilon(1e-9));
  // The garment holds the last drawing only, and no other.
  CHECK(trial.result.garment.panels.size() == 1);
  CHECK(trial.result.garment.fabrics.size() == 1);
  CHECK(trial.result.garment.panels[0].edges[2].curve.length() == Approx(1.04 * 0.46).epsilon(1e-9));
}

TEST_CASE("it does not matter who asks first, or in which order it is written") {
  // `above` is asked before the solve, in the middle of its own evaluation, and the condition needs it.
  const Trial trial(sleeve("let above = 40 cm + cap_height\nlet doubled = 2 * above\n"
                           "solve cap_height in 5 cm .. 30 cm so doubled - 80 cm == 40 cm\n"));
  CHECK(only_solved(trial).value == Approx(0.2).epsilon(1e-12));
  const Trial panel_first(sleeve("", "solve cap_height in 5 cm .. 30 cm so length(sleeve.cap) == 1.04 * armhole\n"));
  const Trial solve_first(sleeve("solve cap_height in 5 cm .. 30 cm so length(sleeve.cap) == 1.04 * armhole\n"));
  CHECK(only_solved(panel_first).value == only_solved(solve_first).value);
}

TEST_CASE("plain equations, bounds and inequalities") {
  CHECK(only_solved(Trial("solve x in 0 .. 10 so x * x == 2")).value == Approx(std::sqrt(2.0)).epsilon(1e-12));
  CHECK(only_solved(Trial("solve x in 0 cm .. 10 cm so x * x == 2 cm^2")).text == "1.414214 cm");
  const Trial low("solve x in 3 .. 10 so x >= 2");
  CHECK(only_solved(low).bound == "low");
  CHECK(only_solved(low).value == 3);
  const Trial high("solve x in 3 .. 10 so x == 10");
  CHECK(only_solved(high).bound == "high");
  const Trial at_least("solve x in 0 .. 10 so x * x >= 2");
  CHECK(only_solved(at_least).value * only_solved(at_least).value >= 2);
  CHECK(only_solved(at_least).value == Approx(std::sqrt(2.0)).epsilon(1e-12));
  // Both ends lie on one side: the first root from the low end is found.
  CHECK(only_solved(Trial("solve x in 0 .. 10 so (x - 3) * (x - 5) == 0")).value == Approx(3).epsilon(1e-9));
}

TEST_CASE("solves that need each other") {
  const Trial chained("solve a in 0 .. 10 so a * a == 4\nsolve b in 0 .. 10 so b == a + 1\nmeasure c = b");
  REQUIRE(chained.result.ok());
  CHECK(*chained.result.measures[0].value == Approx(3).epsilon(1e-9));
  refuses("solve a in 0 .. 10 so a + b == 7\nsolve b in 0 .. 10 so b == a + 1\nmeasure c = a", "G1207", "need each other");
  refuses("solve a in 0 .. 1 so a == b\nsolve b in 0 .. 1 so b == c\nsolve c in 0 .. 1 so c == d\n"
          "solve d in 0 .. 1 so d == 0.5 * a + 0.1 * b + 0.1 * c + 0.1",
          "G1207", "3 deep");
}

TEST_CASE("what cannot be solved is told with both differences") {
  refuses(sleeve("solve cap_height in 5 cm .. 6 cm so «length(sleeve.cap) == 90 cm»"), "G1202", "less than the right one");
  refuses("solve cap in 5 cm .. 6 cm so «armhole == 30 cm»\nlet armhole = 46 cm", "G1203", "does not depend");
  refuses("solve n in 0 .. 9 so «round(n) == 4.5»", "G1204", "jumps");
  refuses("solve n in «9 .. 0» so n == 4", "G1201", "smaller to a larger");
  refuses("solve n in 0 .. 9 so «n»", "G1201", "comparison");
  refuses("solve n in «0 .. 9» so n == 4 cm", "G1205", "a plain number and a length");
  refuses("let n = q\nsolve q in 0 .. «n» so q == 4", "G0304", "needs itself");
  refuses("solve n in -4 .. 9 so sqrt(«n») == 2", "G0309", "square root of -4");
  refuses("solve n in 0 .. 9 so «strain(all) == n»", "G0325", "drape");
}

TEST_CASE("the same script gives the same value, bit for bit") {
  const std::string script = sleeve("solve cap_height in 5 cm .. 30 cm so length(sleeve.cap) == 1.04 * armhole");
  CHECK(only_solved(Trial(script)).value == only_solved(Trial(script)).value);
}
