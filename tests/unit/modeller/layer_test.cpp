// Layers and pressed regions in the particle model: the equivalent material, against formulas and other routes.
#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/base/portable_math.hpp"
#include "runtime/model/dump.hpp"
#include "runtime/modeller/layered_cloth.hpp"
#include "runtime/modeller/modeller.hpp"
#include "runtime/modeller/tensile_law.hpp"
#include "tests/unit/modeller/built.hpp"
#include "tests/unit/modeller/garments.hpp"

using namespace garment;
using test::build;
using test::sum;
using design::RegionShape;

namespace {

/// A second cloth, of other stiffness in every way.
design::Fabric canvas() {
  design::Fabric f;
  f.name = "canvas";
  f.areal_density = 0.15;
  f.thickness = 0.4e-3;
  f.bending_rigidity = {9e-5, 2e-5};
  f.twist_rigidity = 3e-5;
  f.shear_rigidity = 70;
  f.tensile[0].max_strain = 0.02;
  f.tensile[1].max_strain = 0.05;
  f.friction = 0.6;
  return f;
}

design::Layer layer(int fabric, bool fused, double grain_angle = 0, int order = 0) {
  design::Layer l;
  l.name = "layer";
  l.fabric = fabric;
  l.panel = 0;
  l.fused = fused;
  l.grain_angle = grain_angle;
  l.order = order;
  return l;
}

/// 30 x 40 cm with these layers all over.
design::Garment layered_sheet(std::vector<design::Layer> layers) {
  design::Garment g = test::single(test::rectangle("cloth", 0.3, 0.4, 0.01));
  g.fabrics.push_back(canvas());
  g.layers = std::move(layers);
  return g;
}

double warp_rigidity(const model::Model& m) { return m.bend_rigidity[0]; }
double weft_rigidity(const model::Model& m) { return m.bend_rigidity[1]; }

design::Region region_above(double y) {
  design::Region r;
  r.name = "part";
  RegionShape shape;
  shape.kind = RegionShape::Kind::above;
  shape.size = y;
  r.parts = {{0, shape}};
  return r;
}

}  // namespace

TEST_CASE("basted layers add mass, thickness, tension, shear and bending") {
  const model::Model plain = build(layered_sheet({})), m = build(layered_sheet({layer(1, false)}));
  const design::Fabric face = test::cloth(), inner = canvas();
  CHECK(sum(m.mass) == Approx((face.areal_density + inner.areal_density) * 0.12).epsilon(1e-12));
  CHECK(m.panels[0].mass == Approx(sum(m.mass)).epsilon(1e-12));
  CHECK(m.thickness[0] == Approx(face.thickness + inner.thickness));
  CHECK(warp_rigidity(m) == Approx(1.3e-5 + 9e-5));
  CHECK(weft_rigidity(m) == Approx(0.7e-5 + 2e-5));
  CHECK(sum(m.cell_twist) == Approx(sum(plain.cell_twist) * (0.5 + 3) / 0.5));
  CHECK(m.cell_shear[0] == Approx(face.shear_rigidity + inner.shear_rigidity));
  CHECK(m.friction[0] == Approx(inner.friction));  // it lies on the body
  for (std::size_t s : {std::size_t{0}, m.spring.size() / 2})
    for (double strain : {-0.01, 0.004, 0.02, 0.055, 0.1}) {
      const int weft = m.spring_law[s] == m.spring_law[0] ? plain.spring_law[0] % 2 : 1 - plain.spring_law[0] % 2;
      const double expected = modeller::tensile_force(plain.laws[plain.spring_law[s]], strain) +
                              modeller::tensile_force(modeller::make_tensile_law(inner.tensile[weft]), strain);
      CHECK(modeller::tensile_force(m.laws[m.spring_law[s]], strain) == Approx(expected).epsilon(1e-5));
    }
}

TEST_CASE("n basted layers of one cloth bend n + 1 times as stiffly; their order says nothing") {
  std::vector<design::Layer> layers;
  for (int n = 1; n < 4; ++n) {
    layers.push_back(layer(0, false, 0, n - 1));
    const model::Model m = build(layered_sheet(layers));
    CHECK(warp_rigidity(m) == Approx((n + 1) * 1.3e-5));
    CHECK(weft_rigidity(m) == Approx((n + 1) * 0.7e-5));
  }
  const model::Model one = build(layered_sheet({layer(0, false, 0, 0), layer(1, false, 0.3, 1)})),
                     other = build(layered_sheet({layer(1, false, 0.3, 0), layer(0, false, 0, 1)}));
  for (std::size_t k = 0; k < one.bend.size(); ++k) CHECK(one.bend_rigidity[k] == Approx(other.bend_rigidity[k]));
  CHECK(sum(one.mass) == Approx(sum(other.mass)));
}

