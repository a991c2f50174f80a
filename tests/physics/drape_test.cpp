// Known rest states through the whole drape: the solver, contact and friction must lead to what the forces
// alone give (forces_test.cpp) and to what the textbooks say.
#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/base/host.hpp"
#include "runtime/body/body.hpp"
#include "runtime/simulator/certificate.hpp"
#include "runtime/simulator/elastic.hpp"
#include "tests/support/clamped_strip.hpp"
#include "tests/support/draped.hpp"

namespace {

using namespace garment;
using Eigen::Vector3d;
using test::clamped_strip;
using test::drape;
using test::Draped;
using test::kGravity;

/// Elastic force and weight on each particle, N: what holds and bodies must bear.
std::vector<Vector3d> loads(const model::Model& m, const std::vector<Vector3d>& x) {
  std::vector<Vector3d> force;
  simulator::ElasticModel(m).energy_and_force(x, force);
  for (std::size_t i = 0; i < force.size(); ++i) force[i] += m.mass[i] * m.gravity;
  return force;
}

double weight(const model::Model& m) {
  double sum = 0;
  for (double mass : m.mass) sum += mass * m.gravity.norm();
  return sum;
}

body::Body body_of(const design::Body& declared) {
  body::BodyResult built = body::build_body(declared, system_host(), "");
  REQUIRE(built.body);
  return std::move(*built.body);
}

}  // namespace

TEST_CASE("draped: a hanging strip stretches by w L^2 / 2K and pulls with its weight") {
  test::SheetSpec spec;
  spec.nx = 3;
  spec.ny = 41;
  spec.stretch = 20;
  model::Model m = test::make_sheet(spec);
  test::hold_row(m, spec, spec.ny - 1);
  const Draped d = drape(m, {}, simulator::Settle::exact);
  INFO("steps " << d.report.steps << ", residual " << d.report.residual);
  REQUIRE(d.report.status == simulator::DrapeStatus::at_rest);
  const double L = 40 * spec.h, w = spec.density * kGravity;
  double low = 0;
  for (const Vector3d& p : d.state.position) low = std::min(low, p.y());
  CHECK(-low == Approx(w * L * L / (2 * spec.stretch)).epsilon(0.01));
  const std::vector<Vector3d> load = loads(m, d.state.position);
  Vector3d pull = Vector3d::Zero();
  for (model::Index p : m.hold_particle) pull += load[p];
  CHECK(-pull.y() == Approx(weight(m)).epsilon(1e-5));
}

TEST_CASE("draped: a stiff strip between two points hangs as a catenary") {
  test::SheetSpec spec;
  spec.nx = 101;
  spec.ny = 2;
  spec.h = 0.01;
  spec.stretch = 5e4;
  spec.bend = 1e-9;
  spec.plane = test::SheetPlane::horizontal;
  model::Model m = test::make_sheet(spec);
  for (Vector3d& p : m.start) {  // between supports 0.8 m apart, on a parabola
    const double s = p.x() - 0.5;
    p = {0.8 * s, 0.26 * (4 * s * s - 1), p.z()};
  }
  test::hold_column(m, spec, 0);
  test::hold_column(m, spec, 100);
  const Draped d = drape(m, {}, simulator::Settle::exact);
  INFO("steps " << d.report.steps << ", residual " << d.report.residual);
  REQUIRE(d.report.status == simulator::DrapeStatus::at_rest);
  double low = 0;
  for (const Vector3d& p : d.state.position) low = std::min(low, p.y());
  CHECK(-low == Approx(0.265438).epsilon(0.005));
  const std::vector<Vector3d> load = loads(m, d.state.position);
  double pull = 0;
  for (int j = 0; j < 2; ++j) pull -= load[test::sheet_particle(spec, 100, j)].x();
  CHECK(pull ==
        Approx(0.338202 * spec.density * kGravity * spec.h).epsilon(0.005));  // the strip is one cell wide
}

