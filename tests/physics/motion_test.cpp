// Cloth in motion: against what mechanics says.
#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/base/parallel.hpp"
#include "runtime/base/portable_math.hpp"
#include "runtime/model/dump.hpp"
#include "runtime/model/motion.hpp"
#include "runtime/simulator/certificate.hpp"
#include "runtime/simulator/explicit_steps.hpp"
#include "runtime/simulator/kelvin_damping.hpp"
#include "tests/support/motion_cases.hpp"
#include "tests/support/two_sheets.hpp"

namespace {

using namespace garment;
using namespace garment::test;
using Eigen::Vector3d;
using portable::kPi;
using simulator::MotionMethod;

Vector3d momentum(const model::Model& m, const Vectors& v) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < v.size(); ++i) sum += m.mass[i] * v[i];
  return sum;
}

}  // namespace

TEST_CASE("moved: cloth in free flight follows the parabola of the integrator") {
  test::SheetSpec spec;
  spec.nx = spec.ny = 6;
  const model::Model m = test::make_sheet(spec);
  const Vector3d v0(1.5, 3, -0.5), g = m.gravity;
  const Vectors v(m.n_particles(), v0);
  const double h = 1.0 / 240, t = 0.5;
  const Moved implicit = move(m, lasting(t, h), {}, v);
  REQUIRE(implicit.report.status == simulator::DrapeStatus::ran);
  CHECK(implicit.report.motion.steps == 120);
  CHECK(implicit.state.time == Approx(t));
  // BDF2 is exact on parabolas; the first step, implicit Euler, leaves 3/4 h^2 g.
  const Vector3d exact = v0 * t + 0.5 * t * t * g;
  for (std::size_t i = 0; i < m.n_particles(); ++i) {
    CHECK((implicit.state.velocity[i] - v0 - t * g).norm() < 1e-9);
    CHECK((implicit.state.position[i] - m.start[i] - exact - 0.75 * h * h * g).norm() < 1e-9);
  }
  // Symplectic Euler: x_n = x_0 + n h v_0 + h^2 n (n + 1) / 2 g.
  model::Model soft = m;
  soft.damping.assign(m.n_particles(), 0);
  const double tiny = 2e-5;
  const Moved by_parts = move(soft, lasting(0.01, tiny, MotionMethod::explicit_steps), {}, v);
  REQUIRE(by_parts.report.status == simulator::DrapeStatus::ran);
  const double n = by_parts.report.motion.steps;
  CHECK(n == 500);
  for (std::size_t i = 0; i < m.n_particles(); ++i)
    CHECK((by_parts.state.position[i] - m.start[i] - n * tiny * v0 - tiny * tiny * n * (n + 1) / 2 * g).norm() < 1e-11);
}

TEST_CASE("moved: a semi-implicit step is one solution of the linearised implicit Euler step") {
  test::SheetSpec spec;
  spec.nx = spec.ny = 6;
  model::Model m = test::make_sheet(spec);
  const double h = 1.0 / 60;
  // In free flight it is implicit Euler: after n steps h^2 n (n + 1) / 2 g.
  const Moved flight = move(m, lasting(0.5, h, MotionMethod::semi_implicit));
  REQUIRE(flight.report.status == simulator::DrapeStatus::ran);
  const double n = flight.report.motion.steps;
  CHECK(n == 30);
  for (std::size_t i = 0; i < m.n_particles(); ++i)
    CHECK((flight.state.position[i] - m.start[i] - h * h * n * (n + 1) / 2 * m.gravity).norm() < 1e-8);
  // Held at one side it swings and hangs: in the end where the converged method hangs, by one solution a step.
  for (int k = 0; k < spec.ny; ++k) {
    m.hold_particle.push_back(k);
    m.hold_kind.push_back(model::HoldKind::point);
    m.hold_point.push_back(m.start[k]);
    m.hold_normal.push_back(Vector3d(0, 1, 0));
  }
  simulator::MotionSettings settings = lasting(6, h, MotionMethod::semi_implicit);
  settings.tolerance = 5e-3;
  const Moved hung = move(m, settings);
  REQUIRE(hung.report.status == simulator::DrapeStatus::ran);
  CHECK(hung.report.motion.iterations < 1.5 * hung.report.motion.steps);
  simulator::MotionSettings whole = lasting(6, h);
  whole.tolerance = 5e-3;
  const Moved exact = move(m, whole);
  REQUIRE(exact.report.status == simulator::DrapeStatus::ran);
  CHECK((mean(hung.state.position) - mean(exact.state.position)).norm() < 2e-3);
  const auto& balance = hung.report.motion.balance;
  CHECK(balance.change() < 0);  // it hangs lower, and the steps win nothing
}

