// Friction inside the cloth: forces against differences, and the loops of Kawabata's records from single stencils.
#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/modeller/inner_friction.hpp"
#include "runtime/modeller/tensile_law.hpp"
#include "runtime/simulator/elastic.hpp"
#include "runtime/simulator/inner_friction.hpp"
#include "tests/support/elastic_cases.hpp"
#include "tests/support/motion_cases.hpp"

namespace {

using namespace garment;
using Eigen::Vector3d;
using Positions = std::vector<Vector3d>;

constexpr double kDegree = 0.017453292519943295;

/// Some friction on every stencil of a model, the fits' along two slanting ways.
void add_friction(model::Model& m) {
  m.law_slip.assign(m.laws.size(), 0.2);
  m.cell_slip.assign(m.cell.size(), {0.4, 0.9});
  m.membrane_slip.assign(m.membrane.size(), {0.4, 0.9});
  m.bend_slip.assign(m.bend.size(), 3e-4);
  for (std::size_t f = 0; f < m.fit_area.size(); ++f)
    for (double a : {0.3, 1.2}) {
      const double c = std::cos(a), s = std::sin(a);
      m.fit_slip.push_back(static_cast<model::Index>(f));
      m.fit_slip_particle.push_back(5);
      m.fit_slip_way.emplace_back(c * c, s * s, 2 * c * s);
      m.fit_slip_moment.push_back(3e-4 * m.fit_area[f]);
      m.fit_slip_rigidity.push_back(1e-5 * m.fit_area[f]);
    }
}

model::Model sheet_with_friction() {
  test::SheetSpec spec;
  spec.nx = spec.ny = 4;
  model::Model m = test::make_sheet(spec);
  m.laws = {test::curved_law(), test::linear_law(800)};
  test::add_fits(m);
  add_friction(m);
  return m;
}

void check_forces(const model::Model& m, const Positions& slipped, Positions x) {
  const simulator::ElasticModel elastic(m);
  simulator::InnerFriction friction(m, elastic);
  friction.slip(slipped);
  Positions f(x.size(), Vector3d::Zero());
  friction.add_force(x, f);
  double largest = 0;
  Vector3d sum = Vector3d::Zero(), torque = Vector3d::Zero();
  for (std::size_t i = 0; i < x.size(); ++i) {
    largest = std::max(largest, f[i].norm());
    sum += f[i];
    torque += x[i].cross(f[i]);
  }
  REQUIRE(largest > 0);
  CHECK(sum.norm() < 1e-12 * largest);
  CHECK(torque.norm() < 1e-12 * largest);
  constexpr double kStep = 1e-8;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const double at = x[i][k];
      x[i][k] = at + kStep;
      const double high = friction.energy(x);
      x[i][k] = at - kStep;
      const double low = friction.energy(x);
      x[i][k] = at;
      CHECK(std::abs(f[i][k] + (high - low) / (2 * kStep)) < 1e-5 * largest);
    }
}

}  // namespace

TEST_CASE("the forces of sliders are the gradient of their potential, and turn nothing by themselves") {
  model::Model m = sheet_with_friction();
  for (const double size : {0.0003, 0.002, 0.004}) {
    INFO("amplitude " << size);
    check_forces(m, test::crumpled(m, 0.0004, 7), test::crumpled(m, size, 1));
    check_forces(m, m.start, test::crumpled(m, size, 2));
  }
  model::Model cut = test::membrane_case().model;
  add_friction(cut);
  check_forces(cut, test::crumpled(cut, 0.0002, 7), test::crumpled(cut, 0.001, 1));
}

TEST_CASE("letting sliders slip changes no force and frees heat") {
  const model::Model m = sheet_with_friction();
  const simulator::ElasticModel elastic(m);
  simulator::InnerFriction friction(m, elastic);
  const Positions x = test::crumpled(m, 0.002, 1);
  Positions before(x.size(), Vector3d::Zero()), after = before;
  const double energy = friction.add_force(x, before);
  const double heat = friction.slip(x);
  const double left = friction.add_force(x, after);
  for (std::size_t i = 0; i < x.size(); ++i) CHECK((before[i] - after[i]).norm() < 1e-12);
  CHECK(heat > 0);
  CHECK(energy - left > 0);
  CHECK(std::abs(friction.slip(x)) < 1e-12 * heat);
  simulator::InnerFriction again(m, elastic);
  REQUIRE(again.take_anchors(friction.anchors()));
  CHECK(again.energy(x) == left);
  CHECK_FALSE(again.take_anchors({1, 2}));
}

namespace {

/// Moment of the sheet's middle column of stencils bent to the curvature kappa, sliders and all.
double moment_at(const model::Model& m, const simulator::ElasticModel& elastic, simulator::InnerFriction& friction, double kappa, double h) {
  const double turn = kappa * h;
  Positions x = m.start;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = m.start[i].x();  // the middle column stays, the others lift by half the turn
    if (u < h / 2 || u > 1.5 * h) {
      const double side = u > h ? 1 : -1;
      x[i] = {h + side * h * std::cos(turn / 2), m.start[i].y(), h * std::sin(turn / 2)};
    }
  }
  Positions f(x.size(), Vector3d::Zero()), own(x.size(), Vector3d::Zero());
  elastic.energy_and_force(x, f);
  friction.add_force(x, own);
  friction.slip(x);
  double moment = 0;  // of the ends about the middle, by the way they would go on
  for (std::size_t i = 0; i < x.size(); ++i)
    if (m.start[i].x() > 1.5 * h) moment -= (f[i] + own[i]).dot(Vector3d(-std::sin(turn / 2), 0, std::cos(turn / 2))) * h;
  return moment;
}

}  // namespace

