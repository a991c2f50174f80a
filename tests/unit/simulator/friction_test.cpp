// Friction of particles on bodies: sticks, slips, follows.
#include "runtime/simulator/friction.hpp"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>

namespace {

using namespace garment;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using simulator::BlockMatrix;
using simulator::BlockPattern;
using simulator::BodyFriction;
using Positions = std::vector<Vector3d>;

constexpr double kStiffness = 100;  // N/m
constexpr double kNormalForce = 2;  // N
constexpr double kMu = 0.4;
constexpr double kLimit = kMu * kNormalForce;    // 0.8 N
constexpr double kSticks = kLimit / kStiffness;  // 8 mm of tangential motion

/// One particle, pressed along `normal`, anchored at the origin.
BodyFriction pressed(const Vector3d& normal = Vector3d::UnitY()) {
  BodyFriction f(1, 1e-9, kStiffness);
  f.begin_step();
  f.add_normal_force(0, kNormalForce * normal, kMu);
  f.freeze({Vector3d::Zero()});
  return f;
}

Vector3d force_at(const BodyFriction& f, const Vector3d& x, BlockMatrix* matrix = nullptr) {
  Positions force(1, Vector3d::Zero());
  f.add_force({x}, force, matrix);
  return force[0];
}

BlockMatrix zero_matrix() {
  return BlockMatrix(std::make_shared<const BlockPattern>(BlockPattern::from_pairs(1, {})));
}

}  // namespace

TEST_CASE("friction sticks below mu N and carries mu N above") {
  const BodyFriction f = pressed();
  CHECK(f.touching() == std::vector<std::uint32_t>{0});
  CHECK((force_at(f, {0.5 * kSticks, 0, 0}) - Vector3d(-0.5 * kLimit, 0, 0)).norm() < 1e-12);
  CHECK((force_at(f, {0, 0.003, 3 * kSticks}) - Vector3d(0, 0, -kLimit)).norm() < 1e-12);
  CHECK(force_at(f, {0, 0.05, 0}) == Vector3d::Zero());  // along the normal nothing resists
  CHECK(f.energy({{kSticks, 0, 0}}) == Approx(kStiffness / 2 * kSticks * kSticks));
  CHECK(f.energy({{0, 0, 3 * kSticks}}) == Approx(kLimit * (3 - 0.5) * kSticks));
}

TEST_CASE("the friction force is minus the gradient of its energy") {
  const BodyFriction f = pressed(Vector3d(1, 2, -0.5).normalized());
  for (const Vector3d& x :
       {Vector3d(0.002, 0.001, -0.003), Vector3d(0.02, -0.01, 0.04), Vector3d(-0.1, 0.2, 0.1)}) {
    const Vector3d force = force_at(f, x);
    for (int k = 0; k < 3; ++k) {
      const Vector3d d = 1e-6 * Vector3d::Unit(k);
      CHECK(-(f.energy({x + d}) - f.energy({x - d})) / 2e-6 == Approx(force[k]).margin(1e-7));
    }
  }
}

TEST_CASE("the stiffness of friction is symmetric, not negative, and exact while it sticks") {
  const Vector3d normal = Vector3d(1, 2, -0.5).normalized();
  const BodyFriction f = pressed(normal);
  BlockMatrix sticking = zero_matrix(), slipping = zero_matrix();
  const Vector3d x(0.002, 0.001, -0.003);
  force_at(f, x, &sticking);
  force_at(f, 40 * x, &slipping);
  for (int k = 0; k < 3; ++k) {
    const Vector3d d = 1e-5 * Vector3d::Unit(k);
    CHECK((-(force_at(f, x + d) - force_at(f, x - d)) / 2e-5 - sticking.diagonal(0).col(k)).norm() < 1e-4);
  }
  for (const BlockMatrix* m : {&sticking, &slipping}) {
    CHECK((m->diagonal(0) - m->diagonal(0).transpose()).norm() < 1e-5);
    CHECK(Eigen::SelfAdjointEigenSolver<Matrix3d>(m->diagonal(0)).eigenvalues()[0] > -1e-5);
    CHECK((m->diagonal(0) * normal).norm() < 1e-5);
  }
  CHECK(slipping.diagonal(0).trace() < sticking.diagonal(0).trace());
}

TEST_CASE("the anchor follows a particle that slips, to where the force is just mu N") {
  BodyFriction f = pressed();
  f.follow({{0.5 * kSticks, 0, 0}});  // sticks: the anchor stays
  CHECK((force_at(f, {0.5 * kSticks, 0, 0}) - Vector3d(-0.5 * kLimit, 0, 0)).norm() < 1e-12);
  const Vector3d slipped(3 * kSticks, 0.001, 4 * kSticks);
  const Vector3d before = force_at(f, slipped);
  f.follow({slipped});
  CHECK((force_at(f, slipped) - before).norm() < 1e-12);
  CHECK(before.norm() == Approx(kLimit));
  // Turning back by one sticking length leaves nothing, by two the full force the other way.
  const Vector3d back = -before.normalized();
  CHECK(force_at(f, slipped - kSticks * back).norm() < 1e-12);
  CHECK((force_at(f, slipped - 2 * kSticks * back) + before).norm() < 1e-12);
}

