// The frame of a person says what the built body measures.
#include "runtime/body/frame.hpp"

#include <catch2/catch.hpp>


using namespace garment;

namespace {

design::Body woman() {
  design::Body body;
  body.name = "form";
  body.position = {0, 0.2, 0};
  design::Mannequin person;
  person.measures = {{"stature", 1.68},
                     {"bust_chest", 0.92},
                     {"underbust", 0.77},
                     {"waist", 0.76},
                     {"hip", 1.0},
                     {"neckcircumference", 0.326},
                     {"neckcircumferencebase", 0.371},
                     {"headcircumference", 0.562},
                     {"biacromialbreadth", 0.372},
                     {"bideltoidbreadth", 0.445},
                     {"sleeveoutseam", 0.562},
                     {"acromionradialelength", 0.321},
                     {"bicepscircumferenceflexed", 0.296},
                     {"wristcircumference", 0.158},
                     {"thighcircumference", 0.599},
                     {"lowerthighcircumference", 0.379},
                     {"calfcircumference", 0.37},
                     {"anklecircumference", 0.219},
                     {"crotchheight", 0.816},
                     {"trochanterionheight", 0.876},
                     {"waistheightomphalion", 1.02},
                     {"kneeheightmidpatella", 0.467},
                     {"cervicaleheight", 1.442},
                     {"acromialheight", 1.379},
                     {"axillaheight", 1.283},
                     {"chestheight", 1.216},
                     {"chestbreadth", 0.267},
                     {"chestdepth", 0.238},
                     {"waistbreadth", 0.29},
                     {"waistdepth", 0.201},
                     {"hipbreadth", 0.348},
                     {"buttockdepth", 0.236},
                     {"waistbacklength", 0.43}};
  body.shape = person;
  return body;
}

}  // namespace

TEST_CASE("a frame agrees with the surface that is built") {
  const design::Body declared = woman();
  const body::FrameResult made = body::make_frame(declared);
  REQUIRE(made.frame);
  CHECK(made.frame->levels.at("waist").girth == 0.76);
  CHECK(made.frame->lengths.at("back_length") == 0.43);
  const body::BodyResult built = body::build_body(declared, system_host(), "");
  REQUIRE(built.body);
  for (const auto& [name, level] : built.body->levels) {
    INFO(name);
    REQUIRE(made.frame->levels.contains(name));
    const body::FrameLevel& known = made.frame->levels.at(name);
    const bool tape = name != "shoulder" && name != "armpit" && name != "crotch" && name != "head";
    if (known.girth) CHECK(*known.girth == Approx(level.girth).margin(tape ? 0.001 : 0.03));
    if (known.height) CHECK(*known.height == Approx(level.height).margin(tape ? 0.002 : 0.04));
  }
  CHECK(made.frame->levels.size() == built.body->levels.size());
  for (const std::string& part : made.frame->parts) CHECK(built.body->parts.contains(part));
  CHECK(made.frame->parts.size() == built.body->parts.size());
}

TEST_CASE("only right mannequins have a frame") {
  design::Body body;
  body.shape = design::Sphere{0.1};
  CHECK_FALSE(body::make_frame(body).frame);
  CHECK(body::make_frame(body).findings.empty());
  body = woman();
  std::get<design::Mannequin>(body.shape).measures["waist"] = 5;
  const body::FrameResult wrong = body::make_frame(body);
  CHECK_FALSE(wrong.frame);
  REQUIRE(wrong.findings.size() == 1);
  CHECK(wrong.findings[0].code == "G0711");
}