TEST_CASE("draped: a cantilever follows the elastica") {
  // H: drop of the tip, W: its distance from the clamp; Gamma = w L^3 / B.
  const double table[][2] = {{1, 0.12456}, {5, 0.58572}, {10, 1.06680}, {20, 1.86393}};
  for (const auto& [gamma, expected] : table) {
    test::SheetSpec spec;
    const model::Model m = clamped_strip(spec, 40, 0.2, gamma, 1e-5);
    const Draped d = drape(m, {}, simulator::Settle::exact);
    INFO("Gamma " << gamma << ", steps " << d.report.steps << ", residual " << d.report.residual);
    CHECK(d.report.status == simulator::DrapeStatus::at_rest);
    const std::vector<Vector3d>& x = d.state.position;
    const Vector3d tip = x[test::sheet_particle(spec, spec.nx - 1, 0)] - x[test::sheet_particle(spec, 1, 0)];
    CHECK(-tip.y() / tip.x() == Approx(expected).epsilon(0.02));
  }
}

TEST_CASE("draped: a sheet over a ball rests on it with its whole weight") {
  test::SheetSpec spec;
  spec.nx = spec.ny = 21;
  spec.h = 0.02;
  spec.plane = test::SheetPlane::horizontal;
  model::Model m = test::make_sheet(spec);
  for (Vector3d& p : m.start) p += Vector3d(-0.2, 0.103, 0.2);
  design::Body declared;
  declared.name = "ball";
  declared.shape = design::Sphere{0.1};
  const std::vector<body::Body> bodies{body_of(declared)};
  const Draped d = drape(m, bodies, simulator::Settle::equilibrium);
  INFO("steps " << d.report.steps << ", residual " << d.report.residual);
  REQUIRE(d.report.status == simulator::DrapeStatus::at_rest);
  CHECK(simulator::certify(m, d.state, bodies).clean());
  const std::vector<Vector3d> load = loads(m, d.state.position);
  const double mean_weight = weight(m) / static_cast<double>(m.n_particles());
  Vector3d on_ball = Vector3d::Zero();
  double free_squares = 0;
  int n_free = 0, n_touching = 0;
  for (std::size_t i = 0; i < m.n_particles(); ++i) {
    if (d.state.position[i].norm() < 0.104) {
      on_ball += load[i];
      ++n_touching;
    } else {
      free_squares += load[i].squaredNorm();
      ++n_free;
    }
  }
  INFO(n_touching << " touch, " << n_free << " hang free");
  REQUIRE(n_touching > 5);
  REQUIRE(n_free > 100);
  CHECK(-on_ball.y() == Approx(weight(m)).epsilon(0.02));
  CHECK(std::hypot(on_ball.x(), on_ball.z()) < 0.02 * weight(m));
  CHECK(std::sqrt(free_squares / n_free) < 0.1 * mean_weight);
}