TEST_CASE("moved: a bead on a rigid link swings with the period of a pendulum") {
  const double length = 0.5, angle = kPi / 3;
  model::Model m = bead(0.1, length);
  m.start[1] = length * Vector3d(std::sin(angle), -std::cos(angle), 0);
  add_link(m, length);
  m.damping.assign(2, 0);
  const double small = 2 * kPi * std::sqrt(length / kGravity);
  CHECK(period(m, lasting(2, 1.0 / 1000), 1.0 / 1000) / small == Approx(1.073182).epsilon(0.005));
}

TEST_CASE("moved: a spring with a damper swings and dies away as it must") {
  const double tau = 0.004, mass = 0.02;
  model::Model m = bead(mass, 0.1);
  m.gravity.setZero();
  m.spring.push_back({0, 1});
  m.spring_rest.push_back(0.1);
  m.spring_width.push_back(0.1);
  m.spring_law.push_back(0);
  m.spring_panel.push_back(0);
  m.damping.assign(2, tau);
  m.start[1].y() = -0.11;
  const double k = 100 * 0.1 / 0.1, omega = std::sqrt(k / mass), zeta = omega * tau / 2;
  const double period = 2 * kPi / (omega * std::sqrt(1 - zeta * zeta));
  for (MotionMethod method : {MotionMethod::implicit, MotionMethod::explicit_steps}) {
    const double h = period / (method == MotionMethod::implicit ? 1000 : 4000);
    const Moved moved = move(m, lasting(2 * period, h, method));
    REQUIRE(moved.report.status == simulator::DrapeStatus::ran);
    const double expected = 0.01 * std::exp(-zeta * omega * 2 * period);
    CHECK(-moved.state.position[1].y() - 0.1 == Approx(expected).epsilon(0.02));
    const simulator::EnergyBalance& b = moved.report.motion.balance;
    CHECK(b.stored_start == Approx(0.5 * k * 1e-4).epsilon(1e-6));
    CHECK(b.change() == Approx(b.work - b.damping - b.friction - b.numerical));
    CHECK(b.damping == Approx(b.stored_start - b.kinetic - b.stored).epsilon(0.02));
    CHECK(std::abs(b.numerical) < 0.02 * b.stored_start);
  }
}

TEST_CASE("moved: the steps' own loss is told, and goes with the step") {
  test::SheetSpec spec;
  spec.nx = 3;
  spec.ny = 11;
  model::Model m = test::make_sheet(spec);
  test::hold_upper_corners(m, spec);
  for (Vector3d& p : m.start) p = Vector3d(p.x(), 0.1 + 0.8 * (p.y() - 0.1), 0.6 * (0.1 - p.y()));  // held aside, let go
  auto loss = [&](double h) {
    const Moved moved = move(m, lasting(0.2, h));
    REQUIRE(moved.report.status == simulator::DrapeStatus::ran);
    const simulator::EnergyBalance& b = moved.report.motion.balance;
    CHECK(b.change() == Approx(b.work - b.damping - b.friction - b.numerical).margin(1e-12));
    CHECK(b.kinetic > 0);
    CHECK(std::abs(b.work) < 1e-9);  // holds that stand do none
    return b.numerical;
  };
  const double coarse = loss(1.0 / 240), fine = loss(1.0 / 960);
  INFO("lost " << coarse << " J at 1/240 s, " << fine << " J at 1/960 s");
  CHECK(fine < 0.5 * coarse);
}

