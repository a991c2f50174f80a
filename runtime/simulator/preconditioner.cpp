#include "runtime/simulator/preconditioner.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "runtime/base/parallel.hpp"

namespace garment::simulator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3f;
using model::Index;

// Measured on sheets and skirts of 2,500 to 40,000 particles with groups of 12 to 64: smaller ones save
// iterations, but past a thousand groups their factorisation costs more than that.
constexpr std::size_t kAggregateSize = 20, kLargestSize = 64, kMostGroups = 1000;
constexpr int kTranslatedSize = 16;  // without rotations
constexpr std::size_t kGroupGrain = 32;
constexpr double kShift = 1e-9;  // share of its trace that every coarse diagonal block gains

/// The matrix with [d]x v = d x v.
Matrix3d cross_matrix(const Vector3d& d) {
  Matrix3d m;
  m << 0, -d.z(), d.y(), d.z(), 0, -d.x(), -d.y(), d.x(), 0;
  return m;
}

/// Adds Q_i^T B Q_j for a block B between particles with offsets di and dj.
void add_projected(const Matrix3d& b, const Matrix3d& di_cross, const Vector3f& dj,
                   BlockCholesky::Block& out) {
  const Matrix3d right = -b * cross_matrix(dj.cast<double>());
  out.topLeftCorner<3, 3>() += b;
  out.topRightCorner<3, 3>() += right;
  out.bottomLeftCorner<3, 3>() += di_cross * b;
  out.bottomRightCorner<3, 3>() += di_cross * right;
}

}  // namespace

Preconditioner::Preconditioner(const BlockPattern& pattern, const Holds& holds)
    : pattern_(pattern), holds_(holds), offset_(pattern.n_rows()), inverse_diagonal_(pattern.n_rows()) {}

void Preconditioner::group(const std::vector<Vector3d>* positions) {
  const std::size_t rigid_size = std::clamp(pattern_.n_rows() / kMostGroups, kAggregateSize, kLargestSize);
  groups_ = group_particles(pattern_, holds_, positions,
                            positions ? static_cast<int>(rigid_size) : kTranslatedSize);
  make_coarse_pattern();
  grouped_ = true;
  rounded_ = positions != nullptr;
}

void Preconditioner::make_coarse_pattern() {
  const std::size_t n_groups = groups_.size();
  coarse_begin_.assign(1, 0);
  places_.clear();
  target_.assign(pattern_.n_blocks(), -1);
  std::vector<int> slot(n_groups, -1);  // of coarse column b in the row under work
  for (std::size_t a = 0; a < n_groups; ++a) {
    const int row = static_cast<int>(a);
    std::vector<int> columns{row};
    auto for_lower = [&](auto&& act) {
      for (Index m = groups_.begin[a]; m < groups_.begin[a + 1]; ++m) {
        const Index i = groups_.member[m];
        for (Index k = pattern_.row_begin[i]; k < pattern_.row_begin[i + 1]; ++k)
          if (const int b = groups_.of[pattern_.column[k]]; b >= 0 && b <= row) act(k, b);
      }
    };
    for_lower([&](Index, int b) { columns.push_back(b); });
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    for (int b : columns) {
      slot[b] = static_cast<int>(places_.size());
      places_.push_back({row, b});
    }
    for_lower([&](Index k, int b) { target_[k] = slot[b]; });
    coarse_begin_.push_back(static_cast<int>(places_.size()));
  }
  touching_.clear();
  coarse_.resize(places_.size());
  coarse_r_.resize(n_groups);
  cholesky_.analyze(static_cast<int>(n_groups), places_);
}