TEST_CASE("two fused cloths of one kind are stiffer by half the coupled membrane") {
  // sum K (z - z0)^2 of two equal plies at the distance T of their middles is K T^2 / 2.
  const model::Model m = build(layered_sheet({layer(0, true)}));
  const design::Fabric f = test::cloth();
  for (int direction : {0, 1}) {
    const double k = modeller::make_tensile_law(f.tensile[direction]).slope.front(), t = f.thickness;
    const double expected = 2 * f.bending_rigidity[direction] + modeller::kFusedCoupling * k * t * t / 2;
    CHECK((direction == 0 ? warp_rigidity(m) : weft_rigidity(m)) == Approx(expected).epsilon(1e-9));
  }
  // Another cloth on top shifts the neutral plane: by the formula for plies along one line.
  design::Garment g = layered_sheet({layer(1, true)});
  g.fabrics[0].shear_rigidity = g.fabrics[1].shear_rigidity = 0;
  const design::Fabric c = canvas();
  const double k0 = modeller::make_tensile_law(f.tensile[0]).slope.front(), k1 = modeller::make_tensile_law(c.tensile[0]).slope.front();
  const double apart = (f.thickness + c.thickness) / 2, coupled = k0 * k1 / (k0 + k1) * apart * apart;
  CHECK(warp_rigidity(build(g)) == Approx(1.3e-5 + 9e-5 + modeller::kFusedCoupling * coupled).epsilon(1e-9));
}

TEST_CASE("a layer's grain may lie at any angle") {
  const design::Fabric face = test::cloth(), c = canvas();
  const model::Model across = build(layered_sheet({layer(1, false, portable::kPi / 2)}));
  CHECK(warp_rigidity(across) == Approx(face.bending_rigidity[0] + c.bending_rigidity[1]).epsilon(1e-9));
  CHECK(weft_rigidity(across) == Approx(face.bending_rigidity[1] + c.bending_rigidity[0]).epsilon(1e-9));
  // B(45) = (B1 + B2) / 4 + Ct, G(45) = (K1 + K2) / 4
  const model::Model bias = build(layered_sheet({layer(1, false, portable::kPi / 4)}));
  const double b45 = (c.bending_rigidity[0] + c.bending_rigidity[1]) / 4 + c.twist_rigidity;
  CHECK(warp_rigidity(bias) == Approx(face.bending_rigidity[0] + b45).epsilon(1e-9));
  CHECK(weft_rigidity(bias) == Approx(face.bending_rigidity[1] + b45).epsilon(1e-9));
  double slopes = 0;
  for (int k : {0, 1}) slopes += modeller::make_tensile_law(c.tensile[k]).slope.front();
  CHECK(bias.cell_shear[0] == Approx(face.shear_rigidity + slopes / 4).epsilon(1e-9));
}

TEST_CASE("a layer in a region weighs as much as its area, on and off the grid") {
  for (double y : {0.2, 0.2025, 0.205, 0.2075}) {
    design::Garment g = layered_sheet({layer(1, false)});
    g.regions = {region_above(y)};
    g.layers[0].region = 0;
    const double added = sum(build(g).mass) - sum(build(layered_sheet({})).mass);
    CHECK(added == Approx(0.15 * 0.3 * (0.4 - y)).epsilon(1e-9));
  }
  // The fitted stencils of the border carry it too: the same layer over a region that is everything.
  design::Garment all = layered_sheet({layer(1, true, 0.4)}), part = all;
  part.regions = {region_above(-1)};
  part.layers[0].region = 0;
  CHECK(model::model_hash(build(all)) == model::model_hash(build(part)));
}

TEST_CASE("a region that is shrunk or drawn out has shorter or longer threads at rest") {
  design::Garment g = layered_sheet({});
  g.regions = {region_above(-1)};
  design::Press press;
  press.kind = design::Press::Kind::shrink;
  press.region = 0;
  press.warp = 0.01;
  press.weft = 0.03;
  press.factor = 0.5;
  g.presses = {press};
  const model::Model plain = build(layered_sheet({})), m = build(g);
  REQUIRE(m.spring.size() == plain.spring.size());
  for (std::size_t s = 0; s < m.spring.size(); ++s) {
    const bool warp = std::abs(plain.start[plain.spring[s][0]].x() - plain.start[plain.spring[s][1]].x()) < 1e-9;
    CHECK(m.spring_rest[s] / plain.spring_rest[s] == Approx(warp ? 0.995 : 0.985).epsilon(1e-12));
  }
  CHECK(sum(m.mass) == Approx(sum(plain.mass)).epsilon(1e-12));
  g.presses[0].kind = design::Press::Kind::extend;
  const model::Model longer = build(g);
  CHECK(longer.spring_rest[0] > plain.spring_rest[0]);
}

TEST_CASE("a region as large as its panel is all of it, and hems in parts lie once") {
  design::Garment g = layered_sheet({layer(1, false)});
  design::Region all = region_above(0);
  all.parts[0].shape.kind = RegionShape::Kind::polygon;
  all.parts[0].shape.points = {{0, 0}, {0.3, 0}, {0.3, 0.4}, {0, 0.4}};
  g.regions = {all};
  g.layers[0].region = 0;
  CHECK(sum(build(g).mass) == Approx(sum(build(layered_sheet({layer(1, false)})).mass)).epsilon(1e-9));
  design::Garment one = layered_sheet({}), two = one;
  design::Hem hem;
  hem.name = "hem";
  hem.parts = {{0, 0, 0, 0.3}};
  hem.turn = 0.04;
  one.hems = {hem};
  hem.parts = {{0, 0, 0, 0.12}, {0, 0, 0.12, 0.3}};
  two.hems = {hem};
  CHECK(sum(build(two).mass) == Approx(sum(build(one).mass)).epsilon(1e-9));
}

