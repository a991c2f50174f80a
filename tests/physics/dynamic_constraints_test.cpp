// The source system's method: reactive forces for what is held and tied, impulses for what meets.
#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/base/portable_math.hpp"
#include "runtime/simulator/constraint_steps.hpp"
#include "tests/support/motion_cases.hpp"

namespace {

using namespace garment;
using namespace garment::test;
using Eigen::Vector3d;
using portable::kPi;
using simulator::MotionMethod;

model::Model pendulum(double length, double angle) {
  model::Model m = bead(0.1, length);
  m.start[1] = length * Vector3d(std::sin(angle), -std::cos(angle), 0);
  m.damping.assign(2, 0);
  add_link(m, length);
  return m;
}

}  // namespace

TEST_CASE("constraints: a bead on a link swings as a pendulum and stays on its circle") {
  const double length = 0.5, h = 1e-4, small = 2 * kPi * std::sqrt(length / kGravity);
  const model::Model m = pendulum(length, kPi / 3);
  CHECK(period(m, lasting(2, h, MotionMethod::dynamic_constraints), 1e-3) / small == Approx(1.073182).epsilon(0.005));
  // |C| = tau h v^2 / R, tau = 5 h: with v^2 = g R at the lowest place 5 h^2 g.
  simulator::MotionSettings s = lasting(0.6, h, MotionMethod::dynamic_constraints);
  double worst = 0;
  watch(s, 1e-2, [&](const model::State& now, const simulator::DrapeReport&) {
    worst = std::max(worst, std::abs(now.position[1].norm() - length));
    CHECK(now.position[0].norm() < 1e-12);
  });
  CHECK(move(m, s).report.status == simulator::DrapeStatus::ran);
  CHECK(worst < 10 * h * h * kGravity);
  CHECK(worst < 2e-6 * length);
}

TEST_CASE("constraints: rows that say the same twice give the same motion, and are counted") {
  const model::Model once = pendulum(0.5, 1);
  model::Model twice = once;
  add_link(twice, 0.5);
  hold_point(twice, 0);
  const std::vector<body::Body> no_bodies;  // the cloth keeps a reference
  simulator::MovingCloth cloth(twice, no_bodies, false, 0, simulator::MovingCloth::Acts::without_constraints);
  simulator::ConstraintSteps steps(cloth, twice);
  simulator::MotionState state;
  state.x = twice.start;
  state.v.assign(2, Vector3d::Zero());
  REQUIRE(steps.step(state, 1e-4).done);
  CHECK(steps.redundant() == 4);
  const simulator::MotionSettings s = lasting(0.5, 1e-4, MotionMethod::dynamic_constraints);
  const Moved a = move(once, s), b = move(twice, s);
  CHECK((a.state.position[1] - b.state.position[1]).norm() < 1e-7);
}

TEST_CASE("constraints: of two contacts none pulls, where equations would let one") {
  model::Model m = bead(0.01, 0.1);
  const simulator::Holds holds(m);
  auto wall = [](double degrees) {
    simulator::Touching c;
    c.particle[0] = 1;
    c.weight[0] = 1;
    c.normal = Vector3d(std::cos(degrees * kPi / 180), std::sin(degrees * kPi / 180), 0);
    return c;
  };
  // Met at 10 degrees beyond the first wall: solved as equations the second one, at 30 degrees, would have to pull.
  std::vector<Vector3d> v{Vector3d::Zero(), -Vector3d(std::cos(-10 * kPi / 180), std::sin(-10 * kPi / 180), 0)};
  const Vector3d before = v[1];
  const std::vector<simulator::Touching> walls{wall(0), wall(30)};
  simulator::part(m, holds, walls, 1e-3, v);
  CHECK(v[1].isApprox(before - before.x() * Vector3d::UnitX(), 1e-9));
  CHECK(v[1].dot(walls[1].normal) > 0);
  CHECK(v[0].isZero());
}

TEST_CASE("constraints: a hanging strip comes to rest as by the default solver, and its clamp bears its weight") {
  test::SheetSpec spec;
  spec.nx = 3;
  spec.ny = 6;
  spec.stretch = 20;
  spec.shear = 5;
  model::Model m = make_sheet(spec);
  hold_row(m, spec, spec.ny - 1);
  m.holders.push_back({"top", {}, {15, 16, 17}});
  m.damping.assign(m.n_particles(), 1e-3);
  const Moved d = move(m, lasting(1, 0, MotionMethod::dynamic_constraints));
  REQUIRE(d.report.status == simulator::DrapeStatus::ran);
  const double L = 5 * spec.h, w = spec.density * kGravity;
  CHECK(-d.state.position[1].y() == Approx(w * L * L / (2 * spec.stretch)).epsilon(0.01));
  double weight = 0;
  for (double mass : m.mass) weight += mass * kGravity;
  CHECK(d.report.reactions[0].y() == Approx(weight).epsilon(0.01));
}

TEST_CASE("constraints: a sheet on an incline sticks and slides as it must") {
  const double mu = 0.3;
  auto speed = [&](double share) {
    test::SheetSpec spec;
    spec.nx = spec.ny = 4;
    spec.h = 0.02;
    spec.friction = mu;
    spec.stretch = spec.shear = 20;
    spec.plane = SheetPlane::horizontal;
    model::Model m = make_sheet(spec);
    for (Vector3d& p : m.start) p.y() = 1.75e-3;
    const double a = std::atan(share * mu);
    m.gravity = kGravity * Vector3d(std::sin(a), -std::cos(a), 0);
    m.damping.assign(m.n_particles(), 1e-3);
    simulator::MotionSettings s = lasting(0.3, 0, MotionMethod::dynamic_constraints);
    std::vector<double> speeds;
    watch(s, 0.1, [&](const model::State& now, const simulator::DrapeReport&) { speeds.push_back(mean(now.velocity).x()); });
    REQUIRE(move(m, s, {floor_of(mu)}).report.status == simulator::DrapeStatus::ran);
    return (speeds[3] - speeds[1]) / 0.2;
  };
  CHECK(std::abs(speed(0.97)) < 1e-6);
  const double a = std::atan(1.03 * mu);
  CHECK(speed(1.03) == Approx(kGravity * (std::sin(a) - mu * std::cos(a))).epsilon(0.01));
}

TEST_CASE("constraints: a taut thread holds what hangs on it, a slack one does nothing") {
  model::Model m = bead(1.0, 0.1);  // 10 N at a button
  m.damping.assign(2, 0);
  add_link(m, 0.1);
  m.rod_tie.clear();
  simulator::MotionSettings s = lasting(0.4, 1e-4, MotionMethod::dynamic_constraints);
  CHECK(-move(m, s).state.position[1].y() == Approx(0.1 + kGravity / m.tie_stiffness[0]).epsilon(1e-5));
  m.start[1].y() = -0.05;
  s.duration = 0.05;
  CHECK(-move(m, s).state.position[1].y() == Approx(0.05 + 0.5 * kGravity * 0.05 * 0.05).epsilon(0.005));
}
