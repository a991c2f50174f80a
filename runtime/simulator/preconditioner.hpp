#pragma once
// Two-level additive preconditioner: inverse 3x3 diagonal blocks, plus an exact solve over aggregates of about 16
// particles that move as one (design "physics", section 3.2, point 3).
#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "runtime/simulator/block_matrix.hpp"
#include "runtime/simulator/holds.hpp"

namespace garment::simulator {

class Preconditioner {
 public:
  /// Groups the particles once; the pattern must stay that of the matrices given to `factor`.
  Preconditioner(const BlockPattern& pattern, const Holds& holds);

  /// Prepares for one matrix. Returns false when the coarse matrix is not positive definite (then only the diagonal
  /// blocks are used).
  bool factor(const BlockMatrix& matrix);

  /// z = M^-1 r, both [n], filtered by the holds.
  void apply(const std::vector<Eigen::Vector3f>& r, std::vector<Eigen::Vector3f>& z);

 private:
  void group(const BlockPattern& pattern);
  void make_coarse_pattern(const BlockPattern& pattern);

  const Holds& holds_;
  std::vector<int> aggregate_;                 ///< of each particle, -1 for fixed ones
  int n_aggregates_ = 0;
  std::vector<int> block_target_;              ///< for block k of the fine pattern: coarse block, -1 none
  std::vector<int> diagonal_target_;           ///< coarse diagonal block of each aggregate
  std::vector<std::array<int, 2>> coarse_blocks_;  ///< (row, column), row >= column
  std::vector<Eigen::Matrix3d> coarse_values_;
  std::vector<std::array<int, 9>> coarse_slots_;   ///< where the nine numbers of a block stand in the sparse matrix
  Eigen::SparseMatrix<double> coarse_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::AMDOrdering<int>> cholesky_;
  bool coarse_ready_ = false;
  std::vector<Eigen::Matrix3f> inverse_diagonal_;
  Eigen::VectorXd coarse_r_, coarse_z_;
};

}  // namespace garment::simulator
