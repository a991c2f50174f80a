#include "runtime/simulator/block_matrix.hpp"

#include <algorithm>
#include <cstring>

#include "runtime/base/parallel.hpp"

namespace garment::simulator {
namespace {

using model::Index;


// Four floats in one SSE register: part of every x86-64, so the same bits everywhere.
using Float4 = float __attribute__((vector_size(16)));

Float4 load4(const float* p) {
  Float4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

Float4 load3(const float* p) { return Float4{p[0], p[1], p[2], 0}; }

/// Row `i` of the product. Lane 3 carries rubbish and is dropped. Loading four floats of x runs over into the
/// next particle, which the last particle does not have: rows that touch it load three (`kLast`).
template <bool kLast>
Float4 row_product(const BlockPattern& pattern, const float* blocks, const Eigen::Matrix3f& added,
                   const float* x, std::size_t i) {
  auto load = [x](std::size_t j) { return kLast ? load3(x + 3 * j) : load4(x + 3 * j); };
  auto times = [](const float* b, Float4 v) {
    return load4(b) * v[0] + load4(b + 3) * v[1] + load4(b + 6) * v[2];
  };
  const Float4 xi = load(i);
  Float4 sum{0, 0, 0, 0};
  const auto begin = static_cast<std::size_t>(pattern.row_begin[i]);
  const auto end = static_cast<std::size_t>(pattern.row_begin[i + 1]);
  for (std::size_t k = begin; k < end; ++k)
    sum += times(blocks + 9 * k, load(static_cast<std::size_t>(pattern.column[k])) - xi);
  const float* d = added.data();
  return sum + load3(d) * xi[0] + load3(d + 3) * xi[1] + load3(d + 6) * xi[2];
}

}  // namespace

Index BlockPattern::find(Index row, Index wanted) const {
  auto begin = column.begin() + row_begin[row], end = column.begin() + row_begin[row + 1];
  auto at = std::lower_bound(begin, end, wanted);
  return at != end && *at == wanted ? static_cast<Index>(at - column.begin()) : -1;
}

BlockPattern BlockPattern::from_pairs(std::size_t n_rows, std::vector<model::Indices<2>> pairs) {
  const std::size_t n = pairs.size();
  pairs.reserve(2 * n);
  for (std::size_t k = 0; k < n; ++k) pairs.push_back({pairs[k][1], pairs[k][0]});
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  BlockPattern pattern;
  pattern.row_begin.assign(n_rows + 1, 0);
  pattern.column.reserve(pairs.size());
  for (const auto& [row, column] : pairs) {
    ++pattern.row_begin[row + 1];
    pattern.column.push_back(column);
  }
  for (std::size_t i = 0; i < n_rows; ++i) pattern.row_begin[i + 1] += pattern.row_begin[i];
  pattern.mirror.reserve(pairs.size());
  for (const auto& [row, column] : pairs) pattern.mirror.push_back(pattern.find(column, row));
  return pattern;
}

BlockMatrix::BlockMatrix(std::shared_ptr<const BlockPattern> pattern)
    : pattern_(std::move(pattern)),
      blocks_(9 * pattern_->n_blocks() + 3, 0.0F),
      elastic_diagonal_(pattern_->n_rows(), Eigen::Matrix3d::Zero()),
      added_(pattern_->n_rows(), Eigen::Matrix3f::Zero()) {}

void BlockMatrix::clear_added() { std::fill(added_.begin(), added_.end(), Eigen::Matrix3f::Zero()); }

void BlockMatrix::multiply(const std::vector<Eigen::Vector3f>& x, std::vector<Eigen::Vector3f>& y) const {
  multiply_and_dot(x, y);
}

double BlockMatrix::multiply_and_dot(const std::vector<Eigen::Vector3f>& x,
                                     std::vector<Eigen::Vector3f>& y) const {
  const std::size_t n = n_rows();
  y.resize(n);
  if (n == 0) return 0;
  const float* px = x.data()->data();
  const auto last = static_cast<Index>(n - 1);
  return parallel_sum(n, kRowGrain, 0.0, [&](std::size_t begin, std::size_t end) {
    double dot = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Index row_end = pattern_->row_begin[i + 1];
      const bool touches_last =
          i == n - 1 || (row_end > pattern_->row_begin[i] && pattern_->column[row_end - 1] == last);
      const Float4 yi = touches_last ? row_product<true>(*pattern_, blocks_.data(), added_[i], px, i)
                                     : row_product<false>(*pattern_, blocks_.data(), added_[i], px, i);
      y[i] = {yi[0], yi[1], yi[2]};
      dot += static_cast<double>(yi[0]) * x[i][0] + static_cast<double>(yi[1]) * x[i][1] +
             static_cast<double>(yi[2]) * x[i][2];
    }
    return dot;
  });
}

void BlockMatrix::finish_assembly() {
  parallel_for(n_rows(), kRowGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::array<double, 9> sum{};
      for (Index k = pattern_->row_begin[i]; k < pattern_->row_begin[i + 1]; ++k) {
        float* b = raw_block(static_cast<std::size_t>(k));
        if (static_cast<std::size_t>(pattern_->column[k]) < i) {
          const float* m = raw_block(static_cast<std::size_t>(pattern_->mirror[k]));
          for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c) b[3 * c + r] = m[3 * r + c];
        }
        for (int e = 0; e < 9; ++e) sum[e] += static_cast<double>(b[e]);
      }
      // Blocks of shear are not symmetric; their exact row sum is, up to the rounding of the floats.
      const Eigen::Map<const Eigen::Matrix3d> s(sum.data());
      elastic_diagonal_[i] = -0.5 * (s + s.transpose());
    }
  });
}

Eigen::MatrixXd BlockMatrix::to_dense() const {
  const auto n = static_cast<Eigen::Index>(n_rows());
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    dense.block<3, 3>(3 * i, 3 * i) = diagonal(static_cast<std::size_t>(i));
    for (Index k = pattern_->row_begin[i]; k < pattern_->row_begin[i + 1]; ++k)
      dense.block<3, 3>(3 * i, 3 * pattern_->column[k]) = block(static_cast<std::size_t>(k)).cast<double>();
  }
  return dense;
}

}  // namespace garment::simulator
