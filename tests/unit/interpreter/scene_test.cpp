// What holds, pushes and moves; parts; studies: how they are carried into the declared garment.
#include "interpreter/language/unparse.hpp"
#include "tests/unit/interpreter/support.hpp"

using namespace garment;
using namespace garment::interpreter;
using namespace garment::interpreter::test;

namespace {

const std::string kScene = R"(use fabrics
fabric shell = fabrics.satin
fabric inner = fabrics.habotai
body ball = sphere(10 cm) at (0, 50 cm, 0)
panel cloth of shell {
  outline from (0, 0) {
    edge bottom to (10 cm, 0) free
    edge right_side to (10 cm, 10 cm) free
    edge top to (0, 10 cm) free
    close left_side free
  }
}
panel other of inner like cloth { }
place cloth flat at (0, 1 m, 0) start folded
place other flat at (0, 2 m, 0)
path lift of ball { pose at 1 s; pose at 2 s move (0, 10 cm, 0) turn (0, 90 deg, 0) }
path pull { pose at 500 ms move (0, 0, 1 cm) }
clamp jaw: cloth.top[2 cm .. 8 cm] path pull
force weight on cloth at cloth.bottom.middle of (0, -2 N, 0)
pressure blown on other of -20 Pa
constrain distance cloth.top.start to other.at((1 cm, 2 cm)) of 4 cm
constrain on_plane cloth.top.start through (0, 1 m, 0) normal (0, 0, 2)
friction ball shell 0.25
friction shell inner 0.4
wind (0, 0, 5 m/s) gust 20%
drag 1.2
solver implicit step 1 ms hysteresis on
)";

}  // namespace

TEST_CASE("the scene is carried into the declared garment") {
  const Trial trial(kScene);
  accepts(trial);
  const design::Scene& scene = trial.result.garment.scene;
  REQUIRE(scene.paths.size() == 2);
  CHECK(scene.paths[0].body == 0);
  REQUIRE(scene.paths[0].poses.size() == 3);  // it stands at 0 s before the first one said
  CHECK(scene.paths[0].poses[1].move == Eigen::Vector3d::Zero());
  CHECK(scene.paths[0].poses[2].time == 2);
  CHECK(scene.paths[0].poses[2].turn.y() == Approx(1.5707963267948966));
  CHECK(scene.paths[1].body == -1);
  REQUIRE(scene.clamps.size() == 1);
  CHECK(scene.clamps[0].path == 1);
  REQUIRE(scene.clamps[0].parts.size() == 1);
  CHECK(scene.clamps[0].parts[0].from == Approx(0.02));
  CHECK(scene.clamps[0].parts[0].to == Approx(0.08));
  REQUIRE(scene.forces.size() == 1);
  CHECK(scene.forces[0].point.x() == Approx(0.05));
  CHECK(scene.forces[0].newtons == Eigen::Vector3d(0, -2, 0));
  REQUIRE(scene.pressures.size() == 1);
  CHECK(scene.pressures[0].panel == 1);
  CHECK(scene.pressures[0].pascals == -20);
  REQUIRE(scene.constraints.size() == 2);
  CHECK(scene.constraints[0].b.panel == 1);
  CHECK(scene.constraints[0].length == Approx(0.04));
  CHECK(scene.constraints[1].along == Eigen::Vector3d::UnitZ());
  REQUIRE(scene.frictions.size() == 2);
  CHECK(scene.frictions[0].body == 0);
  CHECK(scene.frictions[0].fabric == 0);
  CHECK(scene.frictions[1].other_fabric == 1);
  REQUIRE(scene.wind);
  CHECK(scene.wind->gust == Approx(0.2));
  CHECK(*scene.drag == 1.2);
  REQUIRE(scene.solver);
  CHECK(scene.solver->method == design::SolverChoice::Method::implicit);
  CHECK(scene.solver->step == Approx(1e-3));
  CHECK(scene.slides());
  CHECK(scene.slides_to_rest());
  CHECK(trial.result.garment.panels[0].placement.folded);
}

TEST_CASE("a printed scene says the same again") {
  const Trial first(kScene);
  accepts(first);
  UnparseOptions options;
  options.acts.clear();
  const std::string text = unparse(first.result.garment, options);
  INFO(text);
  const Trial second(text);
  accepts(second);
  CHECK(unparse(second.result.garment, options) == text);
  CHECK(second.result.garment.scene.paths[0].poses.size() == 3);
  CHECK(second.result.garment.scene.constraints.size() == 2);
  CHECK(second.result.garment.scene.slides_to_rest());
  CHECK(second.result.garment.panels[0].placement.folded);
}

TEST_CASE("a round of a study has the value and the acts of its block alone") {
  const std::string script = R"(use fabrics
param wide = 10 cm in 5 cm .. 30 cm
panel cloth of fabrics.satin {
  outline from (0, 0) {
    edge bottom to (wide, 0) free
    edge right_side by (0, 10 cm) free
    edge top by (-wide, 0) free
    close left_side free
  }
}
place cloth flat at (0, 1 m, 0)
measure across = length(cloth.bottom)
drape until rest
save "all.obj"
vary cloth.resolution over 5 mm, 8 mm { drape until rest settle preview }
vary wide over 12 cm, 20 cm { drape until rest settle exact; save "one.obj", "one.svg" }
)";
  const Trial whole(script);
  accepts(whole);
  REQUIRE(whole.result.acts.size() == 4);
  const auto* vary = std::get_if<VaryAct>(&whole.result.acts[3].act);
  REQUIRE(vary != nullptr);
  CHECK(vary->ordinal == 1);
  CHECK(vary->values == std::vector<std::string>{"12 cm", "20 cm"});
  InterpretOptions options;
  options.study = Study{1, "wide", "20 cm"};
  const Trial round(script, options);
  accepts(round);
  CHECK(round.result.measures[0].text == "20 cm");
  REQUIRE(round.result.acts.size() == 2);
  CHECK(std::get_if<DrapeAct>(&round.result.acts[0].act)->settle == simulator::Settle::exact);
  options.study = Study{0, "cloth.resolution", "8 mm"};
  const Trial finer(script, options);
  accepts(finer);
  CHECK(finer.result.garment.panels[0].resolution == Approx(8e-3));
  options.study = Study{1, "wide", "20 m"};
  CHECK_FALSE(Trial(script, options).result.ok());
}

TEST_CASE("parts bring in their panels under their names") {
  const Trial trial(R"(use fabrics
component strip(wide: length, high: length = 2 * wide) {
  panel piece of fabrics.satin {
    outline from (0, 0) {
      edge bottom to (wide, 0) free
      edge right_side by (0, high) free
      edge top by (-wide, 0) free
      close left_side free
    }
    place at (0, high, 0)
  }
  measure around = 2 * (wide + high)
  piece.resolution = 5 mm
}
use fabrics as cloths
part a = strip(10 cm)
part b = strip(high: 3 cm, wide: 8 cm)
b.wide = 9 cm
b.piece.resolution = 6 mm
)");
  const design::Garment& garment = trial.result.garment;
  INFO(trial.text());
  REQUIRE(garment.panels.size() == 2);
  CHECK(garment.panels[0].name == "a.piece");
  CHECK(garment.panels[0].resolution == Approx(5e-3));
  CHECK(garment.panels[1].name == "b.piece");
  CHECK(garment.panels[1].resolution == Approx(6e-3));
  REQUIRE(trial.result.measures.size() == 2);
  CHECK(trial.result.measures[0].text == "60 cm");
  CHECK(trial.result.measures[1].name == "b.around");
  CHECK(trial.result.measures[1].text == "24 cm");
}
