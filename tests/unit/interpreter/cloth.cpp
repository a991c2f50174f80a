// Seams with their finishes, closures, layers, regions, ironing: what a script says arrives in the declared
// garment, and comes back from its text.
#include "interpreter/language/unparse.hpp"
#include "runtime/base/portable_math.hpp"
#include "tests/unit/interpreter/support.hpp"

using namespace garment;
using namespace garment::interpreter;
using namespace garment::interpreter::test;

namespace {

const std::string kPieces = R"(garment 1 "cloth"
use fabrics
panel one of fabrics.satin {
  outline from (0, 0) {
    edge bottom to (20 cm, 0) free
    edge right_side to (20 cm, 32 cm) free
    edge top to (0, 32 cm) free
    close left_side free
  }
  notch low on right_side at 10 cm
  notch high on right_side at 22 cm
}
panel two of fabrics.satin {
  outline from (0, 0) {
    edge bottom to (20 cm, 0) free
    edge right_side to (20 cm, 30 cm) free
    edge top to (0, 30 cm) free
    close left_side free
  }
}
panel half of fabrics.satin on fold cf {
  outline from (0, 0) {
    edge hem to (15 cm, 0) free
    edge side to (12 cm, 40 cm) free
    edge waist to (0, 40 cm) free
    close cf
  }
}
place one at (0, 1 m, 0)
place two at (21 cm, 1 m, 0)
place half at (60 cm, 1 m, 0)
)";

design::Garment declared(const std::string& more) {
  const Trial trial(kPieces + more);
  INFO(trial.text());
  REQUIRE(trial.result.ok());
  return trial.result.garment;
}

}  // namespace

TEST_CASE("a relation on part of a side arrives as the fullness of its parts") {
  const design::Garment g = declared("seam middle: one.right_side ease 20% [low .. high] to two.left_side\n");
  const design::SeamSide& side = g.seams[0].sides[0];
  REQUIRE(side.parts.size() == 3);
  CHECK(side.fullness == std::vector<double>{1, 1.2, 1});
  CHECK(side.parts[1].from == Approx(0.10));
  CHECK(side.parts[1].to == Approx(0.22));
  CHECK(g.seams[0].sides[1].fullness.empty());
  CHECK(g.seams[0].ratio == std::vector<double>{1, 1});
}

TEST_CASE("the second side of a seam has its relation the other way round") {
  const design::Garment g =
      declared("seam middle: two.left_side to one.right_side ease 20% [start .. 12 cm]\n");
  const design::SeamSide& side = g.seams[0].sides[1];
  REQUIRE(side.parts.size() == 2);  // against the loop: from the drawn end
  CHECK(side.parts[0].from == Approx(0.32));
  CHECK(side.fullness == std::vector<double>{1, 1.2});
}

TEST_CASE("a seam carries how it is made up, with what is assigned") {
  const design::Garment g = declared(
      "seam middle: one.right_side ease 7% to two.left_side fold 90 deg to face ironed toward two.left_side\n"
      "  tension -2% slack 3 mm stiffness 3 allowance 1 cm\n"
      "middle.allowance = 2 cm\nmiddle.ease = 20/3 * 1%\n");
  const design::SeamFinish& f = g.seams[0].finish;
  REQUIRE(f.fold_angle);
  CHECK(*f.fold_angle == Approx(portable::kPi / 2));
  CHECK(f.fold_to == design::Facing::face);
  CHECK(f.ironed == design::SeamFinish::Ironed::toward);
  CHECK(f.ironed_toward == 1);
  CHECK(f.tension == Approx(-0.02));
  CHECK(f.slack == Approx(0.003));
  CHECK(f.stiffness == 3);
  CHECK(*f.allowance == Approx(0.02));
  CHECK(g.seams[0].ratio[0] == Approx(32.0 / 30));
}

TEST_CASE("a relation may be assigned to a seam that has none") {
  const design::Garment g =
      declared("seam middle: one.right_side to two.left_side\nmiddle.gather = 32 / 30\n");
  CHECK(g.seams[0].ratio[0] == Approx(32.0 / 30));
}

