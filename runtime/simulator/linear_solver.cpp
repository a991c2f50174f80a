#include "runtime/simulator/linear_solver.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/base/parallel.hpp"

namespace garment::simulator {
namespace {

constexpr std::size_t kVectorGrain = 2048;

}  // namespace

/// Ap_ = A p_ with the contacts; returns p_ . Ap_.
double LinearSolver::multiply(const BlockMatrix& matrix, const std::vector<ContactStiffness>& contacts) {
  double sum = matrix.multiply_and_dot(p_, Ap_);
  for (const ContactStiffness& c : contacts) {
    float along = 0;
    for (int k = 0; k < 4; ++k)
      if (c.particle[k] >= 0) along += c.weight[k] * c.normal.dot(p_[c.particle[k]]);
    for (int k = 0; k < 4; ++k) {
      if (c.particle[k] < 0) continue;
      // The contact's own diagonal block is in the matrix already: take it off again.
      float own = c.weight[k] * c.normal.dot(p_[c.particle[k]]);
      float scale = c.stiffness * c.weight[k] * (along - own);
      Ap_[c.particle[k]] += scale * c.normal;
      sum += static_cast<double>(scale) * c.normal.dot(p_[c.particle[k]]);
    }
  }
  holds_.filter(Ap_);
  return sum;
}

LinearResult LinearSolver::solve(const BlockMatrix& matrix, const std::vector<ContactStiffness>& contacts,
                                 const std::vector<Eigen::Vector3d>& b, double tolerance, int max_iterations,
                                 std::vector<Eigen::Vector3d>& x,
                                 const std::vector<Eigen::Vector3d>* positions, bool begun) {
  const std::size_t n = b.size();
  if (begun)
    preconditioner_.factor_diagonal(matrix);
  else
    preconditioner_.factor(matrix, positions, contacts);
  r_.resize(n);
  for (std::size_t i = 0; i < n; ++i) r_[i] = holds_.filtered(i, b[i]).cast<float>();
  x_.assign(n, Eigen::Vector3f::Zero());
  double rz = preconditioner_.apply(r_, z_);
  const double start = rz;
  if (begun) {
    p_.resize(n);
    for (std::size_t i = 0; i < n; ++i) p_[i] = holds_.filtered(i, x[i]).cast<float>();
    multiply(matrix, contacts);
    for (std::size_t i = 0; i < n; ++i) Ap_[i] = r_[i] - Ap_[i];
    const double left = preconditioner_.apply(Ap_, z_);
    if (left < start) {  // else zero is nearer
      x_.swap(p_);
      r_.swap(Ap_);
      rz = left;
    } else {
      preconditioner_.apply(r_, z_);
    }
  }
  p_ = z_;
  LinearResult result;
  while (result.iterations < max_iterations && rz > tolerance * tolerance * start && rz > 0) {
    const double pAp = multiply(matrix, contacts);
    if (!(pAp > 0)) break;
    const auto alpha = static_cast<float>(rz / pAp);
    parallel_for(n, kVectorGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        x_[i] += alpha * p_[i];
        r_[i] -= alpha * Ap_[i];
      }
    });
    const double next = preconditioner_.apply(r_, z_);
    const auto beta = static_cast<float>(next / rz);
    rz = next;
    parallel_for(n, kVectorGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) p_[i] = z_[i] + beta * p_[i];
    });
    ++result.iterations;
  }
  result.reduction = start > 0 ? std::sqrt(std::max(rz, 0.0) / start) : 0;
  x.resize(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = x_[i].cast<double>();
  return result;
}

}  // namespace garment::simulator
