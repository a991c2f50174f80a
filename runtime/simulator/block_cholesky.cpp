#include "runtime/simulator/block_cholesky.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

namespace garment::simulator {
namespace {

constexpr double kSmallestPivot = 1e-13;  // share of the diagonal's own entry
constexpr double kHugePivot = 1e150;

/// New number of each row, chosen for little fill.
std::vector<int> little_fill(int n, const std::vector<std::array<int, 2>>& places) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [r, c] : places) {
    entries.emplace_back(r, c, 1);
    if (r != c) entries.emplace_back(c, r, 1);
  }
  Eigen::SparseMatrix<double> pattern(n, n);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(pattern, order);
  std::vector<int> number(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) number[order.indices()[k]] = k;
  return number;
}

/// Lower triangular L with A = L L^T; pivots that are lost are replaced (see `factor`).
int dense_cholesky(BlockCholesky::Block& a, const BlockCholesky::Vector& given) {
  int lost = 0;
  for (int j = 0; j < 6; ++j) {
    double pivot = a(j, j);
    for (int k = 0; k < j; ++k) pivot -= a(j, k) * a(j, k);
    if (!(pivot > kSmallestPivot * given[j])) {
      pivot = kHugePivot;
      ++lost;
    }
    const double root = std::sqrt(pivot);
    a(j, j) = root;
    for (int i = j + 1; i < 6; ++i) {
      double sum = a(i, j);
      for (int k = 0; k < j; ++k) sum -= a(i, k) * a(j, k);
      a(i, j) = sum / root;
      a(j, i) = 0;
    }
  }
  return lost;
}

BlockCholesky::Block lower_inverse(const BlockCholesky::Block& l) {
  BlockCholesky::Block inverse = BlockCholesky::Block::Zero();
  for (int c = 0; c < 6; ++c) {
    inverse(c, c) = 1 / l(c, c);
    for (int r = c + 1; r < 6; ++r) {
      double sum = 0;
      for (int k = c; k < r; ++k) sum += l(r, k) * inverse(k, c);
      inverse(r, c) = -sum / l(r, r);
    }
  }
  return inverse;
}

}  // namespace

void BlockCholesky::analyze(int n, const std::vector<std::array<int, 2>>& places) {
  const auto size = static_cast<std::size_t>(n);
  place_ = n > 0 ? little_fill(n, places) : std::vector<int>();
  // Structure of L: column j takes its own entries and those of the columns whose first row is j.
  std::vector<std::vector<int>> column(size), children(size);
  for (const auto& [r, c] : places) {
    const int a = place_[r], b = place_[c];
    if (a != b) column[std::min(a, b)].push_back(std::max(a, b));
  }
  begin_.assign(size + 1, 0);
  row_.clear();
  for (int j = 0; j < n; ++j) {
    std::vector<int>& rows = column[j];
    for (int child : children[j])
      rows.insert(rows.end(), row_.begin() + begin_[child] + 1, row_.begin() + begin_[child + 1]);
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    if (!rows.empty()) children[rows.front()].push_back(j);
    row_.insert(row_.end(), rows.begin(), rows.end());
    begin_[j + 1] = static_cast<int>(row_.size());
    rows = {};
  }
  // Where the given blocks go: slot -1 is the diagonal.
  std::vector<int> by_column(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) by_column[k] = static_cast<int>(k);
  auto target = [&](int k) {
    const int a = place_[places[k][0]], b = place_[places[k][1]];
    return std::array{std::min(a, b), std::max(a, b)};
  };
  std::sort(by_column.begin(), by_column.end(), [&](int a, int b) { return target(a) < target(b); });
  entry_.clear();
  transposed_.clear();
  entry_source_ = by_column;
  entry_begin_.assign(size + 1, 0);
  for (int k : by_column) {
    const auto [c, r] = target(k);
    const auto at = std::lower_bound(row_.begin() + begin_[c], row_.begin() + begin_[c + 1], r);
    entry_.push_back({c, r == c ? -1 : static_cast<int>(at - row_.begin())});
    transposed_.push_back(place_[places[k][0]] < place_[places[k][1]]);
    ++entry_begin_[c + 1];
  }
  for (std::size_t j = 0; j < size; ++j) entry_begin_[j + 1] += entry_begin_[j];
  value_.resize(row_.size());
  diagonal_.resize(size);
  inverse_.resize(size);
  slot_.resize(size);
  next_.resize(size);
  reach_.resize(size);
  work_.resize(size);
}

void BlockCholesky::gather_column(int j, const std::vector<Block>& blocks) {
  diagonal_[j].setZero();
  for (int s = begin_[j]; s < begin_[j + 1]; ++s) {
    value_[s].setZero();
    slot_[row_[s]] = s;
  }
  for (int e = entry_begin_[j]; e < entry_begin_[j + 1]; ++e) {
    const Block& block = blocks[entry_source_[e]];
    const int slot = entry_[e][1];
    if (slot < 0)
      diagonal_[j] = block;
    else if (transposed_[e])
      value_[slot] = block.transpose();
    else
      value_[slot] = block;
  }
  given_ = diagonal_[j].diagonal();
}

/// Subtracts what the finished columns that reach row j contribute to column j.
void BlockCholesky::update_column(int j) {
  for (int k = head_[j]; k >= 0;) {
    const int following = next_[k], at = reach_[k];
    const Block across = value_[at].transpose();
    diagonal_[j].noalias() -= value_[at].lazyProduct(across);
    for (int s = at + 1; s < begin_[k + 1]; ++s)
      value_[slot_[row_[s]]].noalias() -= value_[s].lazyProduct(across);
    if (at + 1 < begin_[k + 1]) {
      reach_[k] = at + 1;
      next_[k] = head_[row_[at + 1]];
      head_[row_[at + 1]] = k;
    }
    k = following;
  }
}

int BlockCholesky::finish_column(int j) {
  const int lost = dense_cholesky(diagonal_[j], given_);
  inverse_[j] = lower_inverse(diagonal_[j]);
  const Block across = inverse_[j].transpose();
  for (int s = begin_[j]; s < begin_[j + 1]; ++s) value_[s] = Block(value_[s].lazyProduct(across));
  if (begin_[j] < begin_[j + 1]) {
    reach_[j] = begin_[j];
    next_[j] = head_[row_[begin_[j]]];
    head_[row_[begin_[j]]] = j;
  }
  return lost;
}

int BlockCholesky::factor(const std::vector<Block>& blocks) {
  const int n = static_cast<int>(place_.size());
  head_.assign(place_.size(), -1);
  int lost = 0;
  for (int j = 0; j < n; ++j) {
    gather_column(j, blocks);
    update_column(j);
    lost += finish_column(j);
  }
  return lost;
}

void BlockCholesky::solve(std::vector<Vector>& b) {
  const int n = static_cast<int>(place_.size());
  for (int i = 0; i < n; ++i) work_[place_[i]] = b[i];
  for (int j = 0; j < n; ++j) {
    const Vector y = inverse_[j] * work_[j];
    work_[j] = y;
    for (int s = begin_[j]; s < begin_[j + 1]; ++s) work_[row_[s]].noalias() -= value_[s] * y;
  }
  for (int j = n - 1; j >= 0; --j) {
    Vector y = work_[j];
    for (int s = begin_[j]; s < begin_[j + 1]; ++s) y.noalias() -= value_[s].transpose() * work_[row_[s]];
    work_[j] = inverse_[j].transpose() * y;
  }
  for (int i = 0; i < n; ++i) b[i] = work_[place_[i]];
}

}  // namespace garment::simulator