TEST_CASE("rings begin where the seam says") {
  const std::string tubes =
      "seam tube_one: one.right_side to one.left_side\nseam tube_two: two.right_side to two.left_side\n";
  const design::Garment plain = declared(tubes + "seam joint: one.top to two.bottom\n");
  CHECK(plain.seams[2].sides[0].closed);
  CHECK(plain.seams[2].sides[1].closed);
  const design::Garment turned =
      declared(tubes + "seam joint: one.top to two.bottom start at one.top.middle, tube_two\n");
  const design::SeamSide& side = turned.seams[2].sides[0];
  REQUIRE(side.parts.size() == 2);
  CHECK(side.parts[0].from == Approx(0.1));
  CHECK(side.parts[0].to == Approx(0.2));
  CHECK(side.parts[1].from == Approx(0));
  CHECK(side.parts[1].to == Approx(0.1));
  CHECK(turned.seams[2].sides[1].parts.size() == 1);
}

TEST_CASE("layers are numbered from their panel outwards, whatever their order in the script") {
  const design::Garment g = declared(
      "layer felt of fabrics.linen on one basted above canvas\n"
      "layer canvas of fabrics.linen on one fused above net grain 45 deg\n"
      "layer net of fabrics.linen on one fused\n"
      "layer cover of fabrics.linen on one basted side face\n");
  CHECK(g.layers[0].order == 2);
  CHECK(g.layers[1].order == 1);
  CHECK(g.layers[2].order == 0);
  CHECK(g.layers[3].order == 0);
  CHECK(g.layers[1].grain_angle == Approx(-portable::kPi / 4));
  CHECK(g.layers[2].grain_angle == Approx(0).margin(1e-12));
}

TEST_CASE("a zip runs from the drawn start of its first side, the other side against it") {
  const design::Garment g = declared("zip fly: one.right_side[start .. 30 cm] to two.left_side open 30%\n");
  CHECK(g.zips[0].sides[0][0].from == Approx(0));
  CHECK(g.zips[0].sides[1][0].from == Approx(0.3));  // of `two` the left side is drawn downwards
  CHECK(g.zips[0].open == Approx(0.3));
}

TEST_CASE("regions of a panel on the fold hold for both halves, those of a half for it alone") {
  const design::Garment g = declared(
      "region both_sides in half: within 3 cm of side\nregion one_side in half.left: within 3 cm of side\n"
      "region named in half: within 3 cm of half.right.side\nregion spot in half: circle((8 cm, 20 cm), 2 "
      "cm)\n");
  const design::Panel& panel = g.panels[2];
  auto in = [&](std::size_t region, double x, double y) {
    return design::RegionTest(panel, g.regions[region].parts[0].shape).contains({x, y});
  };
  CHECK(in(0, 0.13, 0.1));
  CHECK(in(0, -0.13, 0.1));
  CHECK_FALSE(in(0, 0, 0.1));
  CHECK(in(1, 0.13, 0.1));
  CHECK_FALSE(in(1, -0.13, 0.1));
  CHECK_FALSE(in(2, 0.13, 0.1));
  CHECK(in(2, -0.13, 0.1));
  CHECK(in(3, 0.08, 0.2));
  CHECK(in(3, -0.08, 0.2));
}

TEST_CASE("FAST figures become those of the cloth by the laboratory's own formulas") {
  const design::Garment g = declared(
      "fabric wool = { W = 168 g/m^2, T2 = 0.5 mm, E5 = 0.67%, E20 = 1.87%, E100 = 4.6%, EB5 = 4.7%, c_warp "
      "= 15 mm,\n"
      "  c_weft = 14.5 mm }\npanel three of wool like one { }\n");
  const design::Fabric* wool = nullptr;
  for (const design::Fabric& f : g.fabrics)
    if (f.name == "wool") wool = &f;
  REQUIRE(wool != nullptr);
  CHECK(wool->bending_rigidity[0] == Approx(5.56e-6).epsilon(1e-3));
  CHECK(wool->bending_rigidity[1] == Approx(5.02e-6).epsilon(1e-3));
  CHECK(wool->shear_rigidity == Approx(26.17).epsilon(1e-3));
  CHECK(wool->tensile[0].max_force == Approx(98.0665));
  CHECK(wool->tensile[0].max_strain == Approx(0.046));
  CHECK(wool->tensile[0].linearity ==
        Approx(0.785).margin(0.06));  // stdlib's figure, from straight lines between points
}

