#include "runtime/results/strain.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/grid_model.hpp"

using namespace garment;
using model::State;
using model::Vector3d;

namespace {

model::Model sheet() {
  test::SheetSpec spec;
  spec.nx = 21;
  spec.ny = 31;
  model::Model m = test::make_sheet(spec);
  return m;
}

State at(const model::Model& m, const Eigen::Matrix3d& map) {
  State s;
  for (const Vector3d& p : m.start) s.position.push_back(map * p);
  s.velocity.assign(m.n_particles(), Vector3d::Zero());
  return s;
}

/// A right triangle as a cut cell, its warp along `warp` of the flat plane.
model::Model cut_cell(const Eigen::Vector2d& warp) {
  model::Model m;
  const std::vector<Eigen::Vector2d> uv{{0, 0}, {0.01, 0}, {0.002, 0.01}};
  const Eigen::Vector2d weft(warp[1], -warp[0]);
  Eigen::Matrix2d edges;
  edges << uv[1] - uv[0], uv[2] - uv[0];
  const Eigen::Matrix2d inverse = edges.inverse();  // gradients of the barycentric coordinates 1 and 2
  std::array<double, 6> w{};
  for (int d = 0; d < 2; ++d) {
    const Eigen::Vector2d g = inverse * (d == 0 ? warp : weft);
    w[3 * d + 1] = g[0];
    w[3 * d + 2] = g[1];
    w[3 * d] = -g[0] - g[1];
  }
  for (int k = 0; k < 3; ++k) {
    m.mass.push_back(1);
    m.start.emplace_back(uv[k][0], uv[k][1], 0);
    m.vertex_particle.push_back(k);
    m.vertex_panel.push_back(0);
    m.vertex_uv.push_back(uv[k]);
  }
  m.triangle = {{0, 1, 2}};
  m.triangle_panel = {0};
  m.membrane = {{0, 1, 2}};
  m.membrane_weights = {w};
  m.membrane_area = {0.5 * edges.determinant()};
  m.membrane_panel = {0};
  m.panels = {{"cut", {}, 0, 3, 0, 1, m.membrane_area[0], 1, {}}};
  return m;
}

}  // namespace

TEST_CASE("a stretched sheet shows its warp and weft strain", "[strain]") {
  const model::Model m = sheet();
  const State s = at(m, Eigen::Vector3d(1.02, 1.05, 1).asDiagonal());
  const results::StrainReport r = results::measure_strain(m, s);
  REQUIRE(r.panels.size() == m.panels.size());
  CHECK(r.all.warp.largest == Approx(0.05).epsilon(1e-9));
  CHECK(r.all.warp.p99 == Approx(0.05).epsilon(1e-9));
  CHECK(r.all.weft.largest == Approx(0.02).epsilon(1e-9));
  CHECK(r.all.any.largest == Approx(0.05).epsilon(1e-9));
  CHECK(r.all.largest_shear < 1e-9);
  for (const Eigen::Vector2d& e : results::vertex_strain(m, s)) {
    CHECK(e[0] == Approx(0.05).epsilon(1e-9));
    CHECK(e[1] == Approx(0.02).epsilon(1e-9));
  }
}

TEST_CASE("compression is no strain of the garment, but stands in the vertex values", "[strain]") {
  const model::Model m = sheet();
  const State s = at(m, Eigen::Vector3d(0.3, 1, 1).asDiagonal());
  CHECK(results::measure_strain(m, s).all.any.largest < 1e-12);
  CHECK(results::vertex_strain(m, s)[0][1] == Approx(-0.7));
}

TEST_CASE("shear is the loss of the right angle", "[strain]") {
  const model::Model m = sheet();
  Eigen::Matrix3d map = Eigen::Matrix3d::Identity();
  map(0, 1) = std::tan(0.2);  // warp lines lean by 0.2 rad
  CHECK(results::measure_strain(m, at(m, map)).all.largest_shear == Approx(0.2).epsilon(1e-9));
}

TEST_CASE("one spring apart raises the largest, not the percentile", "[strain]") {
  const model::Model m = sheet();
  State s = at(m, Eigen::Matrix3d::Identity());
  s.position.back() += Vector3d(0.004, 0, 0);
  const results::PanelStrain all = results::measure_strain(m, s).all;
  CHECK(all.weft.largest == Approx(0.4));
  CHECK(all.any.p99 < 1e-12);
}

TEST_CASE("cut cells give |U| - 1 and |V| - 1 whatever the grain", "[strain]") {
  for (double angle : {0.0, 0.4, 1.3}) {
    const Eigen::Vector2d warp(-std::sin(angle), std::cos(angle));
    const model::Model m = cut_cell(warp);
    Eigen::Matrix3d map = Eigen::Matrix3d::Identity();
    map.topLeftCorner<2, 2>() += 0.07 * warp * warp.transpose();
    map = Eigen::AngleAxisd(0.8, Vector3d(1, 2, 3).normalized()).toRotationMatrix() * map;
    const results::PanelStrain all = results::measure_strain(m, at(m, map)).all;
    CHECK(all.warp.largest == Approx(0.07).epsilon(1e-9));
    CHECK(all.weft.largest < 1e-12);
    CHECK(all.largest_shear < 1e-9);
  }
}