TEST_CASE("moved: damping does not change where cloth comes to rest") {
  test::SheetSpec spec;
  spec.nx = 3;
  spec.ny = 11;
  spec.stretch = 20;
  model::Model m = test::make_sheet(spec);
  test::hold_row(m, spec, spec.ny - 1);
  const double L = 10 * spec.h, expected = spec.density * kGravity * L * L / (2 * spec.stretch);
  for (double tau : {0.02, 0.1}) {
    m.damping.assign(m.n_particles(), tau);
    const Moved moved = move(m, lasting(2, 1.0 / 240));
    REQUIRE(moved.report.status == simulator::DrapeStatus::ran);
    CHECK(-moved.state.position[1].y() == Approx(expected).epsilon(0.01));
  }
}

TEST_CASE("moved: dampers have a gradient, sum to nothing, and leave rigid motions alone") {
  test::SheetSpec spec;
  spec.nx = spec.ny = 4;
  const model::Model m = test::make_sheet(spec);
  const simulator::ElasticModel elastic(m);
  simulator::KelvinDamping damping(m, elastic);
  Vectors x = m.start;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += 1e-3 * Vector3d(std::sin(3.1 * i), std::cos(1.7 * i), std::sin(0.9 * i + 1));
  damping.begin(x);
  const Eigen::Matrix3d turn = model::rotation({0.3, -0.5, 0.8});
  Vectors turned = x, force(x.size(), Vector3d::Zero());
  for (Vector3d& p : turned) p = turn * p + Vector3d(0.1, 0.2, 0.3);
  const double h = 1.0 / 240;
  CHECK(damping.add_force(turned, h, force) < 1e-18);
  for (const Vector3d& f : force) CHECK(f.norm() < 1e-9);
  Vectors y = turned;
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += 2e-4 * Vector3d(std::cos(2.3 * i), std::sin(4.1 * i), std::cos(0.3 * i));
  force.assign(x.size(), Vector3d::Zero());
  damping.add_force(y, h, force);
  Vector3d sum = Vector3d::Zero(), torque = Vector3d::Zero();
  double largest = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    sum += force[i];
    torque += y[i].cross(force[i]);
    largest = std::max(largest, force[i].norm());
  }
  CHECK(sum.norm() < 1e-11 * largest);
  CHECK(torque.norm() < 1e-11 * largest);
  for (std::size_t i : {0, 5, 10})
    for (int axis = 0; axis < 3; ++axis) {
      Vectors low = y, high = y;
      low[i][axis] -= 1e-7;
      high[i][axis] += 1e-7;
      CHECK(force[i][axis] == Approx((damping.potential(low, h) - damping.potential(high, h)) / 2e-7).epsilon(1e-4).margin(1e-6 * largest));
    }
}

TEST_CASE("moved: a sheet on an incline sticks below the angle of friction, and slides above it as mechanics says") {
  const double mu = 0.3;
  auto slide = [&](double share) {
    test::SheetSpec spec;
    spec.nx = spec.ny = 6;
    spec.h = 0.02;
    spec.friction = mu;
    spec.plane = test::SheetPlane::horizontal;
    model::Model m = test::make_sheet(spec);
    for (Vector3d& p : m.start) p.y() = 1.75e-3;
    const double a = std::atan(share * mu);
    m.gravity = kGravity * Vector3d(std::sin(a), -std::cos(a), 0);
    simulator::MotionSettings s = lasting(0.6, 1.0 / 240);
    std::vector<double> speed, place;
    watch(s, 0.2, [&](const model::State& now, const simulator::DrapeReport&) {
      speed.push_back(mean(now.velocity).x());
      place.push_back(mean(now.position).x());
    });
    const Moved moved = move(m, s, {floor_of(mu)});
    REQUIRE(moved.report.status == simulator::DrapeStatus::ran);
    REQUIRE(speed.size() == 4);
    // It begins to move a little before the floor has taken its weight; what sticks comes to a stand after that.
    return std::pair((speed[3] - speed[2]) / 0.2, place[3] - place[2]);
  };
  const auto [stuck, crept] = slide(0.97);
  CHECK(std::abs(stuck) < 1e-6);
  CHECK(std::abs(crept) < 1e-8);
  const auto [sliding, slid] = slide(1.03);
  const double a = std::atan(1.03 * mu);
  CHECK(sliding == Approx(kGravity * (std::sin(a) - mu * std::cos(a))).epsilon(0.01));
  CHECK(slid > 1e-3);
}

