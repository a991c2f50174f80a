#include "runtime/simulator/preconditioner.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <map>

#include "runtime/base/parallel.hpp"

namespace garment::simulator {
namespace {

constexpr int kAggregateSize = 16;
constexpr std::size_t kGrain = 1024;

}  // namespace

Preconditioner::Preconditioner(const BlockPattern& pattern, const Holds& holds)
    : holds_(holds), inverse_diagonal_(pattern.n_rows()) {
  group(pattern);
  make_coarse_pattern(pattern);
}

void Preconditioner::group(const BlockPattern& pattern) {
  std::size_t n = pattern.n_rows();
  aggregate_.assign(n, -1);
  std::vector<std::size_t> queue;
  for (std::size_t seed = 0; seed < n; ++seed) {
    if (aggregate_[seed] >= 0 || holds_.is_fixed(seed)) continue;
    queue.assign(1, seed);
    aggregate_[seed] = n_aggregates_;
    for (std::size_t q = 0; q < queue.size() && static_cast<int>(queue.size()) < kAggregateSize; ++q)
      for (auto k = pattern.row_begin[queue[q]]; k < pattern.row_begin[queue[q] + 1]; ++k) {
        auto j = static_cast<std::size_t>(pattern.column[k]);
        if (aggregate_[j] >= 0 || holds_.is_fixed(j) || static_cast<int>(queue.size()) >= kAggregateSize) continue;
        aggregate_[j] = n_aggregates_;
        queue.push_back(j);
      }
    if (queue.size() < 4) {  // a leftover: join a neighbour's group
      int other = -1;
      for (std::size_t i : queue)
        for (auto k = pattern.row_begin[i]; k < pattern.row_begin[i + 1] && other < 0; ++k) {
          int a = aggregate_[pattern.column[k]];
          if (a >= 0 && a != n_aggregates_) other = a;
        }
      if (other >= 0) {
        for (std::size_t i : queue) aggregate_[i] = other;
        continue;
      }
    }
    ++n_aggregates_;
  }
}

void Preconditioner::make_coarse_pattern(const BlockPattern& pattern) {
  std::map<std::array<int, 2>, int> index;
  for (int a = 0; a < n_aggregates_; ++a) index.emplace(std::array{a, a}, 0);
  for (std::size_t i = 0; i < pattern.n_rows(); ++i)
    for (auto k = pattern.row_begin[i]; k < pattern.row_begin[i + 1]; ++k) {
      int a = aggregate_[i], b = aggregate_[pattern.column[k]];
      if (a >= 0 && b >= 0 && a >= b) index.emplace(std::array{a, b}, 0);
    }
  for (auto& [key, value] : index) {
    value = static_cast<int>(coarse_blocks_.size());
    coarse_blocks_.push_back(key);
  }
  coarse_values_.resize(coarse_blocks_.size());
  diagonal_target_.resize(n_aggregates_);
  for (int a = 0; a < n_aggregates_; ++a) diagonal_target_[a] = index.at({a, a});
  block_target_.assign(pattern.n_blocks(), -1);
  for (std::size_t i = 0; i < pattern.n_rows(); ++i)
    for (auto k = pattern.row_begin[i]; k < pattern.row_begin[i + 1]; ++k) {
      int a = aggregate_[i], b = aggregate_[pattern.column[k]];
      if (a >= 0 && b >= 0 && a >= b) block_target_[k] = index.at({a, b});
    }
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [a, b] : coarse_blocks_)
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r)
        if (3 * a + r >= 3 * b + c) entries.emplace_back(3 * a + r, 3 * b + c, a == b && r == c ? 1.0 : 0.0);
  coarse_.resize(3 * n_aggregates_, 3 * n_aggregates_);
  coarse_.setFromTriplets(entries.begin(), entries.end());
  coarse_.makeCompressed();
  coarse_slots_.resize(coarse_blocks_.size());
  for (std::size_t k = 0; k < coarse_blocks_.size(); ++k)
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) {
        int row = 3 * coarse_blocks_[k][0] + r, column = 3 * coarse_blocks_[k][1] + c;
        const int* begin = coarse_.innerIndexPtr() + coarse_.outerIndexPtr()[column];
        const int* end = coarse_.innerIndexPtr() + coarse_.outerIndexPtr()[column + 1];
        const int* at = std::lower_bound(begin, end, row);
        coarse_slots_[k][3 * c + r] =
            row >= column && at != end && *at == row ? static_cast<int>(at - coarse_.innerIndexPtr()) : -1;
      }
  if (n_aggregates_ > 0) cholesky_.analyzePattern(coarse_);
  coarse_r_.resize(3 * n_aggregates_);
}

bool Preconditioner::factor(const BlockMatrix& matrix) {
  const BlockPattern& pattern = matrix.pattern();
  parallel_for(matrix.n_rows(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      inverse_diagonal_[i] = matrix.diagonal(i).inverse().cast<float>();
  });
  for (Eigen::Matrix3d& b : coarse_values_) b.setZero();
  for (std::size_t i = 0; i < matrix.n_rows(); ++i) {
    int a = aggregate_[i];
    if (a < 0) continue;
    bool plain = holds_.is_free(i);
    Eigen::Matrix3d p = holds_.projector(i);
    coarse_values_[diagonal_target_[a]] += plain ? matrix.diagonal(i) : Eigen::Matrix3d(p * matrix.diagonal(i) * p);
    for (auto k = pattern.row_begin[i]; k < pattern.row_begin[i + 1]; ++k) {
      int target = block_target_[k];
      if (target < 0) continue;
      auto j = static_cast<std::size_t>(pattern.column[k]);
      Eigen::Matrix3d block = matrix.block(static_cast<std::size_t>(k)).cast<double>();
      if (!plain || !holds_.is_free(j)) block = p * block * holds_.projector(j);
      coarse_values_[target] += block;
    }
  }
  for (std::size_t k = 0; k < coarse_blocks_.size(); ++k) {
    Eigen::Matrix3d b = coarse_values_[k];
    if (coarse_blocks_[k][0] == coarse_blocks_[k][1]) b.diagonal().array() += 1e-9 + 1e-7 * b.trace();
    for (int s = 0; s < 9; ++s)
      if (coarse_slots_[k][s] >= 0) coarse_.valuePtr()[coarse_slots_[k][s]] = b(s % 3, s / 3);
  }
  coarse_ready_ = false;
  if (n_aggregates_ == 0) return true;
  cholesky_.factorize(coarse_);
  coarse_ready_ = cholesky_.info() == Eigen::Success;
  return coarse_ready_;
}

void Preconditioner::apply(const std::vector<Eigen::Vector3f>& r, std::vector<Eigen::Vector3f>& z) {
  z.resize(r.size());
  if (coarse_ready_) {
    coarse_r_.setZero();
    for (std::size_t i = 0; i < r.size(); ++i)
      if (aggregate_[i] >= 0) coarse_r_.segment<3>(3 * aggregate_[i]) += r[i].cast<double>();
    coarse_z_ = cholesky_.solve(coarse_r_);
  }
  for (std::size_t i = 0; i < r.size(); ++i) {
    Eigen::Vector3f value = inverse_diagonal_[i] * r[i];
    if (coarse_ready_ && aggregate_[i] >= 0) value += coarse_z_.segment<3>(3 * aggregate_[i]).cast<float>();
    z[i] = holds_.filtered(i, value);
  }
}

}  // namespace garment::simulator
