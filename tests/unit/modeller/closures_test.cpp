// Buttons, tacks and zips in the model.
#include <catch2/catch.hpp>
#include <numeric>

#include "runtime/model/dump.hpp"
#include "runtime/model/validate.hpp"
#include "runtime/modeller/modeller.hpp"
#include "tests/unit/modeller/garments.hpp"

using namespace garment;
using model::Vector3d;
using test::whole;

namespace {

/// Two sheets of 20 cm by 30 cm, the second 3 cm in front of the first.
design::Garment two_sheets() {
  design::Garment g = test::single(test::rectangle("under", 0.2, 0.3, 0.013));
  g.panels.push_back(test::rectangle("over", 0.2, 0.3, 0.017));
  g.panels[1].placement = test::flat(0, 0.03);
  return g;
}

model::Model valid_model(const design::Garment& g) {
  modeller::ModelResult result = modeller::build_model(g, {});
  for (const Finding& f : result.findings) UNSCOPED_INFO(f.code << " " << f.message);
  REQUIRE(result.model);
  CHECK(model::validate(*result.model).empty());
  return *result.model;
}

std::string codes(const design::Garment& g) {
  std::string text;
  for (const Finding& f : modeller::build_model(g, {}).findings) text += f.code + " ";
  return text;
}

Vector3d end_of(const model::Model& m, std::size_t tie, std::size_t from) {
  Vector3d p = Vector3d::Zero();
  for (std::size_t k = from; k < from + 3; ++k) p += m.tie_weights[tie][k] * m.start[m.tie[tie][k]];
  return p;
}

double mass_of(const model::Model& m) { return std::accumulate(m.mass.begin(), m.mass.end(), 0.0); }

design::Button button(int panel, design::Point2 at, std::vector<design::ButtonHole> holes) {
  design::Button b;
  b.name = "top";
  b.origin = {7};
  b.panel = panel;
  b.point = at;
  b.holes = std::move(holes);
  return b;
}

/// Two sheets side by side, the right side of the one zipped to the left side of the other.
design::Garment zipped(double open) {
  design::Garment g = test::single(test::rectangle("left", 0.2, 0.3, 0.01));
  g.panels.push_back(test::rectangle("right", 0.2, 0.3, 0.01));
  g.panels[1].placement = test::flat(0.25);
  design::Zip zip;
  zip.name = "fly";
  zip.sides[0] = {whole(g, 0, 1)};
  zip.sides[1] = {whole(g, 1, 3, true)};
  zip.open = open;
  g.zips = {zip};
  return g;
}

}  // namespace

TEST_CASE("a button ties its place to its hole, and the hole to the next") {
  design::Garment g = two_sheets();
  const double cloth = mass_of(valid_model(g));
  g.buttons = {button(1, {0.071, 0.113}, {{0, {0.064, 0.121}}, {0, {0.031, 0.2}}})};
  g.buttons[0].mass = 2e-3;
  g.buttons[0].shank = 4e-3;
  const model::Model m = valid_model(g);
  REQUIRE(m.tie.size() == 2);
  CHECK((end_of(m, 0, 0) - Vector3d(0.071, 0.113, 0.03)).norm() < 1e-12);
  CHECK((end_of(m, 0, 3) - Vector3d(0.064, 0.121, 0)).norm() < 1e-12);
  CHECK((end_of(m, 1, 0) - Vector3d(0.064, 0.121, 0)).norm() < 1e-12);
  CHECK((end_of(m, 1, 3) - Vector3d(0.031, 0.2, 0)).norm() < 1e-12);
  CHECK((m.tie_span(0, m.start) - Vector3d(-0.007, 0.008, -0.03)).norm() < 1e-12);
  const double thick = g.fabrics[0].thickness;
  CHECK(m.tie_length[0] == Approx(std::max(1e-3, 4e-3 + thick)));
  CHECK(m.tie_length[1] == Approx(std::max(1e-3, thick)));
  REQUIRE(m.closures.size() == 1);
  CHECK(m.closures[0].name == "top");
  CHECK(m.closures[0].origin.value == 7);
  CHECK(mass_of(m) == Approx(cloth + 2e-3));
  CHECK(m.panels[0].mass + m.panels[1].mass == Approx(cloth));
  // A point on the very border of the pattern lies on the cloth.
  g.buttons[0].point = {0.2, 0.3};
  CHECK((end_of(valid_model(g), 0, 0) - Vector3d(0.2, 0.3, 0.03)).norm() < 1e-12);
}