TEST_CASE("moved: cloth lies still on cloth below the angle of their friction, and slides above it") {
  const double mu = 0.4;
  auto slide = [&](double share) {
    test::SheetSpec under;
    under.nx = under.ny = 13;
    under.plane = SheetPlane::horizontal;
    model::Model table = make_sheet(under);
    for (int j = 0; j < under.ny; ++j) hold_row(table, under, j);
    test::SheetSpec over = under;
    over.nx = over.ny = 6;
    model::Model sheet = make_sheet(over);
    for (Vector3d& p : sheet.start) p += Vector3d(0.022, 1.15e-3, -0.033);
    model::Model m = together(table, sheet);
    const double a = std::atan(share * mu);
    m.gravity = kGravity * Vector3d(std::sin(a), -std::cos(a), 0);
    m.rub_panels.push_back({0, 1});
    m.rub_panels_factor.push_back(mu);
    simulator::MotionSettings s = lasting(0.15, 1.0 / 480);
    s.tolerance = 1e-3;
    std::vector<double> speed;
    watch(s, 0.05, [&](const model::State& now, const simulator::DrapeReport&) {
      speed.push_back(mean(Vectors(now.velocity.begin() + 169, now.velocity.end())).x());
    });
    REQUIRE(move(m, s).report.status == simulator::DrapeStatus::ran);
    return std::pair(speed[3], (speed[3] - speed[1]) / 0.1);
  };
  CHECK(std::abs(slide(0.8).first) < 1e-3);
  const double a = std::atan(1.3 * mu);
  CHECK(slide(1.3).second == Approx(kGravity * (std::sin(a) - mu * std::cos(a))).epsilon(0.05));
}

TEST_CASE("moved: cloth thrown at cloth keeps its momentum, and passes through nothing") {
  test::SheetSpec spec;
  spec.nx = spec.ny = 6;
  const model::Model one = test::make_sheet(spec);
  model::Model other = one;
  for (Vector3d& p : other.start) p += Vector3d(0.003, 0.004, 0.01);
  model::Model m = test::together(one, other);
  m.gravity.setZero();
  Vectors v(m.n_particles(), Vector3d(0.1, 0, 0.5));
  for (std::size_t i = one.n_particles(); i < v.size(); ++i) v[i] = Vector3d(0, -0.1, -0.4);
  const Vector3d before = momentum(m, v);
  simulator::MotionSettings s = lasting(0.1, 1.0 / 480);
  s.tolerance = 1e-9;
  const Moved moved = move(m, s, {}, v);
  INFO(moved.report.motion.steps << " steps, shortest " << moved.report.motion.least_step);
  REQUIRE(moved.report.status == simulator::DrapeStatus::ran);
  CHECK((momentum(m, moved.state.velocity) - before).norm() < 1e-6 * before.norm() + 1e-9);
  CHECK(simulator::certify(m, moved.state, {}).clean());
  // They met: neither goes on as it began.
  CHECK(mean(Vectors(moved.state.velocity.begin(), moved.state.velocity.begin() + 36)).z() < 0.4);
  const simulator::EnergyBalance& b = moved.report.motion.balance;
  CHECK(b.kinetic < b.kinetic_start);
}

TEST_CASE("moved: explicit steps keep momentum and turn to rounding, and are refused beyond their bound") {
  test::SheetSpec spec;
  spec.nx = spec.ny = 5;
  model::Model m = test::make_sheet(spec);
  m.gravity.setZero();
  m.damping.assign(m.n_particles(), 1e-5);
  Vectors v;
  for (const Vector3d& p : m.start) v.push_back(Vector3d(0.2, -0.1, 5 * (p.x() - 0.02) * 0.2));
  const Moved moved = move(m, lasting(0.01, 0, MotionMethod::explicit_steps), {}, v);
  REQUIRE(moved.report.status == simulator::DrapeStatus::ran);
  const double bound = moved.report.motion.stable_step;
  CHECK(bound > 1e-6);
  CHECK(bound < 1e-3);
  CHECK((momentum(m, moved.state.velocity) - momentum(m, v)).norm() < 1e-12 * momentum(m, v).norm() + 1e-16);
  CHECK(std::abs(moved.report.motion.balance.numerical) < 0.02 * moved.report.motion.balance.kinetic_start);
  const Moved refused = move(m, lasting(0.01, 1.2 * bound, MotionMethod::explicit_steps), {}, v);
  REQUIRE(refused.report.findings.size() == 1);
  CHECK(refused.report.findings[0].code == "G0806");
  CHECK(refused.state.position == m.start);
  CHECK(simulator::stability_bound(100, 0) == Approx(0.02));
  CHECK(simulator::stability_bound(100, 0.02) == Approx(0.02 * (std::sqrt(2.0) - 1)));
}

