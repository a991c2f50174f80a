// A part of a garment pulls on its particles as the whole does, and settles without the rest.
#include <catch2/catch.hpp>
#include <random>

#include "runtime/model/part.hpp"
#include "runtime/simulator/awake.hpp"
#include "runtime/simulator/certificate.hpp"
#include "runtime/simulator/elastic.hpp"
#include "tests/support/draped.hpp"
#include "tests/support/elastic_cases.hpp"
#include "tests/support/two_sheets.hpp"
#include "tests/unit/modeller/built.hpp"
#include "tests/unit/modeller/garments.hpp"

using namespace garment;
using Eigen::Vector3d;

namespace {

using Positions = std::vector<Vector3d>;

std::vector<test::ElasticCase> cases() {
  std::vector<test::ElasticCase> all = test::elastic_cases();
  for (test::ElasticCase& c : all) {
    c.model.thickness.resize(c.model.n_particles(), 5e-4);
    c.model.friction.resize(c.model.n_particles(), 0.3);
    c.model.vertex_panel.resize(c.model.n_vertices(), 0);
  }
  auto add = [&](const char* name, const design::Garment& g) {
    test::ElasticCase c;
    c.name = name;
    c.model = test::build(g, 0);
    c.states = {test::crumpled(c.model, 2e-3, 5)};
    all.push_back(c);
  };
  add("folded along a thread", test::ironed({0.08, 0}, {0.08, 0.3}, 1));
  add("folded at a slant", test::ironed({0.03, 0}, {0.17, 0.3}, 1));
  return all;
}

Positions forces(const model::Model& m, const Positions& x) {
  simulator::ElasticModel elastic(m);
  elastic.follow(x);
  Positions f;
  elastic.energy_and_force(x, f);
  return f;
}

Positions restricted(const model::Part& part, const Positions& x) {
  Positions out;
  for (model::Index i : part.particle) out.push_back(x[i]);
  return out;
}

/// Particles within `radius` of `middle`, in the flat pattern.
std::vector<char> patch(const model::Model& m, const model::Vector2d& middle, double radius) {
  std::vector<char> free(m.n_particles(), 0);
  for (std::size_t v = 0; v < m.n_vertices(); ++v)
    if ((m.vertex_uv[v] - middle).norm() < radius) free[m.vertex_particle[v]] = 1;
  return free;
}

test::SheetSpec curtain() {
  test::SheetSpec spec;
  spec.nx = spec.ny = 41;
  return spec;
}

}  // namespace

TEST_CASE("on free particles of a part the same forces act as in the whole garment") {
  std::mt19937 random(11);
  int tested = 0;
  for (const test::ElasticCase& c : cases())
    for (const Positions& x : c.states) {
      INFO(c.name);
      std::vector<char> free(c.model.n_particles());
      for (char& f : free) f = random() % 4 == 0 ? 1 : 0;
      const model::Part part = model::part_of(c.model, free, std::vector<char>(c.model.n_triangles(), 0), x);
      REQUIRE(part.free.size() == part.particle.size());
      const Positions whole = forces(c.model, x), own = forces(part.model, restricted(part, x));
      double largest = 0, off = 0;
      for (std::size_t k = 0; k < part.particle.size(); ++k) {
        REQUIRE(part.model.mass[k] == c.model.mass[part.particle[k]]);
        if (part.free[k] == 0) continue;
        ++tested;
        largest = std::max(largest, whole[part.particle[k]].norm());
        off = std::max(off, (whole[part.particle[k]] - own[k]).norm());
      }
      CHECK(off <= 1e-10 * largest);
    }
  CHECK(tested > 200);
}

TEST_CASE("what moved in a garment at rest settles alone, and all else sleeps") {
  model::Model m = test::make_sheet(curtain());
  test::hold_row(m, curtain(), 40);
  const test::Draped hung = test::drape(m, {}, simulator::Settle::equilibrium);
  REQUIRE(hung.report.status == simulator::DrapeStatus::at_rest);
  Positions x = hung.state.position;
  const std::vector<char> moved = patch(m, {0.2, 0.2}, 0.025);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (moved[i] != 0) x[i].z() += 1e-3;
  simulator::Relaxation whole(m, {}, {});
  Positions force;
  const double before = whole.residual(x, force), energy = whole.energy(x);
  const std::vector<body::Body> nobody;
  const simulator::Mirror no_mirror;
  const simulator::Awake awake(m, nobody, no_mirror, whole);
  Positions settled = x;
  CHECK(awake.settle(whole, hung.state.position, 0.05, settled) > 1);
  int went = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (settled[i] == x[i]) continue;
    ++went;
    CHECK((m.vertex_uv[i] - model::Vector2d(0.2, 0.2)).norm() < 0.06);
  }
  CHECK(went > 20);
  CHECK(whole.energy(settled) < energy);
  CHECK(whole.residual(settled, force) < 0.1 * before);
  // The same from where everything moved is the whole garment's business.
  Positions all = x;
  for (Vector3d& p : all) p.z() += 1e-3;
  Positions kept = all;
  CHECK(awake.settle(whole, hung.state.position, 0.05, kept) == 0);
  CHECK(kept == all);
}

TEST_CASE("cloth that settles alone does not fall through cloth that sleeps") {
  test::SheetSpec spec = curtain();
  spec.plane = test::SheetPlane::horizontal;
  model::Model lower = test::make_sheet(spec), upper = test::make_sheet(spec);
  test::hold_row(lower, spec, 0);
  test::hold_row(lower, spec, 40);
  for (Vector3d& p : upper.start) p.y() += 3e-3;
  model::Model m = test::together(lower, upper);
  m.gravity *= 200;  // what is free is thrown onto the lower sheet
  Positions x = m.start;
  simulator::Relaxation whole(m, {}, {});
  Positions force;
  whole.residual(x, force);
  const std::vector<body::Body> nobody;
  const simulator::Mirror no_mirror;
  const simulator::Awake awake(m, nobody, no_mirror, whole);
  double lowest = 1;
  for (int round = 0; round < 6; ++round) {
    const Positions from = x;
    Positions before = x;
    for (std::size_t i = lower.n_particles(); i < x.size(); ++i)
      if ((m.start[i] - Vector3d(0.2, m.start[i].y(), -0.2)).norm() < 0.03) before[i].y() += 1e-3;
    CHECK(awake.settle(whole, before, 0.05, x) > 0);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (from[i] != x[i]) CHECK((from[i] - x[i]).norm() <= 2.6e-3);  // no farther than it was looked for cloth
    for (std::size_t i = lower.n_particles(); i < x.size(); ++i) lowest = std::min(lowest, x[i].y());
  }
  CHECK(lowest < 1.2e-3);  // it came to lie on the lower sheet
  CHECK(lowest > 0);
  model::State state;
  state.position = x;
  CHECK(simulator::certify(m, state, {}).self_intersections == 0);
}
