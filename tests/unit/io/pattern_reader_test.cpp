#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/io/pattern_rotation.hpp"
#include "runtime/io/pattern_stitch.hpp"
#include "tests/unit/io/pattern_support.hpp"

using namespace garment;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using pattern_test::all_messages;
using pattern_test::fixture;
using pattern_test::has_code;

namespace {

design::Garment read_fixture(const std::string& name, io::PatternResult* all = nullptr) {
  io::PatternResult result = io::read_pattern(fixture(name));
  INFO(all_messages(result.findings));
  REQUIRE(result.garment);
  design::Garment garment = *result.garment;
  if (all) *all = std::move(result);
  return garment;
}

double distance(const geometry::Point2& a, double x, double y) { return (a - geometry::Point2(x, y)).norm(); }

}  // namespace

TEST_CASE("pattern reader maps every kind of curve") {
  design::Garment garment = read_fixture("curves.json");
  REQUIRE(garment.panels.size() == 1);
  const auto& edges = garment.panels[0].edges;
  REQUIRE(edges.size() == 8);
  CHECK(std::holds_alternative<geometry::Line>(edges[0].curve.shape()));
  auto quadratic = std::get<geometry::Quadratic>(edges[1].curve.shape());
  CHECK(distance(quadratic.control, 0.30, -0.05) < 1e-12);
  auto cubic = std::get<geometry::Cubic>(edges[2].curve.shape());
  CHECK(distance(cubic.control_1, 0.45, -0.10) < 1e-12);
  CHECK(distance(cubic.control_2, 0.55, -0.10) < 1e-12);
  auto older = std::get<geometry::Quadratic>(edges[3].curve.shape());
  CHECK(distance(older.control, 0.65, 0.10) < 1e-12);

  // Chords of 40 cm on a circle of 25 cm: the centre lies 15 cm off, the arcs rise 10 or 40 cm.
  auto bulge = [&](int i) { return std::get<geometry::Arc>(edges[i].curve.shape()).bulge; };
  CHECK(bulge(4) == Approx(-0.10));  // counter-clockwise: to the right of the way walked
  CHECK(distance(edges[4].curve.point_at(edges[4].curve.length() / 2), 0.90, 0.20) < 1e-9);
  CHECK(bulge(5) == Approx(0.10));
  CHECK(distance(edges[5].curve.point_at(edges[5].curve.length() / 2), 0.60, 0.30) < 1e-9);
  CHECK(bulge(6) == Approx(-0.40));
  CHECK(distance(edges[6].curve.point_at(edges[6].curve.length() / 2), 0.20, 0.80) < 1e-9);
  CHECK(bulge(7) == Approx(-0.10));
  double angle = 2 * std::asin(0.8);
  CHECK(edges[4].curve.length() == Approx(0.25 * angle));
  CHECK(edges[6].curve.length() == Approx(0.25 * (2 * M_PI - angle)));
}

TEST_CASE("pattern reader takes absolute control points where the file says so") {
  design::Garment garment = read_fixture("absolute_curves.json");
  const auto& edges = garment.panels[0].edges;
  CHECK(distance(std::get<geometry::Quadratic>(edges[0].curve.shape()).control, 0.10, -0.05) < 1e-12);
  CHECK(distance(std::get<geometry::Cubic>(edges[2].curve.shape()).control_2, 0.05, 0.45) < 1e-12);
}