TEST_CASE("moved: a clamp on a path pulls a strip, and tells the force") {
  test::SheetSpec spec;
  spec.nx = 6;
  spec.ny = 11;
  spec.stretch = 500;
  model::Model m = test::make_sheet(spec);
  m.gravity.setZero();
  test::hold_row(m, spec, spec.ny - 1);
  test::hold_row(m, spec, 0);
  m.holders.push_back({"top", {}, {m.hold_particle.begin(), m.hold_particle.begin() + 6}});
  m.holders.push_back({"jaw", {}, {m.hold_particle.begin() + 6, m.hold_particle.end()}});
  std::sort(m.holders[0].particles.begin(), m.holders[0].particles.end());
  m.motions.push_back({"pull", {}, -1, Vector3d(0.025, 0, 0), {{0, {0, 0, 0}, {0, 0, 0}}, {1, {0, -5e-3, 0}, {0, 0, 0}}}});
  for (model::Index h = 6; h < 12; ++h) {
    m.moved_hold.push_back(h);
    m.moved_by.push_back(0);
  }
  const double full = 500 * 0.05 * 0.05;  // N, K eps width at the end
  for (MotionMethod method : {MotionMethod::quasi_static, MotionMethod::implicit}) {
    simulator::MotionSettings s = lasting(method == MotionMethod::implicit ? 1.5 : 1, method == MotionMethod::implicit ? 1.0 / 120 : 0.1, method);
    std::vector<double> force;
    watch(s, 0.5, [&](const model::State&, const simulator::DrapeReport& r) { force.push_back(r.reactions[0].y()); });
    const Moved moved = move(m, s);
    INFO((method == MotionMethod::implicit ? "implicit" : "quasi-static"));
    REQUIRE(moved.report.status == simulator::DrapeStatus::ran);
    CHECK(moved.state.position[0].y() == Approx(-5e-3));
    CHECK(std::abs(force[0]) < 1e-9);
    CHECK(force[1] == Approx(full / 2).epsilon(method == MotionMethod::implicit ? 0.05 : 0.01));
    CHECK(moved.report.reactions[0].y() == Approx(full).epsilon(0.01));
    CHECK(moved.report.reactions[1].y() == Approx(-full).epsilon(0.01));
    if (method == MotionMethod::implicit)  // half of what it holds now, the rest went into the damper
      CHECK(moved.report.motion.balance.work > moved.report.motion.balance.stored);
  }
}

TEST_CASE("moved: a body on a path takes along by friction what lies on it") {
  test::SheetSpec spec;
  spec.nx = spec.ny = 6;
  spec.h = 0.02;
  spec.friction = 0.5;
  spec.plane = test::SheetPlane::horizontal;
  model::Model m = test::make_sheet(spec);
  for (Vector3d& p : m.start) p.y() = 1.75e-3;
  m.motions.push_back({"belt", {}, 0, Vector3d::Zero(), {{0, {0, 0, 0}, {0, 0, 0}}, {1, {0.2, 0, 0}, {0, 0, 0}}}});
  const Moved moved = move(m, lasting(0.5, 1.0 / 240), {floor_of(0.5)});
  REQUIRE(moved.report.status == simulator::DrapeStatus::ran);
  CHECK(mean(moved.state.velocity).x() == Approx(0.2).epsilon(0.01));
  // It slipped until it was as fast: by v^2 / (2 mu g).
  CHECK(mean(moved.state.position).x() - mean(m.start).x() == Approx(0.1 - 0.04 / (2 * 0.5 * kGravity)).epsilon(0.02));
  const simulator::EnergyBalance& b = moved.report.motion.balance;
  CHECK(b.work == Approx(2 * b.kinetic).epsilon(0.1));      // of a belt: half goes to the cloth,
  CHECK(b.friction == Approx(b.kinetic).epsilon(0.15));     // half to heat
}

