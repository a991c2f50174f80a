#include "interpreter/language/unparse.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "grammar/source.hpp"
#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/interpret.hpp"
#include "interpreter/language/unparse_text.hpp"
#include "tests/unit/io/pattern_support.hpp"

using namespace garment;
using design::Point2;

namespace {

/// A host without files.
class NoFiles final : public Host {
 public:
  HostResult<std::string> read_file(const std::string&, std::uint64_t) override {
    return {std::nullopt, {"no files"}};
  }
  HostResult<bool> write_file(const std::string&, std::string_view) override {
    return {std::nullopt, {"no files"}};
  }
  double seconds() override { return 0; }
  bool interrupted() override { return false; }
  std::uint64_t peak_memory() override { return 0; }
};

body::BodyResult person(const design::Body& declared, Host&, const std::string&) {
  body::Body made;
  made.name = declared.name;
  made.mesh.vertices = {{0, 0, 0}, {0.1, 0, 0}, {0, 1.6, 0}, {0, 0, 0.1}};
  made.mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
  for (const char* level : {"waist", "bust", "neck"}) made.levels[level] = {1.0, 0.8};
  for (const char* part : {"torso", "arm.left"}) made.parts[part].name = part;
  return {made, {}};
}

/// What the script declares; fails the test, with its diagnostics, if it has errors.
design::Garment read_back(const std::string& script) {
  grammar::Sources sources;
  grammar::SourceId id = sources.add("printed.garment", script);
  NoFiles host;
  interpreter::InterpretOptions options;
  options.build_body = person;
  interpreter::Interpretation result = interpreter::interpret(sources, id, host, options);
  std::string said;
  for (const auto& d : result.diagnostics) said += grammar::render(d, sources, false);
  INFO(script << said);
  REQUIRE(result.ok());
  return result.garment;
}

std::string formatted(const std::string& script) {
  grammar::Sources sources;
  grammar::SourceId id = sources.add("printed.garment", script);
  return grammar::format(sources, id, interpreter::vocabulary()).text;
}

bool near(const Point2& a, const Point2& b) { return (a - b).norm() < 1e-9; }

bool same_shape(const geometry::Curve::Shape& a, const geometry::Curve::Shape& b) {
  if (a.index() != b.index()) return false;
  if (auto* q = std::get_if<geometry::Quadratic>(&a))
    return near(q->control, std::get<geometry::Quadratic>(b).control);
  if (auto* c = std::get_if<geometry::Cubic>(&a)) {
    auto& d = std::get<geometry::Cubic>(b);
    return near(c->control_1, d.control_1) && near(c->control_2, d.control_2);
  }
  if (auto* arc = std::get_if<geometry::Arc>(&a))
    return std::abs(arc->bulge - std::get<geometry::Arc>(b).bulge) < 1e-9;
  if (auto* t = std::get_if<geometry::Through>(&a)) {
    auto& u = std::get<geometry::Through>(b).points;
    if (t->points.size() != u.size()) return false;
    for (std::size_t i = 0; i < u.size(); ++i)
      if (!near(t->points[i], u[i])) return false;
  }
  return true;
}

void check_same(const design::Panel& a, const design::Panel& b) {
  INFO("panel " << a.name);
  CHECK(a.name == b.name);
  CHECK(a.label == b.label);
  CHECK(a.resolution == Approx(b.resolution).epsilon(1e-12));
  CHECK(std::abs(a.grain_angle - b.grain_angle) < 1e-10);
  REQUIRE(a.edges.size() == b.edges.size());
  for (std::size_t i = 0; i < a.edges.size(); ++i) {
    INFO("edge " << a.edges[i].name);
    CHECK(a.edges[i].name == b.edges[i].name);
    CHECK(a.edges[i].free == b.edges[i].free);
    CHECK(near(a.edges[i].curve.start(), b.edges[i].curve.start()));
    CHECK(near(a.edges[i].curve.end(), b.edges[i].curve.end()));
    CHECK(same_shape(a.edges[i].curve.shape(), b.edges[i].curve.shape()));
  }
  CHECK(a.placement.kind == b.placement.kind);
  CHECK((a.placement.translation - b.placement.translation).norm() < 1e-9);
  CHECK((a.placement.rotation - b.placement.rotation).cwiseAbs().maxCoeff() < 1e-11);
}

void check_same(const std::vector<design::EdgePart>& a, const std::vector<design::EdgePart>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i].panel == b[i].panel);
    CHECK(a[i].edge == b[i].edge);
    CHECK(std::abs(a[i].from - b[i].from) < 5e-9);
    CHECK(std::abs(a[i].to - b[i].to) < 5e-9);
  }
}