TEST_CASE("a button or tack that is not on the cloth of declared panels is refused") {
  design::Garment g = two_sheets();
  g.buttons = {button(5, {0.1, 0.1}, {{0, {0.1, 0.1}}})};
  CHECK(codes(g) == "G0652 ");
  g.buttons = {button(1, {0.1, 0.1}, {{-1, {0.1, 0.1}}})};
  CHECK(codes(g) == "G0652 ");
  g.buttons.clear();
  design::Tack tack{"hold", {3}, {0, 1}, {{0, 9, 0, 0.1}}, -1};
  g.tacks = {tack};
  CHECK(codes(g) == "G0652 ");
  g.tacks[0].line.clear();
  CHECK(codes(g) == "G0652 ");
}

TEST_CASE("a tack sews a stitch every 2 cm to the nearest place of the other panel") {
  design::Garment g = two_sheets();
  g.panels[1].placement = test::flat(0.01, 0.03);
  g.tacks = {{"hold", {3}, {0, 1}, {whole(g, 0, 1), whole(g, 0, 2)}, -1}};
  const model::Model m = valid_model(g);
  REQUIRE(m.tie.size() == 15 + 10 + 1);  // the corner once
  for (std::size_t t = 0; t < m.tie.size(); ++t) {
    const Vector3d a = end_of(m, t, 0), b = end_of(m, t, 3);
    CHECK((b - Vector3d(std::max(a.x(), 0.01), a.y(), 0.03)).norm() < 1e-12);
    CHECK(m.tie_closure[t] == 0);
  }
  CHECK(mass_of(m) == Approx(m.panels[0].mass + m.panels[1].mass));
  g.panels[1].placement = test::flat(0, 0.11);
  CHECK(codes(g) == "G0653 ");
}

TEST_CASE("a tack over a region sews a grid of stitches, a finer one where it is small") {
  design::Garment g = two_sheets();
  design::Region region;
  region.name = "yoke";
  design::RegionShape shape;
  shape.kind = design::RegionShape::Kind::circle;
  shape.points = {{0.1, 0.2}};
  shape.size = 0.03;
  region.parts = {{0, shape}};
  g.regions = {region};
  g.tacks = {{"hold", {3}, {0, 1}, {}, 0}};
  CHECK(valid_model(g).tie.size() == 9);  // (+-1, +-1) cells of 2 cm, within 3 cm
  g.regions[0].parts[0].shape.points = {{0.11, 0.21}};
  g.regions[0].parts[0].shape.size = 0.008;
  const model::Model m = valid_model(g);
  REQUIRE(m.tie.size() == 1);
  CHECK((end_of(m, 0, 0) - Vector3d(0.11, 0.21, 0)).norm() < 1e-12);
}

TEST_CASE("a zip is a seam as far as it is closed") {
  const std::size_t apart = [] {
    design::Garment g = zipped(0);
    g.zips.clear();
    return valid_model(g).n_particles();
  }();
  const model::Model closed = valid_model(zipped(0)), half = valid_model(zipped(0.5)),
                     open = valid_model(zipped(1));
  CHECK(apart - closed.n_particles() == 31);
  CHECK(apart - half.n_particles() == 16);
  CHECK(apart == open.n_particles());
  REQUIRE(half.seams.size() == 1);
  CHECK(half.seams[0].name == "fly");
  CHECK(half.seams[0].length == Approx(0.15));
  CHECK(open.seams.empty());
  // It is closed from the drawn start of its first side, the lower end.
  for (const model::Index i : half.seams[0].particles) CHECK(half.start[i].y() < 0.1501);
}

TEST_CASE("a garment without closures has the hash it had before there were ties") {
  model::Model m = valid_model(two_sheets());
  CHECK(m.tie.empty());
  const std::uint64_t hash = model::model_hash(m);
  m.closures.push_back({"top", {}, 1e-3});
  CHECK(model::model_hash(m) == hash);
  design::Garment g = two_sheets();
  g.buttons = {button(1, {0.071, 0.113}, {{0, {0.064, 0.121}}})};
  CHECK(model::model_hash(valid_model(g)) != hash);
}