/// Computes the offsets d.
void Preconditioner::place(const std::vector<Vector3d>* positions) {
  if (!positions) {
    std::fill(offset_.begin(), offset_.end(), Vector3f::Zero());
    return;
  }
  const std::vector<Vector3d>& x = *positions;
  parallel_for(groups_.size(), kGroupGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t a = begin; a < end; ++a) {
      const Index first = groups_.begin[a], last = groups_.begin[a + 1];
      Vector3d middle = Vector3d::Zero();
      for (Index m = first; m < last; ++m) middle += x[groups_.member[m]];
      middle /= last - first;
      double square = 0;
      for (Index m = first; m < last; ++m) square += (x[groups_.member[m]] - middle).squaredNorm();
      const double radius = std::sqrt(square / (last - first));
      for (Index m = first; m < last; ++m) {
        const Index i = groups_.member[m];
        offset_[i] = radius > 0 ? Vector3f(((x[i] - middle) / radius).cast<float>()) : Vector3f::Zero();
      }
    }
  });
}

void Preconditioner::gather_coarse_row(const BlockMatrix& matrix, std::size_t a) {
  for (int c = coarse_begin_[a]; c < coarse_begin_[a + 1]; ++c) coarse_[c].setZero();
  BlockCholesky::Block& diagonal = coarse_[coarse_begin_[a + 1] - 1];
  for (Index m = groups_.begin[a]; m < groups_.begin[a + 1]; ++m) {
    const auto i = static_cast<std::size_t>(groups_.member[m]);
    const Matrix3d di = cross_matrix(offset_[i].cast<double>());
    const bool plain = holds_.is_free(i);
    const Matrix3d p = holds_.projector(i);
    add_projected(plain ? matrix.diagonal(i) : Matrix3d(p * matrix.diagonal(i) * p), di, offset_[i],
                  diagonal);
    for (Index k = pattern_.row_begin[i]; k < pattern_.row_begin[i + 1]; ++k) {
      if (target_[k] < 0) continue;
      const auto j = static_cast<std::size_t>(pattern_.column[k]);
      Matrix3d block = matrix.block(static_cast<std::size_t>(k)).cast<double>();
      if (!plain || !holds_.is_free(j)) block = p * block * holds_.projector(j);
      add_projected(block, di, offset_[j], coarse_[target_[k]]);
    }
  }
}

/// The groups of the contact's particles, ascending, each once; returns how many.
int Preconditioner::touched_groups(const ContactStiffness& c, std::array<int, 4>& groups) const {
  int n = 0;
  for (const Index i : c.particle)
    if (i >= 0 && groups_.of[i] >= 0) groups[n++] = groups_.of[i];
  std::sort(groups.begin(), groups.begin() + n);
  return static_cast<int>(std::unique(groups.begin(), groups.begin() + n) - groups.begin());
}

/// Where the coarse block (row, column) stands, row >= column; -1 if it is not there.
int Preconditioner::coarse_slot(int row, int column) const {
  const std::array<int, 2> wanted{row, column};
  auto at = std::lower_bound(places_.begin() + coarse_begin_[row], places_.begin() + coarse_begin_[row + 1],
                             wanted);
  if (at != places_.begin() + coarse_begin_[row + 1] && *at == wanted)
    return static_cast<int>(at - places_.begin());
  at = std::lower_bound(touching_.begin(), touching_.end(), wanted);
  if (at == touching_.end() || *at != wanted) return -1;
  return static_cast<int>(places_.size() + (at - touching_.begin()));
}

