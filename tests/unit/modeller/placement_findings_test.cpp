// What the modeller says of placements that cannot be carried out. Scripts are refused earlier, by name and
// place; these are for garments that come from elsewhere.
#include <catch2/catch.hpp>

#include "runtime/base/host.hpp"
#include "runtime/modeller/modeller.hpp"
#include "tests/unit/modeller/garments.hpp"

namespace {

using namespace garment;

/// A ball of radius 25 cm, 1 m above the floor, that says it has a level and a torso of radius 2 cm.
body::Body odd_person() {
  design::Body declared;
  declared.name = "form";
  declared.shape = design::Sphere{0.25};
  declared.position = {0, 1, 0};
  body::BodyResult built = body::build_body(declared, system_host(), "");
  REQUIRE(built.body);
  built.body->levels["waist"] = {1, 0.13};
  built.body->levels["sky"] = {50, 0.13};
  body::Part torso;
  torso.name = "torso";
  for (double y : {0.8, 1.2}) {
    body::Section s;
    s.center = {0, y, 0};
    s.axis = {0, 1, 0};
    s.u = {0, 0, 1};
    s.v = {1, 0, 0};
    s.hull = {{0.02, 0}, {0, 0.02}, {-0.02, 0}, {0, -0.02}};
    torso.sections.push_back(s);
  }
  built.body->parts["torso"] = torso;
  return std::move(*built.body);
}

design::Garment garment_on(const char* part, const char* edge, const char* level) {
  design::Garment g;
  g.fabrics = {test::cloth()};
  g.panels = {test::rectangle("front", 0.1, 0.1, 0.02)};
  design::Placement& p = g.panels[0].placement;
  p.kind = design::Placement::Kind::on_part;
  p.body = "form";
  p.part = part;
  p.edge = edge;
  p.level = level;
  return g;
}

std::string codes_of(const design::Garment& g, const std::vector<body::Body>& bodies) {
  modeller::ModelResult built = modeller::build_model(g, bodies);
  std::string codes;
  for (const Finding& f : built.findings) {
    codes += f.code + " ";
    CHECK(f.message.find("front") + f.message.find("form") != 2 * std::string::npos);
    CHECK_FALSE(f.help.empty());
  }
  CHECK_FALSE(built.model);
  return codes;
}

}  // namespace

TEST_CASE("a placement names a level and an edge that are there") {
  const std::vector<body::Body> bodies{odd_person()};
  CHECK(codes_of(garment_on("front", "top", "hip"), bodies) == "G0601 ");
  CHECK(codes_of(garment_on("front", "collar", "waist"), bodies) == "G0602 ");
}

TEST_CASE("a placement needs a body, and the body its part") {
  CHECK(codes_of(garment_on("front", "top", "waist"), {}) == "G0605 ");
  CHECK(codes_of(garment_on("arm.left", "top", "waist"), {odd_person()}) == "G0606 ");
}

TEST_CASE("a placement above the head, and one that stays in the body") {
  body::Body scanned = odd_person();
  scanned.parts.clear();  // wrapped on what the surface has at these heights
  CHECK(codes_of(garment_on("front", "bottom", "sky"), {scanned}) == "G0603 ");
  CHECK(codes_of(garment_on("front", "top", "waist"), {odd_person()}) == "G0604 ");
}

TEST_CASE("a panel that nothing places") {
  design::Garment g;
  g.fabrics = {test::cloth()};
  g.panels = {test::rectangle("front", 0.1, 0.1, 0.02), test::rectangle("second", 0.1, 0.1, 0.02)};
  g.panels[0].placement = {};
  CHECK(codes_of(g, {}) == "G0607 ");
}
