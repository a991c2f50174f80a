#pragma once
// Sparse Cholesky factorisation of a symmetric matrix of 6x6 blocks: the coarse matrix of the preconditioner.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace garment::simulator {

/// A = L L^T with rows and columns reordered for little fill (approximate minimum degree). One thread, no
/// allocation after `analyze`, the same bits everywhere. Method: left-looking by columns (T. Davis, "Direct
/// Methods for Sparse Linear Systems", chapter 4), on blocks.
class BlockCholesky {
 public:
  using Block = Eigen::Matrix<double, 6, 6>;
  using Vector = Eigen::Matrix<double, 6, 1>;

  /// Prepares for matrices of n block rows whose lower blocks stand at `places`: (row, column) with row >=
  /// column, each once, all diagonal blocks among them.
  void analyze(int n, const std::vector<std::array<int, 2>>& places);

  /// Factors the matrix with `blocks[k]` at place k (of diagonal blocks the lower triangle is read). A pivot
  /// that is not positive, or lost to rounding, is replaced by a huge one, which holds that unknown at zero;
  /// returns how many.
  int factor(const std::vector<Block>& blocks);

  /// Overwrites b [n] by the solution.
  void solve(std::vector<Vector>& b);

  std::size_t n_rows() const { return place_.size(); }
  /// Blocks of L, diagonal included.
  std::size_t n_blocks() const { return row_.size() + place_.size(); }

 private:
  void gather_column(int j, const std::vector<Block>& blocks);
  void update_column(int j);
  int finish_column(int j);

  std::vector<int> place_;  // [n] new number of each block row
  std::vector<std::array<int, 2>>
      entry_;  // of each given block: its column and its slot there, sorted by column
  std::vector<std::uint8_t> transposed_;
  std::vector<int> entry_begin_, entry_source_;
  std::vector<int> begin_, row_;                   // L below the diagonal: columns [n + 1], ascending rows
  std::vector<Block> value_, diagonal_, inverse_;  // inverse_: of the diagonal blocks of L
  std::vector<int> slot_;                          // [n] of each row in the column under work
  std::vector<int> head_, next_, reach_;           // columns linked by the row they touch next
  Vector given_;                                   // diagonal of the block column under work, as it was given
  std::vector<Vector> work_;
};

}  // namespace garment::simulator