TEST_CASE("several contacts on a particle add up, and mu is their mean by force") {
  BodyFriction f(3, 1e-9, kStiffness);
  f.begin_step();
  f.add_normal_force(1, {0, 3, 0}, 0.2);
  f.add_normal_force(1, {0, 1, 0}, 0.6);
  f.freeze(Positions(3, Vector3d::Zero()));
  CHECK(f.touching() == std::vector<std::uint32_t>{1});
  Positions force(3, Vector3d::Zero());
  f.add_force(Positions(3, Vector3d(1, 0, 0)), force, nullptr);
  CHECK(force[0] == Vector3d::Zero());
  CHECK(force[1].x() == Approx(-(3 * 0.2 + 1 * 0.6)));
}

TEST_CASE("pinched from two sides a particle is held, and both sides bear") {
  BodyFriction f(1, 1e-9, kStiffness);
  const model::Model m = [] {
    model::Model one;
    one.mass = {1};
    return one;
  }();
  const simulator::Holds free(m);
  f.begin_step();
  f.add_normal_force(0, {0, 1, 0}, 0.5);
  f.add_normal_force(0, {0, -1, 0}, 0.5);
  f.freeze({Vector3d::Zero()});
  CHECK(f.touching() == std::vector<std::uint32_t>{0});
  auto left = [&](const Vector3d& force) {
    Positions all{force};
    f.absorb(all, free);
    return all[0];
  };
  CHECK(left({0, 7, 0}).norm() < 1e-12);
  CHECK(left({0, -7, 0}).norm() < 1e-12);
  CHECK(left({0.9, 0, 0}).norm() < 1e-12);  // mu N of both is 1
  CHECK((left({3, 0, 0}) - Vector3d(2, 0, 0)).norm() < 1e-12);
}

TEST_CASE("in a valley the normal forces of both sides bear what lies between them, nothing else") {
  BodyFriction f(1, 1e-9, kStiffness);
  model::Model m;
  m.mass = {1};
  const simulator::Holds free(m);
  const Vector3d a = Vector3d(0.3, 1, 0).normalized(), b = Vector3d(-0.9, 0.2, 0).normalized();
  f.begin_step();
  f.add_normal_force(0, 2 * a, 0);
  f.add_normal_force(0, 3 * b, 0);
  f.freeze({Vector3d::Zero()});
  Positions force{-0.5 * a - 8 * b};  // presses into the valley
  f.absorb(force, free);
  CHECK(force[0].norm() < 1e-9);
  force = {Vector3d(0, -1, 0.7)};  // along the valley nothing bears
  f.absorb(force, free);
  CHECK(force[0].z() == Approx(0.7));
  force = {Vector3d(0, 1, 0)};  // nor what lifts out of it
  f.absorb(force, free);
  CHECK(force[0].y() == Approx(1).epsilon(0.2));
}

TEST_CASE("a body takes from a force what presses on it, and along its surface up to mu N") {
  const BodyFriction f = pressed();
  model::Model m;
  m.mass = {1};
  const simulator::Holds free(m);
  m.hold_particle = {0};
  m.hold_kind = {model::HoldKind::plane};
  m.hold_point = {Vector3d::Zero()};
  m.hold_normal = {Vector3d(1, 1, 0)};
  const simulator::Holds sliding(m);
  auto left = [&](const Vector3d& force, const simulator::Holds& holds) {
    Positions all{holds.filtered(0, force)};
    f.absorb(all, holds);
    return all[0];
  };
  CHECK(left({0.5 * kLimit, -3, 0}, free) == Vector3d::Zero());
  CHECK((left({0, -3, 3 * kLimit}, free) - Vector3d(0, 0, 2 * kLimit)).norm() < 1e-12);
  CHECK((left({0, 5, 3 * kLimit}, free) - Vector3d(0, 5, 2 * kLimit)).norm() <
        1e-12);  // a pull off the body stays
  CHECK(left(Vector3d::Zero(), free) == Vector3d::Zero());
  // Held in a plane that leans against the body: what is left stays in that plane.
  const Vector3d slid = left({0, 5, 3 * kLimit}, sliding);
  CHECK(std::abs(slid.dot(Vector3d(1, 1, 0))) < 1e-12);
  CHECK((slid - Vector3d(-2.5, 2.5, 2 * kLimit)).norm() < 1e-12);
  CHECK(left({0, -5, 0.5 * kLimit}, sliding).norm() < 1e-12);
}

TEST_CASE("a particle that lifts off anchors anew where it lands") {
  BodyFriction f = pressed();
  f.begin_step();
  f.freeze({Vector3d(1, 0, 0)});
  CHECK(f.touching().empty());
  CHECK(f.energy({Vector3d(1, 0, 0)}) == 0);
  f.begin_step();
  f.add_normal_force(0, {0, kNormalForce, 0}, kMu);
  f.freeze({Vector3d(2, 0, 0)});
  CHECK(force_at(f, {2, 0, 0}) == Vector3d::Zero());
  // Pressed again it keeps that anchor, until all are forgotten.
  f.begin_step();
  f.add_normal_force(0, {0, kNormalForce, 0}, kMu);
  f.freeze({Vector3d(2.001, 0, 0)});
  CHECK(force_at(f, {2.001, 0, 0}).x() == Approx(-0.001 * kStiffness));
  f.clear();
  CHECK(f.touching().empty());
  f.freeze({Vector3d(2.001, 0, 0)});
  CHECK(force_at(f, {2.001, 0, 0}) == Vector3d::Zero());
}
