#pragma once
// The solver's matrix: symmetric, 3x3 blocks over particles, fixed pattern, with the row sums of the elastic
// part kept exactly zero.
#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

#include "runtime/model/model.hpp"

namespace garment::simulator {

inline constexpr std::size_t kRowGrain = 1024;  ///< rows of one chunk of a parallel loop

/// Which pairs of particles have a block: compressed rows, both triangles, without the diagonal.
struct BlockPattern {
  std::vector<model::Index> row_begin;  ///< [n + 1]
  std::vector<model::Index> column;     ///< [n_blocks], ascending within a row, never the row itself
  std::vector<model::Index> mirror;     ///< [n_blocks], position of the block (column, row)

  std::size_t n_rows() const { return row_begin.size() - 1; }
  std::size_t n_blocks() const { return column.size(); }
  /// Position of block (row, column), -1 if the pattern has none (so for row == column).
  model::Index find(model::Index row, model::Index column) const;
  /// The pattern with the blocks (i, j) and (j, i) of every pair; pairs may repeat, in any order, i != j.
  static BlockPattern from_pairs(std::size_t n_rows, std::vector<model::Indices<2>> pairs);
};

/// A = L + diag(added). L holds the elastic part; its diagonal is minus the sum of the row's other blocks, so
/// that a translation costs exactly nothing although the blocks are floats: the product is
///   y_i = sum_j A_ij (x_j - x_i) + added_i x_i.
/// Positions and forces stay double; this matrix only shapes the search direction.
class BlockMatrix {
 public:
  BlockMatrix() = default;
  /// A zero matrix.
  explicit BlockMatrix(std::shared_ptr<const BlockPattern> pattern);

  const BlockPattern& pattern() const { return *pattern_; }
  std::size_t n_rows() const { return added_.size(); }

  /// y = A x, both [n_rows]; y is resized. Same bits for any number of threads.
  void multiply(const std::vector<Eigen::Vector3f>& x, std::vector<Eigen::Vector3f>& y) const;
  /// y = A x, and the sum of x . y, accumulated in double in fixed order (what conjugate gradients ask for
  /// next).
  double multiply_and_dot(const std::vector<Eigen::Vector3f>& x, std::vector<Eigen::Vector3f>& y) const;

  /// Adds a symmetric block (a contact, N/m) or a multiple of the identity (mass over the step squared) at
  /// (i, i). Neighbouring i may be added by different threads, one i by one thread at a time.
  void add_diagonal(std::size_t i, const Eigen::Matrix3d& block) { added_[i] += block.cast<float>(); }
  void add_diagonal(std::size_t i, double scale) {
    added_[i].diagonal().array() += static_cast<float>(scale);
  }
  /// Removes all that was added on the diagonal; the elastic part stays.
  void clear_added();

  /// The whole block (i, i): elastic part and what was added.
  Eigen::Matrix3d diagonal(std::size_t i) const { return elastic_diagonal_[i] + added_[i].cast<double>(); }
  /// A copy of the off-diagonal block at a position of the pattern.
  Eigen::Matrix3f block(std::size_t position) const {
    return Eigen::Map<const Eigen::Matrix3f>(blocks_.data() + 9 * position);
  }

  /// [3n x 3n] copy for tests and for small coarse problems.
  Eigen::MatrixXd to_dense() const;

  /// For assembly: the nine floats (column-major) of the block at `position`. Only blocks with row < column
  /// are to be written; `finish_assembly` copies them to the other triangle and computes the elastic
  /// diagonal.
  float* raw_block(std::size_t position) { return blocks_.data() + 9 * position; }
  void finish_assembly();

 private:
  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<float> blocks_;                      // [9 n_blocks + 3], the tail lets four-wide loads overrun
  std::vector<Eigen::Matrix3d> elastic_diagonal_;  // [n]
  std::vector<Eigen::Matrix3f> added_;             // [n]
};

}  // namespace garment::simulator
