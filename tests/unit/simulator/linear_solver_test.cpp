// Conjugate gradients against the dense solution.
#include "runtime/simulator/linear_solver.hpp"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "runtime/base/parallel.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/linear_case.hpp"

namespace {

using namespace garment;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using simulator::ContactStiffness;
using simulator::LinearResult;
using simulator::LinearSolver;
using test::hanging;
using test::LinearCase;

/// Contacts between far particles of the sheet, with a body, and of edges.
void add_contacts(LinearCase& c) {
  const Eigen::Vector3f n = Eigen::Vector3f(0.2F, -0.3F, 1).normalized();
  c.add_contact({{3, 70, 71, 82}, {1, -0.2F, -0.5F, -0.3F}, n, 60});
  c.add_contact({{10, 11, 90, 91}, {0.5F, 0.5F, -0.7F, -0.3F}, Eigen::Vector3f::UnitZ(), 100});
  c.add_contact({{30, -1, -1, -1}, {1, 0, 0, 0}, Eigen::Vector3f::UnitX(), 80});
  c.add_contact({{40, 41, 52, -1}, {0.3F, 0.3F, 0.4F, 0}, n, 100});
}

/// The whole system as the solver should see it, restricted to what the holds leave free.
VectorXd dense_solution(const LinearCase& c) {
  MatrixXd a = c.matrix.to_dense();
  for (const ContactStiffness& s : c.contacts)
    for (int k = 0; k < 4; ++k)
      for (int l = 0; l < 4; ++l)
        if (k != l && s.particle[k] >= 0 && s.particle[l] >= 0)
          a.block<3, 3>(3 * s.particle[k], 3 * s.particle[l]) +=
              (s.stiffness * s.weight[k] * s.weight[l] * s.normal * s.normal.transpose()).cast<double>();
  const auto n = static_cast<Eigen::Index>(c.x.size());
  MatrixXd p = MatrixXd::Zero(3 * n, 3 * n);
  VectorXd b(3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    p.block<3, 3>(3 * i, 3 * i) = c.holds.projector(static_cast<std::size_t>(i));
    b.segment<3>(3 * i) = c.force[static_cast<std::size_t>(i)];
  }
  a = MatrixXd(p * a * p) + 100 * (MatrixXd::Identity(3 * n, 3 * n) - p);
  return test::solved(a, p * b);
}

double relative_error(const std::vector<Vector3d>& x, const VectorXd& expected) {
  double square = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    square += (x[i] - expected.segment<3>(static_cast<Eigen::Index>(3 * i))).squaredNorm();
  return std::sqrt(square) / expected.norm();
}

}  // namespace

TEST_CASE("the solver finds the dense solution") {
  for (const double stretch : {1000.0, 4000.0})
    for (const double time_step : {1.0 / 60, 0.3}) {
      LinearCase c(hanging(11, 10, stretch), time_step);
      SECTION("without contacts, stretch " + std::to_string(stretch) + ", step " +
              std::to_string(time_step)) {}
      SECTION("with contacts, stretch " + std::to_string(stretch) + ", step " + std::to_string(time_step)) {
        add_contacts(c);
      }
      const VectorXd expected = dense_solution(c);
      LinearSolver solver(c.matrix.pattern(), c.holds);
      std::vector<Vector3d> x;
      const LinearResult with = solver.solve(c.matrix, c.contacts, c.force, 1e-5, 500, x, &c.x);
      CAPTURE(with.iterations, with.reduction);
      CHECK(with.reduction <= 1e-5);
      CHECK(relative_error(x, expected) < 5e-3);
      const LinearResult without =
          LinearSolver(c.matrix.pattern(), c.holds).solve(c.matrix, c.contacts, c.force, 1e-5, 500, x);
      CHECK(relative_error(x, expected) < 5e-3);
      CHECK(with.iterations <= without.iterations);
    }
}