TEST_CASE("draped: a sheet on an incline sticks below the angle of friction and slides above it") {
  const double mu = 0.3;
  auto on_incline = [&](double share, int most_steps) {
    test::SheetSpec spec;
    spec.nx = spec.ny = 6;
    spec.h = 0.02;
    spec.friction = mu;
    spec.plane = test::SheetPlane::horizontal;
    model::Model m = test::make_sheet(spec);
    for (Vector3d& p : m.start) p.y() = 1.5e-3;
    const double a = std::atan(share * mu);
    m.gravity =
        kGravity * Vector3d(std::sin(a), -std::cos(a), 0);  // the plane stays level, gravity is tilted
    design::Body declared;
    declared.name = "plane";
    declared.shape = design::Floor{};
    declared.friction = mu;
    const Draped d = drape(m, {body_of(declared)}, simulator::Settle::exact, most_steps);
    double moved = 0;
    for (std::size_t i = 0; i < m.n_particles(); ++i)
      moved += (d.state.position[i] - m.start[i]).x() / static_cast<double>(m.n_particles());
    return std::pair(d.report, moved);
  };
  const auto [sticking, stuck] = on_incline(0.9, 150);
  INFO("0.9 mu: " << sticking.steps << " steps, residual " << sticking.residual << ", moved " << stuck
                  << " m");
  CHECK(sticking.status == simulator::DrapeStatus::at_rest);
  CHECK(std::abs(stuck) < 1e-6);
  const auto [sliding, slid] = on_incline(1.1, 150);
  INFO("1.1 mu: " << sliding.steps << " steps, residual " << sliding.residual << ", moved " << slid << " m");
  CHECK(sliding.status == simulator::DrapeStatus::not_settled);
  CHECK(slid > 2e-5);
  // What friction cannot bear is left as residual, and what it does bear says which coefficient acts: looked at while the sheet
  // only creeps, for later it goes with its momentum and does not press the ground evenly.
  const auto [creeping, crept] = on_incline(1.1, 16);
  INFO("at first residual " << creeping.residual << ", moved " << crept << " m");
  const double a = std::atan(1.1 * mu);
  CHECK((std::sin(a) - creeping.residual) / std::cos(a) == Approx(mu).epsilon(0.02));
}

TEST_CASE("draped: a sheet that lies on the floor is at rest") {
  test::SheetSpec spec;
  spec.nx = spec.ny = 6;
  spec.h = 0.02;
  spec.plane = test::SheetPlane::horizontal;
  model::Model m = test::make_sheet(spec);
  for (Vector3d& p : m.start) p.y() = 2e-3;
  design::Body declared;
  declared.name = "ground";
  declared.shape = design::Floor{};
  const Draped d = drape(m, {body_of(declared)}, simulator::Settle::exact, 150);
  INFO("steps " << d.report.steps << ", residual " << d.report.residual << ", step " << d.report.newton_step);
  CHECK(d.report.status == simulator::DrapeStatus::at_rest);
  CHECK(d.report.residual < 1e-6);
}

TEST_CASE("draped: cloth held inside a body is told as tangled, and its state is kept") {
  test::SheetSpec spec;
  spec.nx = spec.ny = 5;
  spec.h = 0.02;
  spec.plane = test::SheetPlane::horizontal;
  model::Model m = test::make_sheet(spec);
  for (Vector3d& p : m.start) p += Vector3d(-0.04, 0, 0.04);
  test::hold_point(m, test::sheet_particle(spec, 2, 2));  // at the centre of the ball
  design::Body declared;
  declared.name = "ball";
  declared.shape = design::Sphere{0.1};
  const Draped d = drape(m, {body_of(declared)}, simulator::Settle::preview, 300);
  CHECK((d.report.status == simulator::DrapeStatus::tangled ||
         d.report.status == simulator::DrapeStatus::not_settled));
  CHECK(d.report.inside_body > 0);
  REQUIRE(d.report.findings.size() >= 1);
  CHECK(d.report.findings[0].code ==
        (d.report.status == simulator::DrapeStatus::tangled ? "G0801" : "G0802"));
  for (const Vector3d& p : d.state.position) CHECK(p.allFinite());
}

TEST_CASE("draped: a load beyond all numbers keeps the last finite state") {
  test::SheetSpec spec;
  spec.nx = spec.ny = 4;
  model::Model m = test::make_sheet(spec);
  test::hold_upper_corners(m, spec);
  m.gravity = Vector3d(0, -1e306, 0);
  const Draped d = drape(m, {}, simulator::Settle::preview, 100);
  CHECK(d.report.status != simulator::DrapeStatus::at_rest);
  REQUIRE(d.report.findings.size() == 1);
  CHECK(d.report.findings[0].code ==
        (d.report.status == simulator::DrapeStatus::diverged ? "G0803" : "G0802"));
  for (const Vector3d& p : d.state.position) CHECK(p.allFinite());
}