void check_same(const design::Garment& a, const design::Garment& b) {
  CHECK(a.title == b.title);
  CHECK((a.gravity - b.gravity).norm() < 1e-12);
  REQUIRE(a.panels.size() == b.panels.size());
  for (std::size_t i = 0; i < a.panels.size(); ++i) check_same(a.panels[i], b.panels[i]);
  REQUIRE(a.seams.size() == b.seams.size());
  for (std::size_t i = 0; i < a.seams.size(); ++i) {
    INFO("seam " << a.seams[i].name);
    CHECK(a.seams[i].name == b.seams[i].name);
    REQUIRE(a.seams[i].sides.size() == b.seams[i].sides.size());
    for (std::size_t k = 0; k < a.seams[i].sides.size(); ++k) {
      check_same(a.seams[i].sides[k].parts, b.seams[i].sides[k].parts);
      CHECK(std::abs(a.seams[i].ratio[k] - b.seams[i].ratio[k]) < 1e-12);
    }
  }
  REQUIRE(a.attachments.size() == b.attachments.size());
  for (std::size_t i = 0; i < a.attachments.size(); ++i) {
    check_same(a.attachments[i].parts, b.attachments[i].parts);
    CHECK(a.attachments[i].body == b.attachments[i].body);
    CHECK(a.attachments[i].level == b.attachments[i].level);
    CHECK(a.attachments[i].slide == b.attachments[i].slide);
  }
}

interpreter::UnparseOptions with_body() {
  interpreter::UnparseOptions options;
  options.body = "sphere(radius: 10 cm)";
  return options;
}

/// Rectangle of `width` x `height` metres from (0, 0), edges lower, right, upper, left.
design::Panel rectangle(const std::string& name, double width, double height) {
  design::Panel panel;
  panel.name = name;
  const Point2 corners[] = {{0, 0}, {width, 0}, {width, height}, {0, height}};
  const char* names[] = {"lower", "outer", "upper", "inner"};
  for (int i = 0; i < 4; ++i) {
    design::Edge edge;
    edge.name = names[i];
    edge.curve = geometry::Curve(corners[i], corners[(i + 1) % 4]);
    panel.edges.push_back(edge);
  }
  return panel;
}

design::Garment two_rectangles() {
  design::Garment garment;
  garment.title = "pair";
  garment.fabrics.push_back({});
  garment.fabrics[0].name = "cloth";
  garment.panels = {rectangle("one", 0.4, 0.6), rectangle("two", 0.4, 0.6)};
  return garment;
}

}  // namespace

TEST_CASE("numbers of a script are short and exact enough") {
  using namespace interpreter::text;
  CHECK(length(0.125) == "12.5 cm");
  CHECK(length(0) == "0");
  CHECK(length(-1e-13) == "0");
  CHECK(length(1.0 / 3) == "33.3333333333 cm");
  CHECK(point(Point2(0.1, -0.02)) == "(10 cm, -2 cm)");
  CHECK(angle_deg(90) == "90 deg");
  CHECK(angle_deg(1e-12) == "0");
  CHECK(in_quotes("a \"b\" {c}\n\\") == "\"a 'b' (c) /\"");
}