TEST_CASE("a hem is its own cloth twice, as wide as it is turned") {
  design::Garment g = layered_sheet({});
  design::Hem hem;
  hem.name = "hem";
  hem.parts = {{0, 0, 0, 0.3}};
  hem.turn = 0.04;
  g.hems = {hem};
  const model::Model plain = build(layered_sheet({})), m = build(g);
  CHECK(sum(m.mass) - sum(plain.mass) == Approx(0.2 * 0.3 * 0.04).epsilon(1e-9));
  for (std::size_t k = 0; k < m.bend.size(); ++k) {
    const double up = m.start[m.bend[k][1]].y() - 0.04, in = up < -1e-9 ? 2 : up < 1e-9 ? 1.5 : 1;
    CHECK(m.bend_rigidity[k] == Approx(in * plain.bend_rigidity[k]));
  }
}

namespace {

/// Two pieces of 20 x 30 cm sewn along their sides.
design::Garment sewn(const design::SeamFinish& finish, double h = 0.01) {
  design::Garment g;
  g.fabrics = {test::cloth()};
  g.panels = {test::rectangle("one", 0.2, 0.3, h), test::rectangle("two", 0.2, 0.3, h)};
  g.panels[1].placement = test::flat(0.2);
  design::Seam seam;
  seam.name = "middle";
  seam.sides.resize(2);
  seam.sides[0].parts = {{0, 1, 0, 0.3}};
  seam.sides[1].parts = {{1, 3, 0.3, 0}};
  seam.ratio = {1};
  seam.finish = finish;
  g.seams = {seam};
  return g;
}

double mass_of(const model::Model& m, int panel) { return m.panels[panel].mass; }

}  // namespace

TEST_CASE("allowances lie where the iron put them") {
  design::SeamFinish open, toward;
  open.ironed = design::SeamFinish::Ironed::open;
  open.allowance = 0.02;
  toward = open;
  toward.ironed = design::SeamFinish::Ironed::toward;
  toward.ironed_toward = 1;
  const double piece = 0.2 * 0.06, strip = 0.2 * 0.3 * 0.02;
  CHECK(mass_of(build(sewn({})), 0) == Approx(piece));
  for (int panel : {0, 1}) CHECK(mass_of(build(sewn(open)), panel) == Approx(piece + strip));
  CHECK(mass_of(build(sewn(toward)), 0) == Approx(piece));
  CHECK(mass_of(build(sewn(toward)), 1) == Approx(piece + 2 * strip));
}

TEST_CASE("a softened seam keeps its share of the plate") {
  design::SeamFinish finish;
  finish.stiffness = 0.1;
  finish.allowance = 0.03;
  const model::Model m = build(sewn(finish));
  for (const auto& d : m.fit_rigidity) {
    Eigen::Matrix3d plate;
    plate << d[0], d[3], d[4], d[3], d[1], d[5], d[4], d[5], d[2];
    CHECK(plate.diagonal().minCoeff() > 0);
    CHECK(plate.determinant() >= 0);
  }
}

TEST_CASE("a stiffened seam resists bending along itself, by its allowances' width on any grid") {
  // Bent along the seam with curvature 1/m: energy B length / 2 (width of both pieces + (f - 1) width of the allowances).
  design::SeamFinish finish;
  finish.stiffness = 5;
  finish.allowance = 0.015;
  for (double h : {0.01, 0.02}) {
    const model::Model plain = build(sewn({}, h)), m = build(sewn(finish, h));
    auto bent = [](const model::Model& model, bool along) {
      double energy = 0;
      for (std::size_t k = 0; k < model.fit_area.size(); ++k) {
        Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();  // columns: 11, 22, 12
        for (model::Index j = model.fit_begin[k]; j < model.fit_begin[k + 1]; ++j) {
          const model::Vector3d& at = model.start[model.fit_particle[j]];
          const double t = along ? at.y() : at.x();
          curvature += model::Vector3d(at.x(), at.y(), t * t / 2) * model.fit_weight[j].transpose();
        }
        const Eigen::Vector3d c = curvature.row(2);
        const auto& d = model.fit_rigidity[k];
        Eigen::Matrix3d plate;
        plate << d[0], d[3], d[4], d[3], d[1], d[5], d[4], d[5], d[2];
        energy += model.fit_area[k] / 2 * c.dot(plate * c);
      }
      return energy;
    };
    // The ends of the seam lie on the border and have no stencil: their neighbours answer for half a cell more.
    const double more = bent(m, true) - bent(plain, true);
    CHECK(more == Approx(1.3e-5 * 0.3 / 2 * 4 * 0.03).epsilon(0.15));
    CHECK(bent(m, false) == Approx(bent(plain, false)).epsilon(1e-6));
  }
}