TEST_CASE("a garment of all these comes back from its text, and its text stays") {
  const design::Garment g =
      declared(R"(seam middle: one.right_side ease 20% [low .. high] to two.left_side lapped 1 cm
hem low_hem on one.bottom turn 3 cm to face
zip fly: half.left.side to half.right.side open 25%
button top on one at (5 cm, 20 cm) through two at (6 cm, 20 cm) through half at (3 cm, 10 cm) mass 2 g kind snap
region edge_part in one, two: within 3 cm of top or circle((5 cm, 5 cm), 2 cm)
region spot in half: (within(3 cm, side) and above(10 cm)) minus circle((8 cm, 20 cm), 2 cm)
region corner in one: not left_of(top[5 cm .. end]) or polygon((0, 0), (5 cm, 0), (0, 5 cm))
spot.bend = 2
spot.mass = 1.25
tack hold: one to two in edge_part
layer felt of fabrics.linen on one basted above canvas
layer canvas of fabrics.linen on one in corner fused grain 45 deg
pad shoulder on half at (5 cm, 30 cm) radius 4 cm thickness 1 cm, 5 mm, 0
iron crease along one.bottom fold 90 deg to face radius 2 mm set 70% factor 0.5
iron pressed in spot shrink warp 1% weft 2%
iron rolled in corner curl radius 5 cm about one.top
starch corner factor 2
panel lining of fabrics.satin like two under two { }
)");
  const std::string text = unparse(g);
  INFO(text);
  InterpretOptions options;
  const Trial again(text, options);
  INFO(again.text());
  REQUIRE(again.result.ok());
  const design::Garment& back = again.result.garment;
  CHECK(unparse(back) == text);
  REQUIRE(back.regions.size() >= g.regions.size());
  for (const design::Region& region : g.regions)
    for (const design::Region& other : back.regions) {
      if (other.name != region.name) continue;
      CHECK(other.factors == region.factors);
      REQUIRE(other.parts.size() == region.parts.size());
      for (std::size_t k = 0; k < region.parts.size(); ++k) {
        const std::size_t p = static_cast<std::size_t>(region.parts[k].panel);
        const design::RegionTest one(g.panels[p], region.parts[k].shape),
            two(back.panels[p], other.parts[k].shape);
        for (double x = -0.155; x < 0.21; x += 0.0071)
          for (double y = 0.0011; y < 0.4; y += 0.0083) CHECK(one.contains({x, y}) == two.contains({x, y}));
      }
    }
  CHECK(back.seams[0].finish == g.seams[0].finish);
  CHECK(back.seams[0].sides[0].fullness == g.seams[0].sides[0].fullness);
  CHECK(back.buttons[0].holes.size() == 2);
  CHECK(back.zips[0].sides[1][0].from == Approx(g.zips[0].sides[1][0].from));
  CHECK(back.presses.size() == 3);
  CHECK(back.presses[0].angle == Approx(g.presses[0].angle));
  CHECK(back.stackings.size() == 1);
  CHECK(back.layers[0].order == g.layers[0].order);
}

TEST_CASE("nothing holds up what is neither attached nor lies on anything") {
  const Trial falls(kPieces + "drape until rest\n");
  int warned = 0;
  for (const auto& d : falls.result.diagnostics) warned += d.code == "G0515";
  CHECK(warned == 3);
  const Trial held(kPieces + "pin p on one at one.top.start\npin q on two at two.top.start\npin r on half at (0, 40 cm)\n" +
                   "drape until rest\n");
  for (const auto& d : held.result.diagnostics) CHECK(d.code != "G0515");
}

TEST_CASE("a picture on cloth is carried, and said not to be drawn") {
  const Trial trial("use fabrics\nfabric shirt = fabrics.poplin pattern \"check.png\" repeat 5 cm\n", {},
                    {{"check.png", "PNG"}});
  CHECK(trial.result.ok());
  REQUIRE(trial.result.diagnostics.size() == 1);
  CHECK(trial.result.diagnostics[0].code == "G0460");
  CHECK(trial.result.garment.fabrics[0].pattern == "check.png");
  CHECK(trial.result.garment.fabrics[0].pattern_repeat == Approx(0.05));
}