TEST_CASE("names that the language keeps are replaced") {
  std::set<std::string> taken;
  using interpreter::text::fresh_name;
  CHECK(fresh_name("front", "panel", taken) == "front");
  CHECK(fresh_name("front", "panel", taken) == "front_1");
  CHECK(fresh_name("cm", "panel", taken) == "cm_1");
  CHECK(fresh_name("seam", "panel", taken) == "seam_1");
  CHECK(fresh_name("sphere", "panel", taken) == "sphere_1");
  CHECK(fresh_name("left.side", "edge", taken) == "left_side");
  CHECK(fresh_name("", "edge", taken) == "edge_1");
  CHECK(fresh_name("2nd", "edge", taken) == "edge2nd");
  std::set<std::string> edges;
  CHECK(fresh_name("hem", "edge", edges, interpreter::text::is_kept_in_panel) == "hem");
  CHECK(fresh_name("to", "edge", edges, interpreter::text::is_kept_in_panel) == "to_1");
  CHECK(fresh_name("left", "edge", edges, interpreter::text::is_kept_in_panel) == "left_1");
}

TEST_CASE("a printed garment has the shape of a written one") {
  design::Garment garment = two_rectangles();
  garment.panels[0].edges[0].free = true;
  garment.seams.push_back(
      {"side", {}, {{{}, {{0, 1, 0, 0.6}}, false}, {{}, {{1, 3, 0.6, 0}}, false}}, {1, 1}});
  interpreter::UnparseOptions as_denim;
  as_denim.comments = {"from a file"};
  as_denim.fabric = "fabrics.denim";
  std::string script = interpreter::unparse(garment, as_denim);
  CHECK(script.starts_with(
      "# from a file\n\ngarment 1 \"pair\"\nuse fabrics\n\nfabric cloth = fabrics.denim\n\n"
      "panel one of cloth {\n  outline from (0, 0) {\n    edge lower to (40 cm, 0) free\n"));
  CHECK(script.find("    close inner\n  }\n}\n\npanel two of cloth {\n") != std::string::npos);
  CHECK(script.ends_with("\n\nseam side: one.outer to two.inner\n\ndrape until rest\n"));
}

TEST_CASE("seams of every kind come back") {
  design::Garment garment = two_rectangles();
  garment.panels.push_back(rectangle("long", 1.2, 0.1));
  // Plain, turned round as a whole, start to start, eased, a chain with a part.
  auto seam = [](std::string name, std::vector<design::EdgePart> a, std::vector<design::EdgePart> b,
                 double ratio) {
    return design::Seam{
        std::move(name), {}, {{{}, std::move(a), false}, {{}, std::move(b), false}}, {ratio, 1}};
  };
  SECTION("plain") { garment.seams = {seam("sew", {{0, 1, 0, 0.6}}, {{1, 3, 0.6, 0}}, 1)}; }
  SECTION("reversed") { garment.seams = {seam("sew", {{0, 1, 0, 0.6}}, {{1, 3, 0, 0.6}}, 1)}; }
  SECTION("parts") { garment.seams = {seam("sew", {{0, 1, 0.1, 0.45}}, {{1, 3, 0.55, 0.2}}, 1)}; }
  SECTION("gather") { garment.seams = {seam("sew", {{2, 0, 0, 1.2}}, {{0, 2, 0.4, 0}}, 3)}; }
  SECTION("ease") { garment.seams = {seam("sew", {{0, 1, 0, 0.6}}, {{1, 3, 0.6, 0.05}}, 1 + 9.09 / 100)}; }
  SECTION("stretch") { garment.seams = {seam("sew", {{0, 2, 0, 0.4}}, {{1, 3, 0.5, 0}}, 0.8)}; }
  SECTION("chain") {
    // `one` lies left of `two`; counter-clockwise their lower edges run to the right, so the band meets them
    // from the end.
    garment.seams = {seam("centre", {{0, 1, 0, 0.6}}, {{1, 3, 0.6, 0}}, 1),
                     seam("band", {{2, 0, 0, 0.8}}, {{1, 0, 0.4, 0}, {0, 0, 0.4, 0}}, 1)};
  }
  SECTION("chain with a link walked backwards") {
    garment.seams = {seam("centre", {{0, 1, 0, 0.6}}, {{1, 1, 0, 0.6}}, 1),
                     seam("band", {{2, 0, 0, 0.8}}, {{1, 0, 0, 0.4}, {0, 0, 0.4, 0}}, 1)};
  }
  check_same(garment, read_back(interpreter::unparse(garment)));
}

