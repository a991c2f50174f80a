#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "runtime/io/pattern_panel.hpp"
#include "tests/unit/io/pattern_support.hpp"

using namespace garment;
using Eigen::Vector3d;

namespace {

void check_panel(const design::Panel& panel) {
  INFO("panel " << panel.name);
  double area = io::signed_area(panel.edges);
  CHECK(std::isfinite(area));
  CHECK(area > 1e-3);
  CHECK(area < 1);
  std::set<std::string> names;
  for (std::size_t i = 0; i < panel.edges.size(); ++i) {
    const auto& curve = panel.edges[i].curve;
    CHECK(curve.end() == panel.edges[(i + 1) % panel.edges.size()].curve.start());
    CHECK(curve.length() > 1e-4);
    CHECK(names.insert(panel.edges[i].name).second);
  }
}

/// Ends of a part as placed, in the order walked.
std::pair<Vector3d, Vector3d> ends(const design::Garment& garment, const design::EdgePart& part) {
  const design::Panel& panel = garment.panels[part.panel];
  const auto& curve = panel.edges[part.edge].curve;
  return {io::placed(panel, curve.point_at(part.from)), io::placed(panel, curve.point_at(part.to))};
}

void check_seam(const design::Garment& garment, const design::Seam& seam) {
  INFO("seam " << seam.name);
  REQUIRE(seam.sides.size() == 2);
  const design::EdgePart& a = seam.sides[0].parts[0];
  const design::EdgePart& b = seam.sides[1].parts[0];
  double length_a = std::abs(a.to - a.from), length_b = std::abs(b.to - b.from);
  CHECK(length_a == Approx(garment.panels[a.panel].edges[a.edge].curve.length()));
  CHECK(length_b == Approx(garment.panels[b.panel].edges[b.edge].curve.length()));
  CHECK(seam.ratio[0] >= 1);
  CHECK(seam.ratio[0] < 3);
  CHECK(std::abs(length_a - seam.ratio[0] * length_b) <= 2e-3 + 1e-12);
  CHECK((a.from < a.to) != (b.from < b.to));  // loops counter-clockwise: sewn edges run oppositely
  // The pieces stand so that what is sewn faces its partner, within the 1 cm that the writer's pivots may be
  // off.
  auto [a0, a1] = ends(garment, a);
  auto [b0, b1] = ends(garment, b);
  CHECK((a0 - b0).norm() + (a1 - b1).norm() < (a0 - b1).norm() + (a1 - b0).norm() + 0.03);
}

}  // namespace

TEST_CASE("all reference patterns are read") {
  std::vector<std::string> files = pattern_test::data_files();
  if (files.empty()) {
    WARN("skipped: no pattern files below " GARMENT_DATA_DIR);
    return;
  }
  CHECK(files.size() == 27);
  std::size_t stitches = 0, gathers = 0;
  double largest = 1;
  for (const std::string& file : files) {
    INFO(file);
    std::string text = pattern_test::read_text(file);
    nlohmann::json root = nlohmann::json::parse(text);
    io::PatternResult result = io::read_pattern(text);
    INFO(pattern_test::all_messages(result.findings));
    REQUIRE(result.garment);
    const design::Garment& garment = *result.garment;
    CHECK(garment.panels.size() == root["pattern"]["panels"].size());
    CHECK(garment.seams.size() == root["pattern"]["stitches"].size());
    for (const Finding& f : result.findings) CHECK(f.code == "G0951");
    std::set<std::string> names;
    for (const design::Panel& panel : garment.panels) {
      CHECK(names.insert(panel.name).second);
      CHECK(panel.edges.size() == root["pattern"]["panels"][panel.name]["edges"].size());
      check_panel(panel);
      // Faces look away from the wearer: fronts forward, backs backward.
      Vector3d face = panel.placement.rotation.col(2);
      Vector3d middle = io::placed(panel, panel.edges[0].curve.start());
      if (std::abs(face.z()) > 0.9) CHECK(face.z() * middle.z() > 0);
    }
    for (const design::Seam& seam : garment.seams) {
      CHECK(names.insert(seam.name).second);
      check_seam(garment, seam);
      double a = seam.sides[0].parts[0].to,
             b = std::max(seam.sides[1].parts[0].from, seam.sides[1].parts[0].to);
      if (a > 1.05 * b) ++gathers;
      largest = std::max(largest, a / b);
    }
    stitches += garment.seams.size();
    bool newer = file.find("garmentcode") != std::string::npos;
    CHECK((result.frame == io::PatternFrame::floor) == newer);
  }
  CHECK(stitches == 364);
  CHECK(gathers == 31);
  CHECK(largest == Approx(2.2).margin(0.1));
}

TEST_CASE("skirts and trousers hang at the waist, tops do not") {
  std::vector<std::string> files = pattern_test::data_files();
  if (files.empty()) {
    WARN("skipped: no pattern files below " GARMENT_DATA_DIR);
    return;
  }
  for (const std::string& file : files) {
    INFO(file);
    io::PatternResult result = io::read_pattern(pattern_test::read_text(file));
    REQUIRE(result.garment);
    bool bottom = file.find("/skirts/") != std::string::npos || file.find("/pants/") != std::string::npos;
    REQUIRE(result.garment->attachments.size() == (bottom ? 1 : 0));
    if (!bottom) continue;
    const design::Attachment& waist = result.garment->attachments[0];
    CHECK(waist.level == "waist");
    bool band = file.find("waistband") != std::string::npos || file.find("wb_") != std::string::npos;
    CHECK(waist.parts.size() == (band ? 2 : result.garment->panels.size()));
    for (const design::EdgePart& part : waist.parts)
      CHECK(result.garment->panels[part.panel].edges[part.edge].name == (band ? "upper" : "waist"));
  }
}

TEST_CASE("reading is repeatable to the bit") {
  std::vector<std::string> files = pattern_test::data_files();
  if (files.empty()) {
    WARN("skipped: no pattern files below " GARMENT_DATA_DIR);
    return;
  }
  std::string text = pattern_test::read_text(files[2]);
  io::PatternResult a = io::read_pattern(text), b = io::read_pattern(text);
  REQUIRE((a.garment && b.garment));
  for (std::size_t p = 0; p < a.garment->panels.size(); ++p) {
    CHECK(a.garment->panels[p].placement.rotation == b.garment->panels[p].placement.rotation);
    for (std::size_t e = 0; e < a.garment->panels[p].edges.size(); ++e) {
      CHECK(a.garment->panels[p].edges[e].name == b.garment->panels[p].edges[e].name);
      CHECK(a.garment->panels[p].edges[e].curve.length() == b.garment->panels[p].edges[e].curve.length());
    }
  }
}