TEST_CASE("one stencil bent to and fro has the loop of its record") {
  // B and 2HB of HESC_MW_MEAN. Of the three rows only the middle one has a stencil along the columns, of the width h.
  test::SheetSpec spec;
  spec.nx = spec.ny = 3;
  spec.h = 0.002;
  spec.bend = 0.1357 * 9.80665e-5;
  spec.twist = 0;
  spec.shear = 0;
  spec.stretch = 1e-6;
  model::Model m = test::make_sheet(spec);
  m.bend_slip.assign(m.bend.size(), 0.0622 * 9.80665e-3 / 2);
  const simulator::ElasticModel elastic(m);
  simulator::InnerFriction friction(m, elastic);
  const double width = spec.h * 2;  // the border rows have half of it each
  double out[5] = {}, back_at_100 = 0, out_at_100 = 0, rest = 0;
  for (int k = 0; k <= 250; ++k) {
    const double moment = moment_at(m, elastic, friction, k, spec.h) / width;
    if (k % 50 == 0 && k > 0) out[k / 50 - 1] = moment;
    if (k == 100) out_at_100 = moment;
  }
  for (int k = 249; k >= 0; --k) {
    const double moment = moment_at(m, elastic, friction, k, spec.h) / width;
    if (k == 100) back_at_100 = moment;
    if (moment > 0) rest = k;
  }
  CHECK((out[2] - out[0]) / 100 == Approx(spec.bend).epsilon(1e-3));
  CHECK(out_at_100 - back_at_100 == Approx(0.0622 * 9.80665e-3).epsilon(1e-3));
  CHECK(rest == Approx(22.9).margin(1));  // residual curvature HB / B, 1/m
}

TEST_CASE("the slider of shear gives G, 2HG and 2HG5 of one record") {
  // HESC_MW_MEAN; per area, with the elastic slope lowered by m.
  const double G = 0.859 * 56.187966, HG = 0.885 / 2 * 0.980665, HG5 = 1.793 / 2 * 0.980665;
  const simulator::ShearYield yield(HG, HG5);
  const double k = HG5 / (0.1 * kDegree);
  simulator::Slider slider;
  simulator::set_reach(slider, k, yield);
  auto stress = [&](double phi) {
    const double s = simulator::slip_at(slider, k, yield, phi).force;
    simulator::follow(slider, k, yield, phi);
    return (G - yield.rise) * phi + s;
  };
  double out[81], back[81];
  for (int i = 0; i <= 80; ++i) out[i] = stress(i * 0.1 * kDegree);
  for (int i = 79; i >= 0; --i) back[i] = stress(i * 0.1 * kDegree);
  CHECK((out[25] - out[5]) / (2 * kDegree) == Approx(G).epsilon(1e-9));
  CHECK(out[5] - back[5] == Approx(2 * HG).epsilon(1e-9));
  CHECK(out[50] - back[50] == Approx(2 * HG5).epsilon(1e-9));
}

TEST_CASE("the slider of tension gives back RT of the work and follows the record on its way out") {
  const design::Tensile record{0.0603, 0.608, 490.3325, 0.622};
  const model::TensileLaw law = modeller::make_tensile_law(record);
  const simulator::TensileTable table(law);
  const double share = modeller::tensile_slip(record, law), k = model::kTensilePreSlip * law.slope.back();
  const simulator::TensileYield yield{table, share};
  simulator::Slider slider;
  simulator::set_reach(slider, k, yield);
  auto pull = [&](double e) {
    const double s = simulator::slip_at(slider, k, yield, e).force;
    simulator::follow(slider, k, yield, e);
    return table.at(e).force * (1 - share) + s;
  };
  constexpr int n = 4000;
  double out = 0, back = 0, last = 0;
  for (int i = 1; i <= n; ++i) {
    const double now = pull(record.max_strain * i / n);
    out += 0.5 * (last + now) * record.max_strain / n;
    last = now;
  }
  CHECK(last == Approx(490.3325).epsilon(1e-9));
  for (int i = n - 1; i >= 0; --i) {
    const double now = pull(record.max_strain * i / n);
    back += 0.5 * (last + now) * record.max_strain / n;
    last = now;
  }
  CHECK(out == Approx(0.608 * 490.3325 * 0.0603 / 2).epsilon(1e-4));
  CHECK(back / out == Approx(0.622).epsilon(0.005));
}

TEST_CASE("moved: friction inside the cloth turns swing to heat, and the balance of energy has it") {
  test::SheetSpec spec;
  spec.nx = 9;
  spec.ny = 2;
  spec.h = 0.01;
  spec.plane = test::SheetPlane::horizontal;
  model::Model m = test::make_sheet(spec);
  test::hold_column(m, spec, 0);
  test::hold_column(m, spec, 1);
  m.damping.assign(m.n_particles(), 0);
  const test::Moved free = test::move(m, test::lasting(0.3, 1.0 / 480));
  m.bend_slip.assign(m.bend.size(), 3e-4);
  const test::Moved rubbed = test::move(m, test::lasting(0.3, 1.0 / 480));
  for (const test::Moved* moved : {&free, &rubbed}) REQUIRE(moved->report.status == simulator::DrapeStatus::ran);
  const simulator::EnergyBalance& balance = rubbed.report.motion.balance;
  CHECK(free.report.motion.balance.friction == 0);
  CHECK(balance.friction > 0);
  CHECK(std::abs(balance.numerical) < 0.5 * balance.friction);
  CHECK(rubbed.state.slip.size() == m.bend.size());
}