TEST_CASE("panels with everything on them come back") {
  design::Garment garment = two_rectangles();
  design::Panel& panel = garment.panels[0];
  panel.grain_angle = 0.3;
  panel.resolution = 0.0125;
  panel.label = "leg";
  panel.edges[0].curve =
      geometry::Curve({0, 0}, {0.4, 0}, geometry::Through{{{0.1, -0.01}, {0.3, -0.012345678}}});
  panel.edges[1].curve = geometry::Curve({0.4, 0}, {0.4, 0.6}, geometry::Arc{-0.05});
  panel.edges[2].curve = geometry::Curve({0.4, 0.6}, {0, 0.6}, geometry::Cubic{{0.3, 0.62}, {0.1, 0.63}});
  panel.edges[3].curve = geometry::Curve({0, 0.6}, {0, 0}, geometry::Quadratic{{-1.0 / 30, 0.3}});
  panel.notches.push_back({"mark", {}, "outer", 0.2});
  panel.darts.push_back({"pinch", {}, "upper", 0.2, 0.02, 0.1, {}});
  panel.darts.push_back({"tip", {}, "lower", 0.2, 0.02, 0, Point2(0.21, 0.09)});
  panel.placement.kind = design::Placement::Kind::rigid;
  panel.placement.translation = {0.123456789, 1.1, -0.2};
  panel.placement.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  garment.panels[1].placement.kind = design::Placement::Kind::on_part;
  garment.panels[1].placement.body = "form";
  garment.panels[1].placement.part = "front";
  garment.panels[1].placement.edge = "upper";
  garment.panels[1].placement.level = "waist";
  garment.panels[1].placement.offset = 0.015;
  garment.attachments.push_back({"", {}, {{1, 2, 0, 0.4}}, "form", "waist", false});
  garment.pins.push_back({"corner", {}, 0, {0.1, 0.1}});
  garment.gravity = {0, -1.62, 0};

  std::string script = interpreter::unparse(garment, with_body());
  CHECK(formatted(script) == script);
  design::Garment back = read_back(script);
  check_same(garment, back);
  const design::Panel& again = back.panels[0];
  REQUIRE(again.notches.size() == 1);
  CHECK(again.notches[0].name == "mark");
  CHECK(again.notches[0].at == Approx(0.2));
  REQUIRE(again.darts.size() == 2);
  CHECK(again.darts[0].depth == Approx(0.1));
  REQUIRE(again.darts[1].apex);
  CHECK(near(*again.darts[1].apex, {0.21, 0.09}));
  CHECK(back.panels[1].placement.edge == "upper");
  CHECK(back.panels[1].placement.level == "waist");
  CHECK(back.panels[1].placement.part == "front");
  CHECK(back.panels[1].placement.offset == Approx(0.015));
  REQUIRE(back.pins.size() == 1);
  CHECK(near(back.pins[0].point, {0.1, 0.1}));
}

TEST_CASE("without a body, what speaks of it is a comment") {
  design::Garment garment = two_rectangles();
  garment.panels[0].placement.kind = design::Placement::Kind::around;
  garment.panels[0].placement.body = "form";
  garment.panels[0].placement.part = "torso";
  garment.attachments.push_back({"", {}, {{1, 2, 0, 0.4}}, "form", "waist", true});
  std::string script = interpreter::unparse(garment);
  CHECK(script.find("\n# body form = mesh(\"body.obj\")\n") != std::string::npos);
  CHECK(script.find("\n# place one around form.torso offset 1 cm\n") != std::string::npos);
  CHECK(script.find("\n# attach two.upper to form.waist slide\n") != std::string::npos);
  CHECK(formatted(script) == script);
  CHECK(read_back(script).panels.size() == 2);
}

TEST_CASE("a given body is declared though nothing hangs on it") {
  design::Garment garment = two_rectangles();
  garment.panels[0].name = "form";  // the body comes first: the panel gives way
  design::Garment back = read_back(interpreter::unparse(garment, with_body()));
  REQUIRE(back.bodies.size() == 1);
  CHECK(back.bodies[0].name == "form");
  CHECK(back.panels[0].name == "form_1");
}

