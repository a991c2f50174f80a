#pragma once
// Preconditioned conjugate gradients on the elastic matrix plus contacts, restricted to what the holds leave
// free.
#include <Eigen/Core>
#include <vector>

#include "runtime/simulator/block_matrix.hpp"
#include "runtime/simulator/contact_stiffness.hpp"
#include "runtime/simulator/holds.hpp"
#include "runtime/simulator/preconditioner.hpp"

namespace garment::simulator {

struct LinearResult {
  int iterations = 0;
  double reduction = 1;  ///< |residual| / |right-hand side| in the preconditioner's norm
};

class LinearSolver {
 public:
  LinearSolver(const BlockPattern& pattern, const Holds& holds)
      : holds_(holds), preconditioner_(pattern, holds) {}

  /// Solves (matrix + contacts) x = b. The diagonal blocks of the contacts must already be added to `matrix`,
  /// their off-diagonal part is applied from `contacts`. Stops at `tolerance` or `max_iterations`. x starts
  /// at zero, or, right after a solve of nearly the same system (`begun`), from that solution, with its coarse space
  /// (the tolerance is still that from zero). `positions` says where the particles are; without it the solver takes two to five times the
  /// iterations. The same bits for any number of threads.
  LinearResult solve(const BlockMatrix& matrix, const std::vector<ContactStiffness>& contacts,
                     const std::vector<Eigen::Vector3d>& b, double tolerance, int max_iterations,
                     std::vector<Eigen::Vector3d>& x,
                     const std::vector<Eigen::Vector3d>* positions = nullptr, bool begun = false);
  void keep(Archive& a);  ///< in a checkpoint

 private:
  double multiply(const BlockMatrix& matrix, const std::vector<ContactStiffness>& contacts);

  const Holds& holds_;
  Preconditioner preconditioner_;
  std::vector<Eigen::Vector3f> r_, z_, p_, Ap_, x_;
};

}  // namespace garment::simulator