TEST_CASE("what is held does not move") {
  model::Model m = hanging(12, 12);
  for (const model::Index i : {7, 40}) {
    m.hold_particle.push_back(i);
    m.hold_kind.push_back(model::HoldKind::plane);
    m.hold_point.push_back(m.start[i]);
    m.hold_normal.push_back(i == 7 ? Vector3d(0, 1, 0) : Vector3d(1, 2, 3));
  }
  LinearCase c(m, 0.5);
  add_contacts(c);
  const VectorXd expected = dense_solution(c);
  for (std::size_t i : {7, 132, 143}) c.force[i] = Vector3d(3, 3, 3);  // the solver filters by itself
  LinearSolver solver(c.matrix.pattern(), c.holds);
  std::vector<Vector3d> x;
  solver.solve(c.matrix, c.contacts, c.force, 1e-4, 300, x, &c.x);
  CHECK(x[132] == Vector3d::Zero());
  CHECK(x[143] == Vector3d::Zero());
  CHECK(x[7].y() == 0);
  CHECK(std::abs(x[40].dot(Vector3d(1, 2, 3))) < 1e-6 * x[40].norm());
  for (std::size_t i = 0; i < x.size(); ++i) c.force[i] = c.holds.filtered(i, c.force[i]);
  CHECK(relative_error(x, dense_solution(c)) < 2e-2);
  CHECK(expected.allFinite());
}

TEST_CASE("the number of iterations stays small as the grid grows finer") {
  for (const int n : {20, 40, 80}) {
    test::SheetSpec spec;
    spec.nx = spec.ny = n;
    spec.h = 0.4 / n;
    model::Model m = test::make_sheet(spec);
    test::hold_upper_corners(m, spec);
    LinearCase c(m, 2);
    LinearSolver solver(c.matrix.pattern(), c.holds);
    std::vector<Vector3d> x;
    const LinearResult result = solver.solve(c.matrix, {}, c.force, 1e-2, 500, x, &c.x);
    CAPTURE(n, result.iterations);
    CHECK(result.reduction <= 1e-2);
    CHECK(result.iterations <= 60);
  }
}

TEST_CASE("layers that touch cost few more iterations") {
  test::SheetSpec spec;
  spec.nx = spec.ny = 40;
  model::Model m = test::make_sheet(spec);
  test::hold_upper_corners(m, spec);
  LinearCase c(m, 2, 0.02);
  c.relax(15, 2);
  std::vector<Vector3d> x;
  const int apart =
      LinearSolver(c.matrix.pattern(), c.holds).solve(c.matrix, {}, c.force, 1e-1, 500, x, &c.x).iterations;
  // The left third lies on the right one, particle on triangle.
  for (int j = 0; j + 2 < spec.ny; ++j)
    for (int i = 1; i < spec.nx / 3; ++i) {
      const model::Index a = test::sheet_particle(spec, i, j),
                         b = test::sheet_particle(spec, spec.nx - 1 - i, j);
      c.add_contact({{a, b, b + 1, b + spec.nx}, {1, -0.4F, -0.35F, -0.25F}, Eigen::Vector3f::UnitZ(), 100});
    }
  LinearSolver solver(c.matrix.pattern(), c.holds);
  const LinearResult touching = solver.solve(c.matrix, c.contacts, c.force, 1e-1, 500, x, &c.x);
  CAPTURE(apart, touching.iterations, c.contacts.size());
  CHECK(touching.reduction <= 1e-1);
  CHECK(touching.iterations <= 60);  // nailed down where they touch: several hundred
  // Contacts that come and go leave nothing behind.
  const LinearResult again = solver.solve(c.matrix, {}, c.force, 1e-1, 500, x, &c.x);
  std::vector<Vector3d> fresh;
  LinearSolver(c.matrix.pattern(), c.holds).solve(c.matrix, {}, c.force, 1e-1, 500, fresh, &c.x);
  CHECK(x == fresh);
  CHECK(again.iterations > 0);
}