TEST_CASE("fabrics and bodies come back with all their figures") {
  design::Garment garment = two_rectangles();
  design::Fabric& fabric = garment.fabrics[0];
  fabric.areal_density = 0.1 + 0.2;
  fabric.tensile[1].max_strain = 0.123;
  fabric.shear_friction = 1.1;
  fabric.bending_rigidity = {1.3e-5, 0.7e-5};
  fabric.bending_friction = {3e-4, 2e-4};
  fabric.twist_rigidity = 3e-6;
  fabric.color = {1, 0.2, 0};
  fabric.kind = "measured";
  fabric.source = "a table";
  auto add = [&](const char* name, decltype(design::Body::shape) shape) {
    garment.bodies.push_back({name, {}, std::move(shape), Eigen::Vector3d(0.1, 0, 0.2), 0.25});
  };
  add("table", design::Cylinder{0.3, 0.7});
  add("ball", design::Sphere{0.15});
  add("egg", design::Ellipsoid{{0.1, 0.2, 0.3}});
  add("crate", design::Box{{0.4, 0.5, 0.6}});
  add("ground", design::Floor{});
  design::Mannequin woman;
  woman.size = 38;
  woman.measures["waist"] = 0.71;
  add("person", woman);
  std::string script = interpreter::unparse(garment);
  CHECK(formatted(script) == script);
  design::Garment back = read_back(script);
  REQUIRE(back.fabrics.size() == 1);
  const design::Fabric& again = back.fabrics[0];
  CHECK(again.areal_density == fabric.areal_density);
  CHECK(again.thickness == fabric.thickness);
  for (int d = 0; d < 2; ++d) {
    CHECK(again.tensile[d].max_strain == fabric.tensile[d].max_strain);
    CHECK(again.tensile[d].linearity == fabric.tensile[d].linearity);
    CHECK(again.tensile[d].max_force == fabric.tensile[d].max_force);
    CHECK(again.tensile[d].resilience == fabric.tensile[d].resilience);
    CHECK(again.bending_rigidity[d] == fabric.bending_rigidity[d]);
    CHECK(again.bending_friction[d] == fabric.bending_friction[d]);
  }
  CHECK(again.shear_rigidity == fabric.shear_rigidity);
  CHECK(again.shear_friction == fabric.shear_friction);
  CHECK(again.twist_rigidity == fabric.twist_rigidity);
  CHECK(again.kind == "measured");
  CHECK(again.source == "a table");
  for (int c = 0; c < 3; ++c) CHECK(again.color[c] == Approx(fabric.color[c]));
  REQUIRE(back.bodies.size() == garment.bodies.size());
  for (std::size_t i = 0; i < back.bodies.size(); ++i) {
    CHECK(back.bodies[i].name == garment.bodies[i].name);
    CHECK(back.bodies[i].shape.index() == garment.bodies[i].shape.index());
    CHECK((back.bodies[i].position - garment.bodies[i].position).norm() < 1e-12);
    CHECK(back.bodies[i].friction == 0.25);
  }
  CHECK(std::get<design::Mannequin>(back.bodies[5].shape).measures.at("waist") == Approx(0.71));
}

TEST_CASE("every reference pattern comes back from its script") {
  std::vector<std::string> files = pattern_test::data_files();
  if (files.empty()) {
    WARN("skipped: no pattern files below " GARMENT_DATA_DIR);
    return;
  }
  for (const std::string& file : files) {
    INFO(file);
    io::PatternOptions options;
    options.fabric.name = "shell";
    io::PatternResult pattern = io::read_pattern(pattern_test::read_text(file), options);
    REQUIRE(pattern.garment);
    interpreter::UnparseOptions print = with_body();
    print.comments = pattern.notes;
    std::string script = interpreter::unparse(*pattern.garment, print);
    check_same(*pattern.garment, read_back(script));
    CHECK(formatted(script) == script);
  }
}