TEST_CASE("stitches: start meets end, with right_wrong start meets start; the longer side comes first") {
  design::Garment garment = read_fixture("right_wrong.json");
  REQUIRE(garment.seams.size() == 2);
  for (const design::Seam& seam : garment.seams) {
    REQUIRE(seam.sides.size() == 2);
    const design::EdgePart& first = seam.sides[0].parts[0];
    CHECK(garment.panels[first.panel].name == "back");  // 66 cm onto 60 cm
    CHECK(first.from == 0);
    CHECK(first.to == Approx(0.66));
    REQUIRE(seam.ratio.size() == 2);
    CHECK(seam.ratio[0] == Approx(1.10).epsilon(1e-12));
    CHECK(seam.ratio[1] == 1);
  }
  const design::EdgePart& plain = garment.seams[0].sides[1].parts[0];
  CHECK(plain.from == Approx(0.60));
  CHECK(plain.to == 0);
  const design::EdgePart& turned = garment.seams[1].sides[1].parts[0];
  CHECK(turned.from == 0);
  CHECK(turned.to == Approx(0.60));
  CHECK(garment.panels[0].edges[0].name == "hem");
  CHECK(garment.panels[0].edges[0].free);
  CHECK_FALSE(garment.panels[0].edges[1].free);
  CHECK(garment.panels[0].edges[1].name == "side_left");  // x > 0 is the wearer's left
  CHECK(garment.seams[0].name == "side_left");
  CHECK(garment.seams[1].name == "side_right");
}

TEST_CASE("pattern reader puts edges in order and keeps the file's numbers for stitches") {
  io::PatternResult all;
  design::Garment garment = read_fixture("shuffled.json", &all);
  CHECK(has_code(all.findings, "G0949"));
  CHECK(has_code(all.findings, "G0946"));  // edge 3 lies on one place
  CHECK(has_code(all.findings, "G0954"));  // and so does its stitch
  const design::Panel& panel = garment.panels[0];
  CHECK(panel.name == "Panel_1_n_ht");
  REQUIRE(panel.edges.size() == 5);
  for (std::size_t i = 0; i < 5; ++i) {
    const auto& here = panel.edges[i].curve;
    const auto& next = panel.edges[(i + 1) % 5].curve;
    CHECK(here.end() == next.start());
  }
  CHECK(panel.edges[1].curve.start() == geometry::Point2(0.1, 0));
  // File edge 5 ran upwards and bulged left; the outline walks it downwards.
  double bulge = std::get<geometry::Arc>(panel.edges[4].curve.shape()).bulge;
  CHECK(bulge < 0);
  CHECK(panel.edges[4].curve.point_at(panel.edges[4].curve.length() / 2).x() < 0);
  REQUIRE(garment.seams.size() == 2);
  // The dart: both legs in the file run away from, then into, the notch's tip: start meets start.
  const design::Seam& dart = garment.seams[0];
  CHECK(dart.sides[0].parts[0].edge == 2);
  CHECK(dart.sides[1].parts[0].edge == 3);
  // File edge 1 starts at the tip, is walked into it; file edge 4 starts there too and is walked from it.
  CHECK((dart.sides[0].parts[0].from < dart.sides[0].parts[0].to) !=
        (dart.sides[1].parts[0].from < dart.sides[1].parts[0].to));
  CHECK(dart.name == "Panel_1_n_ht_dart_1");
  CHECK(panel.edges[2].name == "dart_1_a");
  CHECK(panel.edges[3].name == "dart_1_b");
}

TEST_CASE("a clockwise panel comes out mirrored and stays where it was") {
  io::PatternResult all;
  design::Garment garment = read_fixture("clockwise_skirt.json", &all);
  const design::Panel& front = garment.panels[0];
  double area = 0;
  for (const design::Edge& edge : front.edges) area += edge.curve.area_term();
  CHECK(area > 0.36);  // 60 cm square and a curved side
  CHECK(front.label == "leg");
  auto place = [&](const geometry::Point2& p) -> Vector3d {
    return front.placement.rotation * Vector3d(p.x(), p.y(), 0) + front.placement.translation;
  };
  Matrix3d R = io::rotation_zyx({0, 0, 30});
  Vector3d t(0.30, -0.70, -0.16);
  CHECK((place(front.edges[1].curve.start()) - (R * Vector3d(0, 0.6, 0) + t)).norm() < 1e-12);
  CHECK((place(front.edges[1].curve.end()) - (R * Vector3d(0.6, 0.6, 0) + t)).norm() < 1e-12);
  auto control = std::get<geometry::Quadratic>(front.edges[0].curve.shape()).control;
  CHECK((place(control) - (R * Vector3d(-0.06, 0.3, 0) + t)).norm() < 1e-12);
  CHECK((front.placement.rotation.col(2) - Vector3d(0, 0, -1)).norm() < 1e-12);  // seen from its back
  CHECK(front.placement.rotation.determinant() == Approx(1));
}

