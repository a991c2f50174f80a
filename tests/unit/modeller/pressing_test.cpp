// Folds that the iron leaves, in the particle model.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "runtime/base/portable_math.hpp"
#include "runtime/modeller/modeller.hpp"
#include "tests/unit/modeller/garments.hpp"

using namespace garment;
using design::Press;
using test::Point2;

namespace {

/// 20 x 30 cm with a line inside, ironed along it.
design::Garment ironed(Point2 from, Point2 to, double angle, double radius = 0) {
  design::Garment g = test::single(test::rectangle("cloth", 0.2, 0.3, 0.01));
  g.panels[0].lines = {test::edge("fold", from, to)};
  Press press;
  press.name = "crease";
  press.line = {{0, 0, 0, (to - from).norm(), design::EdgePart::On::line}};
  press.angle = angle;
  press.radius = radius;
  g.presses = {press};
  return g;
}

model::Model build(const design::Garment& g, std::size_t findings = 0) {
  modeller::ModelResult result = modeller::build_model(g, {});
  for (const Finding& f : result.findings) UNSCOPED_INFO(f.code << " " << f.message);
  CHECK(result.findings.size() == findings);
  REQUIRE(result.model);
  return *result.model;
}

/// Sum of the folds along each grid line, by the height of the weft lines and the abscissa of the warp lines, in mm.
std::map<int, double> by_line(const model::Model& m, bool warp) {
  std::map<int, double> sums;
  for (std::size_t c = 0; c < m.crease_bend.size(); ++c) {
    if ((m.crease_bend[c] % 2 == 0) != warp) continue;
    const model::Vector3d& at = m.start[m.bend[m.crease_bend[c]][1]];
    sums[static_cast<int>(std::lround(1000 * (warp ? at.x() : at.y())))] += m.crease_angle[c];
  }
  return sums;
}

}  // namespace

TEST_CASE("every thread that crosses a fold turns by it once") {
  for (double radius : {0.0, 0.002, 0.02}) {
    design::Garment g = ironed({0.083, 0}, {0.083, 0.3}, 1.5, radius);
    g.presses[0].set = 0.8;
    const model::Model m = build(g);
    const auto rows = by_line(m, false);
    CHECK(rows.size() == 29);  // all inside: the border runs along the grid
    for (const auto& [height, angle] : rows) CHECK(angle == Approx(1.2));
    CHECK(by_line(m, true).empty());
    if (radius == 0) CHECK(m.crease_bend.size() == rows.size());
    if (radius == 0.02) CHECK(m.crease_bend.size() > 3 * rows.size());  // 24 mm of arc
  }
  design::Garment g = ironed({0.083, 0}, {0.083, 0.3}, 1.5);
  g.presses[0].to = design::Facing::face;
  for (double angle : build(g).crease_angle) CHECK(angle == Approx(-1.5));
}

TEST_CASE("threads that cross a fold at a slant turn less") {
  const Point2 from(0.06, 0.02), to(0.1, 0.28), way = (to - from).normalized();
  const model::Model m = build(ironed(from, to, 2));
  for (bool warp : {true, false}) {
    const double sine = warp ? way.x() : way.y();
    for (const auto& [line, angle] : by_line(m, warp))
      CHECK(angle == Approx(2 * std::asin(sine * std::sin(1.0))).epsilon(1e-9));
  }
  CHECK(by_line(m, false).size() >= 25);
  CHECK(by_line(m, true).size() >= 3);
  // Without a rest twist a fold on the bias would come out much too weak.
  const modeller::ModelResult bias = modeller::build_model(ironed({0.02, 0.02}, {0.18, 0.18}, 2), {});
  CHECK(!bias.model);
}

TEST_CASE("a fold along part of a line folds that part, and parts that follow each other fold once") {
  design::Garment g = ironed({0.083, 0}, {0.083, 0.3}, 1);
  g.presses[0].line[0].to = 0.105;
  CHECK(by_line(build(g), false).size() == 10);
  g.presses[0].line.push_back({0, 0, 0.105, 0.3, design::EdgePart::On::line});
  const auto rows = by_line(build(g), false);
  CHECK(rows.size() == 29);
  for (const auto& [height, angle] : rows) CHECK(angle == Approx(1));
}

TEST_CASE("a curl bends the threads across its line, a flat iron takes folds out, and factors act") {
  design::Garment g = ironed({0.1, 0}, {0.1, 0.3}, 1);
  design::Region all;
  all.name = "all";
  all.parts = {{0, design::RegionShape{}}};
  g.regions = {all};
  g.presses[0].kind = Press::Kind::curl;
  g.presses[0].region = 0;
  g.presses[0].radius = 0.2;
  g.presses[0].factor = 0.5;
  const model::Model m = build(g);
  CHECK(by_line(m, true).empty());
  for (double angle : m.crease_angle) CHECK(angle == Approx(0.01 / 0.2 / 2));
  Press flat;
  flat.kind = Press::Kind::flat;
  flat.region = 0;
  g.presses.push_back(flat);
  CHECK(build(g).crease_bend.empty());
  g.presses[1].factor = 0.5;
  for (double angle : build(g).crease_angle) CHECK(angle == Approx(0.01 / 0.2 / 4));
}

TEST_CASE("an iron that meets no thread says so") {
  CHECK(build(ironed({0.003, 0.1}, {0.003, 0.2}, 1), 1).crease_bend.empty());
}
