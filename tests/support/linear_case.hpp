#pragma once
// A linear system of the drape for tests and benchmarks: a crumpled hanging sheet, one implicit step.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "runtime/simulator/elastic.hpp"
#include "runtime/simulator/holds.hpp"
#include "runtime/simulator/linear_solver.hpp"
#include "tests/support/grid_model.hpp"

namespace garment::test {

/// Numbers in [-0.5, 0.5), the same everywhere.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : seed_(seed) {}
  double operator()() {
    seed_ = seed_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(seed_ >> 11) / 9007199254740992.0 - 0.5;
  }
  Eigen::Vector3d vector() {
    const double a = (*this)(), b = (*this)(), c = (*this)();
    return {a, b, c};
  }

 private:
  std::uint64_t seed_;
};

/// A sheet held at its upper corners.
inline model::Model hanging(int nx, int ny, double stretch = 1000) {
  SheetSpec spec;
  spec.nx = nx;
  spec.ny = ny;
  spec.stretch = stretch;
  model::Model m = make_sheet(spec);
  hold_upper_corners(m, spec);
  return m;
}

/// (elastic Hessian + M / time_step^2) x = force, at first at positions that are waved and uneven.
struct LinearCase {
  LinearCase(model::Model m, double time_step, double unevenness = 0.3)
      : model(std::move(m)), holds(model), elastic(model), matrix(elastic.make_matrix()), x(model.start) {
    Noise noise(7);
    const double h = model.spring_rest.empty() ? 0.01 : model.spring_rest.front();
    for (Eigen::Vector3d& p : x) {
      p = 1.002 * p + Eigen::Vector3d(0, 0, 1.5 * h * std::sin(0.4 * p.x() / h) * std::cos(0.3 * p.y() / h));
      p += unevenness * h * Eigen::Vector3d(0.02 * noise(), 0.02 * noise(), noise());
    }
    assemble(time_step);
  }
  /// Lets the sheet sag by implicit steps that grow from 1/60 s to 2 s, then sets the system up for
  /// `time_step`: what the solver meets near rest.
  void relax(int steps, double time_step) {
    simulator::LinearSolver solver(matrix.pattern(), holds);
    std::vector<Eigen::Vector3d> dx;
    double step = 1.0 / 60;
    const double furthest = 0.5 * model.spring_rest.front();
    for (int k = 0; k < steps; ++k, step = std::min(2.0, 1.5 * step)) {
      assemble(step);
      solver.solve(matrix, {}, force, 0.05, 200, dx, &x);
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] += dx[i] * std::min(1.0, furthest / (dx[i].norm() + 1e-12));
    }
    assemble(time_step);
  }
  /// Adds a contact with its diagonal blocks.
  void add_contact(const simulator::ContactStiffness& c) {
    contacts.push_back(c);
    for (int k = 0; k < 4; ++k)
      if (c.particle[k] >= 0)
        matrix.add_diagonal(
            static_cast<std::size_t>(c.particle[k]),
            Eigen::Matrix3d(
                (c.stiffness * c.weight[k] * c.weight[k] * c.normal * c.normal.transpose()).cast<double>()));
  }

  void assemble(double time_step) {
    elastic.energy_force_hessian(x, force, matrix);
    for (std::size_t i = 0; i < x.size(); ++i) {
      force[i] += model.mass[i] * model.gravity;
      matrix.add_diagonal(i, model.mass[i] / (time_step * time_step));
    }
    holds.filter(force);
  }

  model::Model model;
  simulator::Holds holds;
  simulator::ElasticModel elastic;
  simulator::BlockMatrix matrix;
  std::vector<simulator::ContactStiffness> contacts;
  std::vector<Eigen::Vector3d> x, force;
};

}  // namespace garment::test