/// Makes room in the coarse matrix for the pairs of groups that these contacts connect.
void Preconditioner::connect_touching(const std::vector<ContactStiffness>& contacts) {
  std::vector<std::array<int, 2>> pairs;
  for (const ContactStiffness& c : contacts) {
    std::array<int, 4> groups{};
    const int n = touched_groups(c, groups);
    for (int k = 1; k < n; ++k)
      for (int l = 0; l < k; ++l) {
        const int slot = coarse_slot(groups[k], groups[l]);
        if (slot < 0 || slot >= static_cast<int>(places_.size())) pairs.push_back({groups[k], groups[l]});
      }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  if (pairs == touching_) return;
  touching_ = std::move(pairs);
  std::vector<std::array<int, 2>> all = places_;
  all.insert(all.end(), touching_.begin(), touching_.end());
  coarse_.resize(all.size());
  cholesky_.analyze(static_cast<int>(groups_.size()), all);
}

/// Adds Q^T (stiffness g gT) Q without what the diagonal blocks of the particles brought in already:
///   u_a = sum over particles k in a of w_k q_k,  q_k = Q_k^T n,
///   block (a, b) += stiffness u_a u_b^T,  block (a, a) -= stiffness w_k^2 q_k q_k^T.
void Preconditioner::add_contact(const ContactStiffness& c) {
  using Vector = BlockCholesky::Vector;
  std::array<int, 4> groups{};
  const int n = touched_groups(c, groups);
  std::array<Vector, 4> u;
  u.fill(Vector::Zero());
  for (int k = 0; k < 4; ++k) {
    const Index i = c.particle[k];
    if (i < 0 || groups_.of[i] < 0) continue;
    Vector q;
    q.head<3>() = c.weight[k] * holds_.filtered(i, Vector3d(c.normal.cast<double>()));
    q.tail<3>() = offset_[i].cast<double>().cross(Vector3d(q.head<3>()));
    const auto a = std::find(groups.begin(), groups.begin() + n, groups_.of[i]) - groups.begin();
    u[a] += q;
    coarse_[coarse_begin_[groups[a] + 1] - 1].noalias() -= (c.stiffness * q) * q.transpose();
  }
  for (int k = 0; k < n; ++k)
    for (int l = 0; l <= k; ++l)
      coarse_[coarse_slot(groups[k], groups[l])].noalias() += (c.stiffness * u[k]) * u[l].transpose();
}

void Preconditioner::factor_diagonal(const BlockMatrix& matrix) {
  parallel_for(matrix.n_rows(), kRowGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      inverse_diagonal_[i] = matrix.diagonal(i).inverse().cast<float>();
  });
}

void Preconditioner::factor(const BlockMatrix& matrix, const std::vector<Vector3d>* positions,
                            const std::vector<ContactStiffness>& contacts) {
  if (!grouped_ || (positions && !rounded_)) group(positions);
  place(positions);
  connect_touching(contacts);
  factor_diagonal(matrix);
  parallel_for(groups_.size(), kGroupGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t a = begin; a < end; ++a) gather_coarse_row(matrix, a);
  });
  for (std::size_t k = 0; k < touching_.size(); ++k) coarse_[places_.size() + k].setZero();
  for (const ContactStiffness& c : contacts) add_contact(c);
  for (std::size_t a = 0; a < groups_.size(); ++a) {
    // Rotations that do nothing (of one particle, about a straight line) leave zeros: the shift keeps them at
    // rest.
    BlockCholesky::Block& diagonal = coarse_[coarse_begin_[a + 1] - 1];
    const double trace = diagonal.trace();
    diagonal.diagonal().array() += kShift * trace + 1e-30;
  }
  cholesky_.factor(coarse_);
}

double Preconditioner::apply(const std::vector<Vector3f>& r, std::vector<Vector3f>& z) {
  z.resize(r.size());
  parallel_for(groups_.size(), kGroupGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t a = begin; a < end; ++a) {
      BlockCholesky::Vector sum = BlockCholesky::Vector::Zero();
      for (Index m = groups_.begin[a]; m < groups_.begin[a + 1]; ++m) {
        const Index i = groups_.member[m];
        sum.head<3>() += r[i].cast<double>();
        sum.tail<3>() += offset_[i].cross(r[i]).cast<double>();
      }
      coarse_r_[a] = sum;
    }
  });
  cholesky_.solve(coarse_r_);
  return parallel_sum(r.size(), kRowGrain, 0.0, [&](std::size_t begin, std::size_t end) {
    double rz = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Index a = groups_.of[i];
      if (a < 0) {
        z[i].setZero();
        continue;
      }
      const Vector3f shift = coarse_r_[a].head<3>().cast<float>(),
                     turn = coarse_r_[a].tail<3>().cast<float>();
      z[i] = holds_.filtered(i, Vector3f(inverse_diagonal_[i] * r[i] + shift + turn.cross(offset_[i])));
      rz += static_cast<double>(r[i].x()) * z[i].x() + static_cast<double>(r[i].y()) * z[i].y() +
            static_cast<double>(r[i].z()) * z[i].z();
    }
    return rz;
  });
}

}  // namespace garment::simulator