TEST_CASE("moved: a sheet that falls in air comes to its final speed") {
  test::SheetSpec spec;
  spec.nx = spec.ny = 6;
  spec.plane = test::SheetPlane::horizontal;
  spec.bend = 1e-2;  // a board
  model::Model m = test::make_sheet(spec);
  m.air.drag = 1.2;
  const Moved moved = move(m, lasting(2, 1.0 / 240));
  INFO("residual " << moved.report.residual << " at " << moved.state.time << " s");
  REQUIRE(moved.report.status == simulator::DrapeStatus::ran);
  CHECK(-mean(moved.state.velocity).y() == Approx(std::sqrt(spec.density * kGravity / (0.5 * 1.204 * 1.2))).epsilon(0.01));
}

TEST_CASE("moved: any number of threads gives the same motion") {
  test::SheetSpec spec;
  spec.nx = spec.ny = 33;
  spec.plane = test::SheetPlane::horizontal;
  model::Model m = test::make_sheet(spec);
  for (Vector3d& p : m.start) p += Vector3d(-0.15, 0.105, 0.17);
  design::Body declared;
  declared.name = "ball";
  declared.shape = design::Sphere{0.1};
  body::BodyResult built = body::build_body(declared, system_host(), "");
  REQUIRE(built.body);
  const std::vector<body::Body> bodies{std::move(*built.body)};
  simulator::MotionSettings s = lasting(0.1, 1.0 / 120);
  s.tolerance = 1e-3;
  const int before = thread_count();
  std::vector<std::string> hashes;
  for (int threads : {1, 2, 4}) {
    set_thread_count(threads);
    const Moved moved = move(m, s, bodies);
    CHECK(moved.report.status == simulator::DrapeStatus::ran);
    hashes.push_back(model::hash_text(model::state_hash(moved.state)));
  }
  set_thread_count(before);
  CHECK(hashes[0] == hashes[1]);
  CHECK(hashes[0] == hashes[2]);
}

TEST_CASE("moved: what cannot move says why, and the last good state is kept") {
  test::SheetSpec spec;
  spec.nx = spec.ny = 4;
  model::Model open = test::make_sheet(spec);
  open.start[0].x() -= 0.05;
  const Moved refused = move(open, lasting(0.1, 0));
  REQUIRE(refused.report.findings.size() == 1);
  CHECK(refused.report.findings[0].code == "G0805");
  model::Model heavy = test::make_sheet(spec);
  heavy.gravity = Vector3d(0, -1e306, 0);
  const Moved stuck = move(heavy, lasting(0.1, 0));
  CHECK(stuck.report.status == simulator::DrapeStatus::diverged);
  REQUIRE(stuck.report.findings.size() == 1);
  CHECK(stuck.report.findings[0].code == "G0807");
  for (const Vector3d& p : stuck.state.position) CHECK(p.allFinite());
  const model::Model m = test::make_sheet(spec);
  model::Model under = m;  // held below the ground
  for (Vector3d& p : under.start) p.y() -= 0.02;
  for (int j = 0; j < spec.ny; ++j) hold_row(under, spec, j);
  const Moved cut = move(under, lasting(0.01, 0), {floor_of(0.3)});
  CHECK(cut.report.status == simulator::DrapeStatus::ran);
  REQUIRE(cut.report.findings.size() == 1);
  CHECK(cut.report.findings[0].code == "G0808");
  simulator::MotionSettings s = lasting(1, 1.0 / 240);
  int asked = 0;
  s.interrupted = [&] { return ++asked > 10; };
  const Moved stopped = move(m, s);
  CHECK(stopped.report.status == simulator::DrapeStatus::interrupted);
  CHECK(stopped.state.time == Approx(10.0 / 240));
  CHECK(stopped.report.motion.seconds == Approx(10.0 / 240));
}
