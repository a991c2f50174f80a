// From forces, pressures, constraints, paths, friction of pairs and damping to the arrays of the Model.
#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/base/host.hpp"
#include "runtime/body/body.hpp"
#include "runtime/model/dump.hpp"
#include "runtime/model/motion.hpp"
#include "runtime/model/validate.hpp"
#include "tests/unit/modeller/built.hpp"

using namespace garment;
using Eigen::Vector3d;
using test::Point2;

namespace {

design::Garment cloth() { return test::single(test::rectangle("cloth", 0.1, 0.2, 0.01)); }

design::EdgePart whole(int edge, double length) { return {0, edge, 0, length}; }

}  // namespace

TEST_CASE("loads: a force goes to the corners of its triangle, by their weights") {
  design::Garment g = cloth();
  design::Force f;
  f.name = "pull";
  f.panel = 0;
  f.point = {0.033, 0.087};
  f.newtons = {1, -2, 0.5};
  g.scene.forces.push_back(f);
  const model::Model m = test::build(g, 0);
  CHECK(model::validate(m).empty());
  REQUIRE(m.load_particle.size() == 3);
  Vector3d sum = Vector3d::Zero();
  Point2 middle(0, 0);
  for (int k = 0; k < 3; ++k) {
    sum += m.load_force[k];
    for (std::size_t v = 0; v < m.n_vertices(); ++v)
      if (m.vertex_particle[v] == m.load_particle[k]) middle += m.load_force[k].x() * m.vertex_uv[v];
  }
  CHECK(sum.isApprox(f.newtons, 1e-12));
  CHECK((middle - f.point).norm() < 1e-12);
  g.scene.forces[0].panel = 4;
  CHECK(modeller::build_model(g, {}).findings.at(0).code == "G0652");
}

TEST_CASE("loads: pressure, wind and drag are in the model, and in its hash where there are any") {
  design::Garment g = cloth();
  const model::Model still = test::build(g, 0);
  CHECK(still.pressed_triangle.empty());
  CHECK(still.air.still());
  CHECK(still.damping.empty());
  design::Pressure p;
  p.panel = 0;
  p.pascals = 30;
  g.scene.pressures = {p, p};
  const model::Model blown = test::build(g, 0);
  CHECK(blown.pressed_triangle.size() == blown.n_triangles());
  CHECK(blown.pressed_pascals[0] == 60);
  CHECK(model::model_hash(blown) != model::model_hash(still));
  g.scene.pressures.clear();
  g.scene.wind = design::Wind{{}, {0, 0, 5}, 0.2};
  const model::Model windy = test::build(g, 0);
  CHECK(windy.air.drag == Approx(1.2));
  CHECK(windy.air.gust == Approx(0.2));
  CHECK(model::model_hash(windy) != model::model_hash(still));
  g.scene.drag = 0.7;
  CHECK(test::build(g, 0).air.drag == Approx(0.7));
}

TEST_CASE("loads: constraints are rods and planes") {
  design::Garment g = cloth();
  design::Constraint c;
  c.a = {0, {0, 0.2}};
  c.b = {0, {0.1, 0.2}};
  c.length = 0.08;
  g.scene.constraints.push_back(c);
  c.kind = design::Constraint::Kind::on_line;
  c.through = {0, 0, 0.3};
  c.along = {0, 1, 0};
  g.scene.constraints.push_back(c);
  c.kind = design::Constraint::Kind::on_plane;
  c.a.point = {0.1, 0};
  g.scene.constraints.push_back(c);
  const model::Model m = test::build(g, 0);
  CHECK(model::validate(m).empty());
  REQUIRE(m.rod_tie.size() == 1);
  CHECK(m.tie_length[m.rod_tie[0]] == Approx(0.08));
  REQUIRE(m.hold_particle.size() == 3);
  CHECK(m.hold_particle[0] == m.hold_particle[1]);
  CHECK(std::abs(m.hold_normal[0].dot(m.hold_normal[1])) < 1e-12);
  CHECK(std::abs(m.hold_normal[0].y()) < 1e-12);
  CHECK(m.hold_normal[2].isApprox(Vector3d::UnitY()));
}

