// Regions in the particle model: each factor reaches what it names and nothing else.
#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/model/dump.hpp"
#include "runtime/modeller/modeller.hpp"
#include "tests/unit/modeller/built.hpp"
#include "tests/unit/modeller/garments.hpp"

using namespace garment;
using test::build;
using test::sum;
using design::RegionFactors;
using design::RegionShape;

namespace {

RegionShape above(double y) {
  RegionShape shape;
  shape.kind = RegionShape::Kind::above;
  shape.size = y;
  return shape;
}

design::Region region(int panel, RegionShape shape, const RegionFactors& factors) {
  design::Region r;
  r.name = "part";
  r.parts = {{panel, std::move(shape)}};
  r.factors = factors;
  return r;
}

/// A piece of 30 x 40 cm whose upper 20 cm are the region.
design::Garment halved(const RegionFactors& factors) {
  design::Garment g = test::single(test::rectangle("cloth", 0.3, 0.4, 0.01));
  g.regions = {region(0, above(0.2), factors)};
  return g;
}

}  // namespace

TEST_CASE("a region whose factors are 1 leaves the model as it is, bit for bit") {
  for (int seed = 0; seed < 5; ++seed) {
    design::Garment plain = test::single(test::blob(seed, 0.012)), with = plain;
    with.regions = {region(0, above(0), RegionFactors{})};
    CHECK(model::model_hash(build(plain)) == model::model_hash(build(with)));
  }
}

TEST_CASE("the mass of a region scales") {
  RegionFactors f;
  f.mass = 3;
  const model::Model m = build(halved(f));
  // The border of the region runs along a grid line; particles on it lie half in it.
  const double cloth = 0.2 * 0.3 * 0.4;
  CHECK(sum(m.mass) == Approx(cloth * 2).epsilon(1e-12));
  CHECK(m.panels[0].mass == Approx(sum(m.mass)).epsilon(1e-12));
  const model::Model whole = build([&] {
    design::Garment g = halved(f);
    g.regions[0].parts[0].shape = above(-1);
    return g;
  }());
  CHECK(sum(whole.mass) == Approx(3 * cloth).epsilon(1e-12));
}

TEST_CASE("a factor on bending scales the rigidities in its region and no others") {
  RegionFactors f;
  f.bend_warp = 2;
  f.bend_weft = 5;
  f.twist = 3;
  const model::Model plain = build(halved({})), m = build(halved(f));
  REQUIRE(m.bend_rigidity.size() == plain.bend_rigidity.size());
  auto height = [&](model::Index particle) { return m.start[particle].y(); };
  int above_count = 0;
  for (std::size_t k = 0; k < m.bend.size(); ++k) {
    const double up = height(m.bend[k][1]) - 0.2, in = up > 1e-9 ? 1 : up > -1e-9 ? 0.5 : 0;  // its share in the region
    above_count += in == 1;
    const bool warp = k % 2 == 0;
    CHECK(m.bend_rigidity[k] == Approx(plain.bend_rigidity[k] * (1 + in * ((warp ? 2 : 5) - 1))).epsilon(1e-14));
  }
  CHECK(above_count > 100);
  for (std::size_t c = 0; c < m.cell.size(); ++c) {
    double low = 1, high = 0;
    for (model::Index i : m.cell[c]) low = std::min(low, height(i)), high = std::max(high, height(i));
    if (low > 0.2 + 1e-9) CHECK(m.cell_twist[c] == Approx(3 * plain.cell_twist[c]).epsilon(1e-12));
    if (high < 0.2 - 1e-9) CHECK(m.cell_twist[c] == plain.cell_twist[c]);
  }
}

TEST_CASE("fitted stencils bend as their region does") {
  RegionFactors f;
  f.bend_warp = f.bend_weft = f.twist = 4;
  design::Garment g = test::skirt(0.015);
  const model::Model plain = build(g);
  for (int panel : {0, 1}) g.regions.push_back(region(panel, above(-1), f));
  const model::Model m = build(g);
  REQUIRE(m.fit_rigidity.size() == plain.fit_rigidity.size());
  for (std::size_t k = 0; k < m.fit_rigidity.size(); ++k)
    for (int a = 0; a < 6; ++a)
      CHECK(m.fit_rigidity[k][a] == Approx(4 * plain.fit_rigidity[k][a]).epsilon(1e-9).margin(1e-20));
}

TEST_CASE("stretch and shear scale by element") {
  RegionFactors f;
  f.stretch_warp = 2;
  f.shear = 3;
  const model::Model plain = build(halved({})), m = build(halved(f));
  CHECK(m.laws.size() == plain.laws.size() + 1);
  for (std::size_t s = 0; s < m.spring.size(); ++s) {
    const double y = (m.start[m.spring[s][0]].y() + m.start[m.spring[s][1]].y()) / 2;
    const bool warp = plain.spring_law[s] == 0, in = y > 0.2 + 1e-9;
    const double force = m.laws[m.spring_law[s]].force.back(),
                 was = plain.laws[plain.spring_law[s]].force.back();
    CHECK(force == Approx(warp && in ? 2 * was : was).epsilon(1e-14));
  }
  for (std::size_t c = 0; c < m.cell.size(); ++c) {
    const double y = (m.start[m.cell[c][0]].y() + m.start[m.cell[c][2]].y()) / 2;
    CHECK(m.cell_shear[c] == Approx((y > 0.2 ? 3 : 1) * plain.cell_shear[c]).epsilon(1e-14));
  }
}

