// Forces, pressure, air, bilateral constraints and friction of pairs, at rest: against formulas.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "runtime/base/host.hpp"
#include "runtime/body/body.hpp"
#include "runtime/model/validate.hpp"
#include "runtime/simulator/elastic.hpp"
#include "runtime/simulator/loads.hpp"
#include "tests/support/draped.hpp"
#include "tests/support/two_sheets.hpp"

namespace {

using namespace garment;
using Eigen::Vector3d;
using test::Draped;
using test::kGravity;
using Vectors = std::vector<Vector3d>;

Draped drape_valid(const model::Model& m, const std::vector<body::Body>& bodies = {},
                   simulator::Settle settle = simulator::Settle::exact, int max_steps = 4000) {
  REQUIRE(model::validate(m).empty());
  return test::drape(m, bodies, settle, max_steps);
}

Vectors shaken(const model::Model& m, double size) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-size, size);
  Vectors x = m.start;
  for (Vector3d& p : x) p += Vector3d(any(random), any(random), any(random));
  return x;
}

/// A holder of the holds from `first` on.
void tell_holder(model::Model& m, const char* name, std::size_t first) {
  m.holders.push_back({name, {}, {m.hold_particle.begin() + static_cast<std::ptrdiff_t>(first), m.hold_particle.end()}});
}

}  // namespace

TEST_CASE("loads: the air pushes a sheet by its drag, square to the flow and at an angle") {
  const double A = 0.02, u = 7, C = 1.2, q = 0.5 * simulator::kAirDensity * u * u * A;
  const Vector3d flow(0, 0, u);
  CHECK(simulator::air_force({0, 0, A}, flow, C).isApprox(Vector3d(0, 0, q * C), 1e-12));
  CHECK(simulator::air_force({0, 0, -A}, flow, C).isApprox(Vector3d(0, 0, q * C), 1e-12));  // from either side
  CHECK(simulator::air_force({A, 0, 0}, flow, C).isApprox(Vector3d(0, 0, q * simulator::kSkinShare * C), 1e-12));
  const double a = 0.5;  // between the sheet and the flow
  const Vector3d normal(std::cos(a), 0, std::sin(a));
  const Vector3d f = simulator::air_force(A * normal, flow, C);
  const double skin = simulator::kSkinShare;
  CHECK(f.x() == Approx(q * C * (1 - skin) * std::sin(a) * std::cos(a)));                          // lift
  CHECK(f.z() == Approx(q * C * ((1 - skin) * std::sin(a) * std::sin(a) + skin)));                // drag
}

TEST_CASE("loads: gusts come and go") {
  model::Air air;
  air.wind = {3, 0, 0};
  air.gust = 0.5;
  CHECK(simulator::wind_at(air, 0).x() == Approx(3));
  CHECK(simulator::wind_at(air, 1.5).x() == Approx(4.5));
  CHECK(simulator::wind_at(air, 3).x() == Approx(3));
}

TEST_CASE("loads: pressure adds up to the pressure times the area, without torque, and is the gradient of the volume") {
  test::SheetSpec spec;
  spec.nx = spec.ny = 6;
  model::Model m = test::make_sheet(spec);
  for (model::Index t = 0; t < static_cast<model::Index>(m.n_triangles()); ++t) {
    m.pressed_triangle.push_back(t);
    m.pressed_pascals.push_back(30);
  }
  simulator::Loads loads(m);
  loads.follow(m.start);
  Vector3d sum = Vector3d::Zero(), torque = Vector3d::Zero();
  const Vector3d middle(0.025, 0.025, 0);
  for (std::size_t i = 0; i < m.n_particles(); ++i) {
    sum += loads.force()[i];
    torque += (m.start[i] - middle).cross(loads.force()[i]);
  }
  CHECK(sum.isApprox(Vector3d(0, 0, 30 * 0.05 * 0.05), 1e-12));
  CHECK(torque.norm() < 1e-15);
  // Inside, where the border does not count, the force is that of the potential -p V.
  const Vectors x = shaken(m, 2e-3);
  loads.follow(x);
  auto volume = [&](const Vectors& at) {
    double v = 0;
    for (std::size_t t = 0; t < m.n_triangles(); ++t) {
      const auto c = m.corners(t);
      v += at[c[0]].dot(at[c[1]].cross(at[c[2]])) / 6;
    }
    return v;
  };
  for (const auto& [i, j] : {std::pair{2, 2}, std::pair{3, 1}, std::pair{4, 4}}) {
    const auto k = static_cast<std::size_t>(test::sheet_particle(spec, i, j));
    for (int axis = 0; axis < 3; ++axis) {
      Vectors low = x, high = x;
      low[k][axis] -= 1e-5;
      high[k][axis] += 1e-5;
      CHECK(loads.force()[k][axis] == Approx(30 * (volume(high) - volume(low)) / 2e-5).epsilon(1e-6).margin(1e-9));
    }
  }
}