TEST_CASE("loads: a clamp on a path moves about the middle of what it holds") {
  design::Garment g = cloth();
  design::Path path;
  path.name = "lift";
  path.poses = {{0, {0, 0, 0}, {0, 0, 0}}, {2, {0, 0.1, 0}, {0, 0, 3.14159265358979}}};
  g.scene.paths.push_back(path);
  design::Clamp clamp;
  clamp.name = "jaw";
  clamp.parts = {whole(2, 0.1)};
  clamp.path = 0;
  g.scene.clamps.push_back(clamp);
  clamp.name = "fixed";
  clamp.parts = {whole(0, 0.1)};
  clamp.path = -1;
  g.scene.clamps.push_back(clamp);
  const model::Model m = test::build(g, 0);
  CHECK(model::validate(m).empty());
  REQUIRE(m.holders.size() == 2);
  CHECK(m.holders[0].name == "jaw");
  CHECK(m.holders[0].particles.size() == 11);
  CHECK(m.moved_hold.size() == 11);
  REQUIRE(m.motions.size() == 1);
  const model::Model half = model::at_time(m, 1), end = model::at_time(m, 5);
  for (std::size_t k = 0; k < m.moved_hold.size(); ++k) {
    const Vector3d off = m.hold_point[m.moved_hold[k]] - m.motions[0].pivot;
    CHECK((end.hold_point[m.moved_hold[k]] - m.motions[0].pivot - Vector3d(0, 0.1, 0) + off - 2 * off.z() * Vector3d::UnitZ()).norm() < 1e-9);
    CHECK((half.hold_point[m.moved_hold[k]] - m.motions[0].pivot - Vector3d(0, 0.05, 0)).norm() == Approx(off.norm()).margin(1e-9));
  }
}

TEST_CASE("loads: what is attached to a body that moves goes with it") {
  design::Garment g = cloth();
  design::Body declared;
  declared.name = "form";
  declared.position = {1, 0, 0};
  g.bodies.push_back(declared);
  design::Path path;
  path.name = "walk";
  path.body = 0;
  path.poses = {{0, {0, 0, 0}, {0, 0, 0}}, {1, {0, 0.2, 0}, {0, 0, 0}}};
  g.scene.paths.push_back(path);
  design::Attachment a;
  a.name = "waist";
  a.body = "form";
  a.level = "waist";
  a.parts = {whole(2, 0.1)};
  g.attachments.push_back(a);
  body::Body form;
  form.name = "form";
  form.levels["waist"] = {0.1, 0.7};
  const modeller::ModelResult built = modeller::build_model(g, {form});
  REQUIRE(built.model);
  const model::Model later = model::at_time(*built.model, 0.5);
  REQUIRE(later.hold_point.size() == 11);
  for (const Vector3d& p : later.hold_point) CHECK(p.y() == Approx(0.2));
  CHECK(built.model->motions[0].pivot.x() == 1);
}

TEST_CASE("loads: friction of pairs, with the region's factor by its root") {
  design::Garment g = cloth();
  g.fabrics[0].friction = 0.4;
  design::Body declared;
  declared.name = "ball";
  declared.shape = design::Sphere{0.1};
  declared.friction = 0.9;
  g.bodies.push_back(declared);
  design::FrictionPair pair;
  pair.fabric = 0;
  pair.body = 0;
  pair.factor = 0.2;
  g.scene.frictions.push_back(pair);
  pair.body = -1;
  pair.other_fabric = 0;
  pair.factor = 0.7;
  g.scene.frictions.push_back(pair);
  design::Region rough;
  rough.name = "rough";
  rough.parts = {{0, {}}};
  rough.factors.friction = 4;
  g.regions.push_back(rough);
  body::BodyResult ball = body::build_body(declared, system_host(), "");
  REQUIRE(ball.body);
  const modeller::ModelResult built = modeller::build_model(g, {*ball.body});
  REQUIRE(built.model);
  const model::Model& m = *built.model;
  REQUIRE(m.rub_particle.size() == m.n_particles());
  for (double mu : m.rub_factor) CHECK(mu == Approx(0.2 * 2));
  REQUIRE(m.rub_panels.size() == 1);
  CHECK(m.rub_panels[0] == model::Indices<2>{0, 0});
  CHECK(m.rub_panels_factor[0] == Approx(0.7));
}

TEST_CASE("loads: damping is the fabric's, times that of its regions") {
  design::Garment g = cloth();
  design::Region slow;
  slow.name = "slow";
  design::RegionShape low;
  low.kind = design::RegionShape::Kind::below;
  low.size = 0.1;
  slow.parts = {{0, low}};
  slow.factors.damping = 3;
  g.regions.push_back(slow);
  const model::Model m = test::build(g, 0);
  REQUIRE(m.damping.size() == m.n_particles());
  for (std::size_t v = 0; v < m.n_vertices(); ++v)
    if (std::abs(m.vertex_uv[v].y() - 0.1) > 0.015)
      CHECK(m.damping[m.vertex_particle[v]] == Approx(m.vertex_uv[v].y() < 0.1 ? 0.06 : 0.02));
}