TEST_CASE("friction and thickness are those of the particle") {
  RegionFactors f;
  f.friction = 2;
  f.thickness = 1.5;
  const model::Model plain = build(halved({})), m = build(halved(f));
  for (std::size_t i = 0; i < m.n_particles(); ++i) {
    if (std::abs(m.start[i].y() - 0.2) < 1e-6) continue;  // on the border, to either side
    const bool in = m.start[i].y() > 0.2;
    CHECK(m.friction[i] == Approx((in ? 2 : 1) * plain.friction[i]).epsilon(1e-14));
    CHECK(m.thickness[i] == Approx((in ? 1.5 : 1) * plain.thickness[i]).epsilon(1e-14));
  }
}

TEST_CASE("overlapping regions multiply; starch stiffens bending by its factor and shear by its root") {
  RegionFactors f;
  f.bend_warp = 2;
  design::Garment g = halved(f);
  g.regions.push_back(region(0, above(-1), f));
  g.starches = {{OriginId{}, 1, 4}};
  const model::Model plain = build(halved({})), m = build(g);
  for (std::size_t k = 0; k < m.bend.size(); ++k) {
    const double up = m.start[m.bend[k][1]].y() - 0.2, in = up > 1e-9 ? 2 : up > -1e-9 ? 1.5 : 1;  // on the border the mean
    const double warp = k % 2 == 0 ? 2 * in : 1;
    CHECK(m.bend_rigidity[k] == Approx(4 * warp * plain.bend_rigidity[k]).epsilon(1e-14));
  }
  for (std::size_t c = 0; c < m.cell.size(); ++c) CHECK(m.cell_shear[c] == Approx(2 * plain.cell_shear[c]));
}

TEST_CASE("a region that no particle lies in is said") {
  RegionFactors f;
  f.mass = 2;
  design::Garment g = halved({});
  RegionShape dot;
  dot.kind = RegionShape::Kind::circle;
  dot.points = {{0.1551, 0.1549}};
  dot.size = 0.002;
  g.regions = {region(0, dot, f)};
  const modeller::ModelResult result = modeller::build_model(g, {});
  REQUIRE(result.model);
  REQUIRE(result.findings.size() == 1);
  CHECK(result.findings[0].code == "G1150");
  CHECK(result.findings[0].severity == Severity::warning);
}

TEST_CASE("a relation on part of a side puts its fullness there only") {
  // 30 cm sewn to 32 cm: the middle 12 cm of the longer side take up 10 cm.
  design::Garment g;
  g.fabrics = {test::cloth()};
  g.panels = {test::rectangle("plain", 0.3, 0.1, 0.01), test::rectangle("full", 0.32, 0.1, 0.01, {0, -0.1})};
  design::Seam seam =
      test::seam("joint", {{0, 0, 0, 0.3}}, {{1, 2, 0.32, 0.22}, {1, 2, 0.22, 0.1}, {1, 2, 0.1, 0}});
  seam.sides[1].fullness = {1, 1.2, 1};
  g.seams = {seam};
  const model::Model m = build(g);
  REQUIRE(m.seams.size() == 1);
  auto at = [&](model::Index particle, model::Index panel) {
    for (std::size_t v = 0; v < m.n_vertices(); ++v)
      if (m.vertex_particle[v] == particle && m.vertex_panel[v] == panel) return m.vertex_uv[v].x();
    return -1.0;
  };
  for (model::Index particle : m.seams[0].particles) {
    const double x = at(particle, 0), y = at(particle, 1);
    REQUIRE(x >= -1e-9);
    const double wanted = x < 0.1 ? x : x < 0.2 ? 0.1 + 1.2 * (x - 0.1) : x + 0.02;
    CHECK(y == Approx(wanted).margin(2e-4));
  }
  CHECK(m.seams[0].length == Approx(0.3).epsilon(1e-9));
}

TEST_CASE("the model tells what the cloth of a region comes to, overlaps multiplied") {
  RegionFactors wide, narrow;
  wide.bend_warp = 2;
  wide.mass = 1.5;
  narrow.bend_warp = 3;
  narrow.stretch_weft = 0.5;
  design::Garment g = halved(wide);
  g.regions.push_back(region(0, above(0.3), narrow));  // the upper half of the first
  g.regions[1].name = "inner";
  const model::Model m = build(g);
  REQUIRE(m.regions.size() == 2);
  const design::Fabric cloth = test::cloth();
  CHECK(m.regions[0].name == "part");
  CHECK(m.regions[0].panel == "cloth");
  CHECK(m.regions[0].area == Approx(0.06).epsilon(0.06));  // particles on the border lie to either side
  CHECK(m.regions[0].bending[0] == Approx(cloth.bending_rigidity[0] * 2 * (0.5 + 0.5 * 3)).epsilon(0.05));
  CHECK(m.regions[0].bending[1] == Approx(cloth.bending_rigidity[1]));
  CHECK(m.regions[0].areal_density == Approx(0.2 * 1.5).epsilon(0.03));
  CHECK(m.regions[1].bending[0] == Approx(cloth.bending_rigidity[0] * 6).epsilon(0.06));
  CHECK(m.regions[1].tensile[1] / m.regions[0].tensile[1] == Approx(0.5 / 0.75).epsilon(0.06));
  CHECK(m.regions[1].rest_length[0] == 1);
  CHECK(model::dump_json(m).find("\"name\": \"inner\", \"panel\": \"cloth\"") != std::string::npos);
}