TEST_CASE("loads: a rod pushes and pulls by the gradient of its energy, without force or torque on the whole") {
  test::SheetSpec spec;
  spec.nx = spec.ny = 4;
  spec.stretch = spec.shear = spec.bend = spec.twist = 1e-12;
  for (double length : {0.020, 0.030, 0.02225}) {  // of 22.4 mm
    model::Model m = test::make_sheet(spec);
    m.closures.push_back({"rod", {}, 0});
    m.tie.push_back({0, 1, 4, 10, 10, 10});
    m.tie_weights.push_back({0.5, 0.25, 0.25, 1, 0, 0});
    m.tie_length.push_back(length);
    m.tie_stiffness.push_back(5e4);
    m.tie_closure.push_back(0);
    m.rod_tie.push_back(0);
    REQUIRE(model::validate(m).empty());
    const simulator::ElasticModel elastic(m);
    const Vectors x = shaken(m, 1e-3);
    Vectors force;
    elastic.energy_and_force(x, force);
    Vector3d sum = Vector3d::Zero(), torque = Vector3d::Zero();
    double largest = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      sum += force[i];
      torque += x[i].cross(force[i]);
      largest = std::max(largest, force[i].norm());
    }
    CHECK(largest > 0.1);
    CHECK(sum.norm() < 1e-12 * largest);
    CHECK(torque.norm() < 1e-12 * largest);
    for (std::size_t i : {0, 4, 10})
      for (int axis = 0; axis < 3; ++axis) {
        Vectors low = x, high = x;
        low[i][axis] -= 1e-7;
        high[i][axis] += 1e-7;
        CHECK(force[i][axis] == Approx((elastic.energy(low) - elastic.energy(high)) / 2e-7).epsilon(1e-5).margin(1e-5 * largest));
      }
  }
}

TEST_CASE("loads: a strip pulled at its end stretches as its law says, and its clamp bears the pull") {
  test::SheetSpec spec;
  spec.nx = 6;
  spec.ny = 21;
  spec.stretch = 500;
  model::Model m = test::make_sheet(spec);
  m.gravity.setZero();
  test::hold_row(m, spec, spec.ny - 1);
  tell_holder(m, "top", 0);
  const double pull = 2, width = 5 * spec.h;  // N, m
  for (int i = 0; i < spec.nx; ++i) {
    m.load_particle.push_back(test::sheet_particle(spec, i, 0));
    m.load_force.emplace_back(0, -pull * (i == 0 || i == spec.nx - 1 ? 0.5 : 1.0) / (spec.nx - 1), 0);
  }
  const Draped d = drape_valid(m);
  REQUIRE(d.report.status == simulator::DrapeStatus::at_rest);
  const double length = 20 * spec.h, strain = pull / width / spec.stretch;
  CHECK(-d.state.position[0].y() == Approx(strain * length).epsilon(1e-3));
  REQUIRE(d.report.reactions.size() == 1);
  CHECK(d.report.reactions[0].y() == Approx(pull).epsilon(1e-5));
}

TEST_CASE("loads: a blown strip between two edges is an arc with the tension p R") {
  test::SheetSpec spec;
  spec.nx = 41;
  spec.ny = 2;
  spec.h = 5e-3;
  spec.stretch = 200;
  spec.bend = 1e-10;
  spec.twist = 1e-10;
  model::Model m = test::make_sheet(spec);
  m.gravity.setZero();
  test::hold_column(m, spec, 0);
  test::hold_column(m, spec, spec.nx - 1);
  const double p = 40, span = 40 * spec.h;
  for (model::Index t = 0; t < static_cast<model::Index>(m.n_triangles()); ++t) {
    m.pressed_triangle.push_back(t);
    m.pressed_pascals.push_back(p);
  }
  for (Vector3d& x : m.start) x.z() = 1e-3 * std::sin(3.14159265 * x.x() / span);
  const Draped d = drape_valid(m);
  INFO("steps " << d.report.steps << ", residual " << d.report.residual);
  REQUIRE(d.report.status == simulator::DrapeStatus::at_rest);
  // Half angle t of the arc: span = 2 R sin t, length = 2 R t, N = K (length / span - 1) = p R.
  double low = 1e-6, high = 1.5;
  for (int k = 0; k < 100; ++k) {
    const double t = 0.5 * (low + high), R = span / (2 * std::sin(t));
    (spec.stretch * (2 * R * t / span - 1) < p * R ? low : high) = t;
  }
  const double R = span / (2 * std::sin(low)), sag = R * (1 - std::cos(low));
  CHECK(d.state.position[20].z() == Approx(sag).epsilon(5e-3));
}

