// Folds that the iron leaves, in the particle model.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "runtime/base/portable_math.hpp"
#include "runtime/modeller/modeller.hpp"
#include "tests/unit/modeller/built.hpp"
#include "tests/unit/modeller/garments.hpp"

using namespace garment;
using design::Press;
using test::ironed;
using test::Point2;

namespace {

model::Model model_of(const design::Garment& g, std::size_t findings = 0) { return test::build(g, findings); }

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

TEST_CASE("every thread that crosses a wide fold turns by it once") {
  design::Garment g = ironed({0.083, 0}, {0.083, 0.3}, 1.5, 0.02);
  g.presses[0].set = 0.8;
  const model::Model m = model_of(g);
  const auto rows = by_line(m, false);
  CHECK(rows.size() == 29);  // all inside: the border runs along the grid
  for (const auto& [height, angle] : rows) CHECK(angle == Approx(1.2));
  CHECK(by_line(m, true).empty());
  CHECK(m.crease_bend.size() > 3 * rows.size());  // 24 mm of arc
  g.presses[0].to = design::Facing::face;
  for (const auto& [height, angle] : by_line(model_of(g), false)) CHECK(angle == Approx(-1.2));
}

TEST_CASE("a sharp fold lies on a line of particles") {
  for (double radius : {0.0, 0.002}) {
    const model::Model m = model_of(ironed({0.083, 0.02}, {0.103, 0.28}, 1.5, radius));
    CHECK(m.crease_bend.empty());
    CHECK(m.fold_fit.size() > 50);
    int on_line = 0;
    for (const auto& uv : m.vertex_uv) on_line += std::abs((uv.x() - 0.083) * 0.26 - (uv.y() - 0.02) * 0.02) < 1e-9;
    CHECK(on_line >= 25);
  }
  // Along a grid line the threads that cross it keep the fold.
  const model::Model m = model_of(ironed({0.08, 0}, {0.08, 0.3}, 1.5));
  const auto rows = by_line(m, false);
  CHECK(rows.size() == 29);
  for (const auto& [height, angle] : rows) CHECK(angle == Approx(1.5));
}

TEST_CASE("threads that cross a wide fold at a slant turn less") {
  const Point2 from(0.08, 0), to(0.12, 0.3), way = (to - from).normalized();
  const model::Model m = model_of(ironed(from, to, 2, 0.02));
  const auto rows = by_line(m, false);
  CHECK(rows.size() >= 25);
  for (const auto& [line, angle] : rows) CHECK(angle == Approx(2 * std::asin(way.y() * std::sin(1.0))).epsilon(1e-9));
}

TEST_CASE("a fold along part of a line folds that part, and parts that follow each other fold once") {
  design::Garment g = ironed({0.083, 0}, {0.083, 0.3}, 1, 0.02);
  g.presses[0].line[0].to = 0.105;
  CHECK(by_line(model_of(g), false).size() == 10);
  g.presses[0].line.push_back({0, 0, 0.105, 0.3, design::EdgePart::On::line});
  const auto rows = by_line(model_of(g), false);
  CHECK(rows.size() == 29);
  for (const auto& [height, angle] : rows) CHECK(angle == Approx(1));
  g.presses[0].radius = 0;
  const std::size_t whole = model_of(g).fold_fit.size();
  g.presses[0].line.pop_back();
  const std::size_t part = model_of(g).fold_fit.size();
  CHECK(part > whole / 4);
  CHECK(part < whole / 2);
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
  const model::Model m = model_of(g);
  CHECK(by_line(m, true).empty());
  for (double angle : m.crease_angle) CHECK(angle == Approx(0.01 / 0.2 / 2));
  Press flat;
  flat.kind = Press::Kind::flat;
  flat.region = 0;
  g.presses.push_back(flat);
  CHECK(model_of(g).crease_bend.empty());
  g.presses[1].factor = 0.5;
  for (double angle : model_of(g).crease_angle) CHECK(angle == Approx(0.01 / 0.2 / 4));
  // Pressed flat, a sharp fold goes where the iron went.
  design::Garment sharp = ironed({0.083, 0}, {0.083, 0.3}, 1);
  const std::size_t folded = model_of(sharp).fold_fit.size();
  sharp.regions = {all};
  flat.factor = 1;
  sharp.presses.push_back(flat);
  CHECK(model_of(sharp).fold_fit.empty());
  sharp.regions[0].parts[0].shape.kind = design::RegionShape::Kind::above;
  sharp.regions[0].parts[0].shape.size = 0.15;
  const std::size_t lower = model_of(sharp).fold_fit.size();
  CHECK(lower > folded / 3);
  CHECK(lower < 2 * folded / 3);
}

TEST_CASE("a curl about a slanting line twists the cells by the same curvature") {
  design::Garment g = ironed({0, 0}, {0.2, 0.3}, 1);
  design::Region all;
  all.name = "all";
  all.parts = {{0, design::RegionShape{}}};
  g.regions = {all};
  g.presses[0].kind = Press::Kind::curl;
  g.presses[0].region = 0;
  g.presses[0].radius = 0.2;
  const model::Model m = model_of(g);
  const Point2 way = Point2(0.2, 0.3).normalized(), across(-way.y(), way.x());
  REQUIRE(m.twist_cell.size() == m.cell.size());
  for (double twist : m.twist_rest) CHECK(twist == Approx(-across.x() * across.y() / 0.2));
}

TEST_CASE("an iron that finds nothing to fold says so") {
  design::Garment g = ironed({0.05, 0.1}, {0.05, 0.2}, 1);
  g.presses[0].line = {test::whole(g, 0, 1)};  // a border with nothing beyond it
  CHECK(model_of(g, 1).fold_fit.empty());
}