TEST_CASE("attachments come from labels and from heights") {
  io::PatternResult all;
  design::Garment garment = read_fixture("clockwise_skirt.json", &all);
  CHECK(all.frame == io::PatternFrame::pelvis);
  CHECK(has_code(all.findings, "G0951"));  // `loose` is turned about two axes
  REQUIRE(garment.attachments.size() == 3);
  CHECK(garment.attachments[0].level == "bust");
  CHECK(garment.attachments[1].level == "neck");
  const design::Attachment& waist = garment.attachments[2];
  CHECK(waist.level == "waist");
  CHECK(waist.body == "form");
  CHECK(waist.slide);
  REQUIRE(waist.parts.size() == 2);
  CHECK(garment.panels[0].edges[waist.parts[0].edge].name == "waist");
  CHECK(waist.parts[1].panel == 1);  // unlabelled, below the bust: its free upper edge
  CHECK(waist.parts[1].edge == 2);

  io::PatternOptions options;
  options.attach = false;
  CHECK(io::read_pattern(fixture("clockwise_skirt.json"), options).garment->attachments.empty());
}

TEST_CASE("options reach the garment") {
  io::PatternOptions options;
  options.title = "probe";
  options.fabric.name = "front";  // panels must not take the fabric's name
  options.resolution = 0.02;
  options.frame = io::PatternFrame::pelvis;
  io::PatternResult result = io::read_pattern(fixture("right_wrong.json"), options);
  REQUIRE(result.garment);
  CHECK(result.frame == io::PatternFrame::pelvis);
  CHECK(result.garment->title == "probe");
  CHECK(result.garment->fabrics.size() == 1);
  CHECK(result.garment->panels[0].resolution == 0.02);
  CHECK(result.garment->panels[0].name == "front_2");
  Vector3d before = result.garment->panels[0].placement.translation;
  io::move_garment(*result.garment, {0, io::pelvis_shift(1.66), 0});
  CHECK((result.garment->panels[0].placement.translation - before - Vector3d(0, 1.12, 0)).norm() < 1e-12);
}

TEST_CASE("stated ratios are what a script can print") {
  CHECK(io::stated_ratio(0.501, 0.5) == 1);
  CHECK(io::stated_ratio(0.526, 0.5) == Approx(1.052).epsilon(1e-14));
  CHECK(io::stated_ratio(0.1234567, 0.1) == Approx(1.2346).epsilon(1e-14));
  CHECK(io::stated_ratio(0.9, 0.5) == Approx(1.8).epsilon(1e-14));
}

TEST_CASE("rotations by degrees are exact at right angles and come back from the matrix") {
  Matrix3d half = io::rotation_zyx({180, 180, 0});
  CHECK(half == Vector3d(-1, -1, 1).asDiagonal().toDenseMatrix());
  for (Vector3d angles : {Vector3d(0, 0, 0), Vector3d(30, 40, 50), Vector3d(-120, 80, 170),
                          Vector3d(0, 90, 0), Vector3d(25, 90, 10), Vector3d(-36.3, -90, 12),
                          Vector3d(12, 89.9999999, 7), Vector3d(180, 0, 180), Vector3d(1e5, -720.5, 33)}) {
    Matrix3d R = io::rotation_zyx(angles);
    CHECK((R.transpose() * R - Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-15);
    CHECK((io::rotation_zyx(io::angles_zyx(R)) - R).cwiseAbs().maxCoeff() < 1e-12);
  }
  // Rz Ry Rx: x first. About x by 90, then about z by 90: the y axis goes to z and stays.
  CHECK((io::rotation_zyx({90, 0, 90}) * Vector3d::UnitY() - Vector3d::UnitZ()).norm() < 1e-15);
  CHECK((io::rotation_xyz({90, 0, 90}) * Vector3d::UnitY() + Vector3d::UnitX()).norm() < 1e-15);
}
