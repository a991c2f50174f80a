#pragma once
// The rest state of a small Model under gravity, without the solver: damped Newton steps on the dense matrix.
// An oracle for the solver, and a check that the elastic matrix leads to rest.
#include <Eigen/Cholesky>
#include <vector>

#include "runtime/simulator/elastic.hpp"
#include "tests/support/dense_algebra.hpp"

namespace garment::test {

struct NewtonResult {
  std::vector<Eigen::Vector3d> x;
  int steps = 0;
  double residual = 0;                    ///< RMS net force on the free particles over RMS weight
  std::vector<Eigen::Vector3d> reaction;  ///< force that the holds exert, N [n], zero on free particles
};

/// From `x` (held particles stay there) to `residual`, or to `max_steps`.
inline NewtonResult settle_dense(const model::Model& m, std::vector<Eigen::Vector3d> x, double residual,
                                 int max_steps) {
  const simulator::ElasticModel elastic(m);
  const std::size_t n = m.n_particles();
  std::vector<bool> held(n, false);
  for (model::Index p : m.hold_particle) held[p] = true;
  auto potential = [&](const std::vector<Eigen::Vector3d>& at) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum -= m.mass[i] * m.gravity.dot(at[i]);
    return sum;
  };
  NewtonResult result;
  simulator::BlockMatrix matrix = elastic.make_matrix();
  std::vector<Eigen::Vector3d> force;
  double damping = 1e-6;  // of the mean diagonal, against the matrix' own null space
  for (;; ++result.steps) {
    const double energy = elastic.energy_force_hessian(x, force, matrix) + potential(x);
    double squares = 0, weights = 0, diagonal = 0;
    for (std::size_t i = 0; i < n; ++i) {
      force[i] += m.mass[i] * m.gravity;
      diagonal += matrix.diagonal(i).trace() / (3.0 * static_cast<double>(n));
      if (held[i]) continue;
      squares += force[i].squaredNorm();
      weights += (m.mass[i] * m.gravity).squaredNorm();
    }
    result.residual = std::sqrt(squares / weights);
    if (result.residual <= residual || result.steps == max_steps) break;
    Eigen::MatrixXd a = matrix.to_dense();
    Eigen::VectorXd b(3 * n);
    for (std::size_t i = 0; i < n; ++i) b.segment<3>(3 * i) = held[i] ? Eigen::Vector3d::Zero() : force[i];
    a.diagonal().array() += damping * diagonal;
    for (std::size_t i = 0; i < n; ++i)
      if (held[i]) a.diagonal().segment<3>(3 * i).array() += 1e9 * diagonal;
    const Eigen::VectorXd step = test::solved(a, b);
    double length = 1;
    for (; length > 1e-8; length /= 2) {
      std::vector<Eigen::Vector3d> y = x;
      for (std::size_t i = 0; i < n; ++i)
        if (!held[i]) y[i] += length * step.segment<3>(3 * i);
      if (elastic.energy(y) + potential(y) <= energy + 1e-14 * std::abs(energy)) {
        x = std::move(y);
        break;
      }
    }
    damping = length == 1 ? std::max(damping / 4, 1e-9) : std::min(damping * 4, 1e-2);
  }
  result.reaction.assign(n, Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < n; ++i)
    if (held[i]) result.reaction[i] = -force[i];
  result.x = std::move(x);
  return result;
}

}  // namespace garment::test