TEST_CASE("loads: a strip in a steady wind hangs at the angle where wind and weight agree") {
  test::SheetSpec spec;
  spec.nx = 3;
  spec.ny = 21;
  spec.stretch = 3000;
  model::Model m = test::make_sheet(spec);
  test::hold_row(m, spec, spec.ny - 1);
  m.air.wind = {0, 0, 2};
  m.air.drag = 1.2;
  const Draped d = drape_valid(m, {}, simulator::Settle::equilibrium);
  INFO("steps " << d.report.steps << ", residual " << d.report.residual);
  REQUIRE(d.report.status == simulator::DrapeStatus::at_rest);
  const Vector3d low = d.state.position[1], top = d.state.position[test::sheet_particle(spec, 1, spec.ny - 1)];
  const double tangent = 0.5 * simulator::kAirDensity * 1.2 * 4 / (spec.density * kGravity);
  CHECK((low.z() - top.z()) / (top.y() - low.y()) == Approx(tangent).epsilon(0.02));
}

TEST_CASE("loads: the friction stated for a pair acts in place of the pair's own") {
  const double mu = 0.2;
  auto stuck = [&](double share) {
    test::SheetSpec spec;
    spec.nx = spec.ny = 6;
    spec.h = 0.02;
    spec.friction = 0.9;
    spec.plane = test::SheetPlane::horizontal;
    model::Model m = test::make_sheet(spec);
    for (Vector3d& p : m.start) p.y() = 1.5e-3;
    const double a = std::atan(share * mu);
    m.gravity = kGravity * Vector3d(std::sin(a), -std::cos(a), 0);
    for (model::Index i = 0; i < static_cast<model::Index>(m.n_particles()); ++i) {
      m.rub_particle.push_back(i);
      m.rub_body.push_back(0);
      m.rub_factor.push_back(mu);
    }
    design::Body declared;
    declared.name = "plane";
    declared.shape = design::Floor{};
    declared.friction = 0.9;
    body::BodyResult built = body::build_body(declared, system_host(), "");
    REQUIRE(built.body);
    return drape_valid(m, {std::move(*built.body)}, simulator::Settle::exact, 150).report.status == simulator::DrapeStatus::at_rest;
  };
  CHECK(stuck(0.9));
  CHECK(!stuck(1.1));
}

TEST_CASE("loads: cloth lies on cloth by the friction that is stated for the two") {
  const double mu = 0.4;
  auto report = [&](double share) {
    test::SheetSpec under;
    under.nx = under.ny = 13;
    under.plane = test::SheetPlane::horizontal;
    model::Model table = test::make_sheet(under);
    for (int j = 0; j < under.ny; ++j) test::hold_row(table, under, j);
    test::SheetSpec over = under;
    over.nx = over.ny = 6;
    model::Model sheet = test::make_sheet(over);
    for (Vector3d& p : sheet.start) p += Vector3d(0.032, 1.15e-3, -0.033);
    model::Model m = test::together(table, sheet);
    const double a = std::atan(share * mu);
    m.gravity = kGravity * Vector3d(std::sin(a), -std::cos(a), 0);
    m.rub_panels.push_back({0, 1});
    m.rub_panels_factor.push_back(mu);
    const Draped d = drape_valid(m, {}, simulator::Settle::exact, 200);
    double moved = 0;
    for (std::size_t i = table.n_particles(); i < m.n_particles(); ++i)
      moved += (d.state.position[i] - m.start[i]).x() / static_cast<double>(sheet.n_particles());
    return std::pair(d.report, moved);
  };
  const auto [sticking, stuck] = report(0.9);
  INFO("0.9 mu: residual " << sticking.residual << ", moved " << stuck << " m in " << sticking.steps << " steps");
  CHECK(sticking.status == simulator::DrapeStatus::at_rest);
  CHECK(std::abs(stuck) < 1e-3);
  const auto [sliding, slid] = report(1.2);
  INFO("1.2 mu: residual " << sliding.residual << ", moved " << slid << " m in " << sliding.steps << " steps");
  CHECK(sliding.status != simulator::DrapeStatus::at_rest);
  CHECK(slid > 2 * std::abs(stuck));
}