TEST_CASE("a solve that begins near the solution ends there sooner, and far from it no later than from zero") {
  LinearCase c(hanging(12, 9), 0.3);
  add_contacts(c);
  const VectorXd expected = dense_solution(c);
  LinearSolver solver(c.matrix.pattern(), c.holds);
  std::vector<Vector3d> x;
  const int cold = solver.solve(c.matrix, c.contacts, c.force, 1e-4, 1000, x, &c.x).iterations;
  std::vector<Vector3d> near = x;
  for (std::size_t i = 0; i < near.size(); ++i) near[i] *= 1 + 1e-3 * static_cast<double>(i % 3);
  const int warm = solver.solve(c.matrix, c.contacts, c.force, 1e-4, 1000, near, &c.x, true).iterations;
  INFO(cold << " iterations from zero, " << warm << " from nearby");
  CHECK(warm < cold);
  CHECK(relative_error(near, expected) < 1e-3);
  std::vector<Vector3d> far(x.size(), Vector3d(1, -2, 3));
  CHECK(solver.solve(c.matrix, c.contacts, c.force, 1e-4, 1000, far, &c.x, true).iterations == cold);
  CHECK(relative_error(far, expected) < 1e-3);
}

TEST_CASE("a second solve does not remember the first, and positions may come later") {
  LinearCase c(hanging(15, 15), 0.2);
  LinearSolver fresh(c.matrix.pattern(), c.holds), used(c.matrix.pattern(), c.holds);
  std::vector<Vector3d> expected, x;
  fresh.solve(c.matrix, {}, c.force, 1e-2, 100, expected, &c.x);
  used.solve(c.matrix, {}, c.force, 1e-2, 100, x);
  used.solve(c.matrix, {}, c.force, 1e-2, 100, x, &c.x);
  CHECK(x == expected);
  used.solve(c.matrix, {}, c.force, 1e-2, 100, x, &c.x);
  CHECK(x == expected);
}

TEST_CASE("the solution has the same bits for any number of threads") {
  LinearCase c(hanging(60, 50), 1);
  add_contacts(c);
  std::vector<Vector3d> first, x;
  for (const int threads : {1, 2, 4}) {
    set_thread_count(threads);
    LinearSolver solver(c.matrix.pattern(), c.holds);
    solver.solve(c.matrix, c.contacts, c.force, 1e-3, 200, threads == 1 ? first : x, &c.x);
    if (threads > 1) CHECK(x == first);
  }
  set_thread_count(2);
}

TEST_CASE("systems without anything to solve") {
  LinearCase c(hanging(4, 4), 1);
  LinearSolver solver(c.matrix.pattern(), c.holds);
  std::vector<Vector3d> x, zero(c.x.size(), Vector3d::Zero());
  LinearResult result = solver.solve(c.matrix, {}, zero, 1e-2, 100, x, &c.x);
  CHECK(result.iterations == 0);
  CHECK(x == zero);
  result = solver.solve(c.matrix, {}, c.force, 1e-2, 0, x, &c.x);
  CHECK(x == zero);
  CHECK(result.reduction == 1);

  model::Model all_held = hanging(3, 3);
  for (model::Index i = 0; i < 9; ++i) test::hold_point(all_held, i);
  LinearCase held(all_held, 1);
  LinearSolver nothing_free(held.matrix.pattern(), held.holds);
  nothing_free.solve(held.matrix, {}, held.force, 1e-2, 100, x, &held.x);
  CHECK(x == std::vector<Vector3d>(9, Vector3d::Zero()));

  const simulator::Holds no_holds{model::Model{}};
  const simulator::BlockMatrix empty(
      std::make_shared<const simulator::BlockPattern>(simulator::BlockPattern::from_pairs(0, {})));
  LinearSolver of_nothing(empty.pattern(), no_holds);
  const std::vector<Vector3d> none;
  of_nothing.solve(empty, {}, none, 1e-2, 100, x, &none);
  CHECK(x.empty());
}

TEST_CASE("numbers that are not finite end the solve") {
  LinearCase c(hanging(6, 6), 1);
  c.force[8].x() = std::nan("");
  LinearSolver solver(c.matrix.pattern(), c.holds);
  std::vector<Vector3d> x;
  CHECK(solver.solve(c.matrix, {}, c.force, 1e-2, 100, x, &c.x).iterations <= 100);
}
