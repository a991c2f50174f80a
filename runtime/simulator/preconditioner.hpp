#pragma once
// Two-level additive preconditioner: inverse 3x3 diagonal blocks, plus an exact solve over aggregates of
// particles that move as rigid pieces (docs/physics.md, section 3.2).
#include <Eigen/Core>
#include <array>
#include <vector>

#include "runtime/base/archive.hpp"
#include "runtime/simulator/aggregates.hpp"
#include "runtime/simulator/block_cholesky.hpp"
#include "runtime/simulator/block_matrix.hpp"
#include "runtime/simulator/contact_stiffness.hpp"
#include "runtime/simulator/holds.hpp"

namespace garment::simulator {

/// M^-1 = D^-1 + Q (Q^T A Q)^-1 Q^T. D holds the diagonal blocks of A; Q gives every aggregate three
/// translations and three rotations about its middle. Cloth bends a thousand times easier than it stretches:
/// its soft motions are pieces that turn, which translations alone cannot follow.
///
///   row of particle i in aggregate a:   Q_ia = P_i [ 1   -[d_i]x ],   d_i = (x_i - middle_a) / radius_a,
///
/// P_i being what the hold of i leaves free. Without positions the rotations are left out.
class Preconditioner {
 public:
  /// `pattern` must stay that of the matrices given to `factor`; it and `holds` must outlive this.
  Preconditioner(const BlockPattern& pattern, const Holds& holds);

  /// Prepares for one matrix, with the particles at `positions` [n] (nullptr: not known). `contacts` are
  /// those whose diagonal blocks the matrix holds already: without their off-diagonal part every layer of
  /// cloth would seem to be nailed down where it touches another. The first call, and the first one with
  /// positions, groups the particles.
  void factor(const BlockMatrix& matrix, const std::vector<Eigen::Vector3d>* positions = nullptr,
              const std::vector<ContactStiffness>& contacts = {});
  /// The same for a matrix that differs from the last one in few places, as by contacts that are foreseen: the coarse part stays.
  void factor_diagonal(const BlockMatrix& matrix);

  /// z = M^-1 r, both [n], filtered by the holds; r must be filtered. Returns r . z, accumulated in double.
  /// The same bits for any number of threads.
  double apply(const std::vector<Eigen::Vector3f>& r, std::vector<Eigen::Vector3f>& z);

  const Aggregates& aggregates() const { return groups_; }
  void keep(Archive& a);  ///< in a checkpoint

 private:
  void group(const std::vector<Eigen::Vector3d>* positions);
  void make_coarse_pattern();
  void place(const std::vector<Eigen::Vector3d>* positions);
  void gather_coarse_row(const BlockMatrix& matrix, std::size_t a);
  int touched_groups(const ContactStiffness& c, std::array<int, 4>& groups) const;
  int coarse_slot(int row, int column) const;
  void connect_touching(const std::vector<ContactStiffness>& contacts);
  void add_contact(const ContactStiffness& c);

  const BlockPattern& pattern_;
  const Holds& holds_;
  Aggregates groups_;
  bool grouped_ = false, rounded_ = false;
  std::vector<int> coarse_begin_;  // [n_groups + 1]; the last block of a row is its diagonal
  std::vector<std::array<int, 2>>
      places_;  // (row, column), column <= row, sorted: where the matrix has blocks
  std::vector<std::array<int, 2>> touching_;  // the same for further pairs of groups that contacts connect
  std::vector<int> target_;                   // for each block of the pattern: its coarse block, -1 none
  std::vector<BlockCholesky::Block> coarse_;
  BlockCholesky cholesky_;
  std::vector<BlockCholesky::Vector> coarse_r_;
  std::vector<Eigen::Vector3f> offset_;  // d of each particle
  std::vector<Eigen::Matrix3f> inverse_diagonal_;
};

}  // namespace garment::simulator
