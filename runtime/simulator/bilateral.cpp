#include "runtime/simulator/bilateral.hpp"

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>

namespace garment::simulator {
namespace {

using Eigen::Vector3d;
using Vectors = std::vector<Vector3d>;

constexpr double kRegularised = 1e-9;  // of a row's diagonal
constexpr double kRedundant = 1e-7;    // pivot over diagonal of a row that says nothing new
constexpr double kNoGradient = 1e-20;  // of a squared gradient

ConstraintRow hold_row(Index particle, const Vector3d& n, double value, double drift, std::size_t hold) {
  ConstraintRow row;
  row.n = 1;
  row.particle[0] = particle;
  row.gradient[0] = n;
  row.value = value;
  row.drift = drift;
  row.hold = static_cast<int>(hold);
  return row;
}

/// Rows of a tie that is a rod, or a thread drawn taut.
void add_tie(const model::Model& m, std::size_t t, bool rod, const Vectors& x, const Vectors& v, std::vector<ConstraintRow>& rows) {
  const Vector3d d = m.tie_span(t, x), rate = m.tie_span(t, v);
  const double size = d.norm(), length = m.tie_length[t];
  if (!rod && size < length) return;
  ConstraintRow row;
  row.n = 6;
  row.particle = m.tie[t];
  auto spread = [&](const Vector3d& n) {
    for (int k = 0; k < 6; ++k) row.gradient[k] = (k < 3 ? -1 : 1) * m.tie_weights[t][k] * n;
  };
  if (length == 0) {  // the places are to be one: three rows
    for (int axis = 0; axis < 3; ++axis) {
      spread(Vector3d::Unit(axis));
      row.value = d[axis];
      rows.push_back(row);
    }
    return;
  }
  const Vector3d n = d / std::max(size, 1e-12);
  spread(n);
  row.value = size - length;
  row.bend = (rate.squaredNorm() - rate.dot(n) * rate.dot(n)) / std::max(size, 1e-12);
  row.pulls_only = !rod;
  if (!rod && m.tie_stiffness[t] > 0) row.give = 1 / m.tie_stiffness[t];
  rows.push_back(row);
}

/// (J W JT + give / tau^2) lambda = b over the rows in `use`.
Eigen::VectorXd solve(const model::Model& m, const std::vector<ConstraintRow>& rows, const std::vector<std::size_t>& use,
                      const Eigen::VectorXd& b, double tau, std::size_t& redundant) {
  struct Entry {
    Index particle;
    int row, slot;
  };
  std::vector<Entry> at;
  for (std::size_t r = 0; r < use.size(); ++r)
    for (int k = 0; k < rows[use[r]].n; ++k) at.push_back({rows[use[r]].particle[k], static_cast<int>(r), k});
  std::stable_sort(at.begin(), at.end(), [](const Entry& a, const Entry& c) { return a.particle < c.particle; });
  std::vector<Eigen::Triplet<double>> triplets;
  for (std::size_t begin = 0, end = 0; begin < at.size(); begin = end) {
    while (end < at.size() && at[end].particle == at[begin].particle) ++end;
    for (std::size_t a = begin; a < end; ++a)
      for (std::size_t c = begin; c < end; ++c)
        triplets.emplace_back(at[a].row, at[c].row,
                              rows[use[at[a].row]].gradient[at[a].slot].dot(rows[use[at[c].row]].gradient[at[c].slot]) /
                                  m.mass[at[a].particle]);
  }
  const auto n = static_cast<Eigen::Index>(use.size());
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(triplets.begin(), triplets.end());
  for (Eigen::Index r = 0; r < n; ++r) A.coeffRef(r, r) += rows[use[static_cast<std::size_t>(r)]].give / (tau * tau);
  const Eigen::VectorXd diagonal = A.diagonal();
  for (Eigen::Index r = 0; r < n; ++r) A.coeffRef(r, r) += kRegularised * diagonal[r];
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(A);
  if (factor.info() != Eigen::Success) {
    redundant = static_cast<int>(n);
    return Eigen::VectorXd::Zero(n);
  }
  const Eigen::VectorXd pivots = factor.vectorD();
  const Eigen::VectorXd ordered = factor.permutationP() * diagonal;
  redundant = 0;
  for (Eigen::Index r = 0; r < n; ++r) redundant += pivots[r] < kRedundant * ordered[r] ? 1 : 0;
  return factor.solve(b);
}

/// False where sewing has made one particle of what the constraint holds apart.
bool moves_something(const ConstraintRow& row) {
  for (int k = 0; k < row.n; ++k) {
    Vector3d sum = Vector3d::Zero();
    for (int j = 0; j < row.n; ++j)
      if (row.particle[j] == row.particle[k]) sum += row.gradient[j];
    if (sum.squaredNorm() > kNoGradient) return true;
  }
  return false;
}

}  // namespace

std::vector<ConstraintRow> constraint_rows(const model::Model& m, const MovingCloth& cloth, const Vectors& x, const Vectors& v, double h) {
  std::vector<ConstraintRow> rows;
  for (std::size_t k = 0; k < m.hold_particle.size(); ++k) {
    const Index i = m.hold_particle[k];
    const Vector3d way = cloth.hold_motion(k), off = x[i] - (m.hold_point[k] - way), drift = -way / h;
    if (m.hold_kind[k] == model::HoldKind::plane) {
      const Vector3d n = m.hold_normal[k].normalized();
      rows.push_back(hold_row(i, n, n.dot(off), n.dot(drift), k));
      continue;
    }
    for (int axis = 0; axis < 3; ++axis) rows.push_back(hold_row(i, Vector3d::Unit(axis), off[axis], drift[axis], k));
  }
  for (std::size_t t = 0; t < m.tie.size(); ++t)
    add_tie(m, t, std::binary_search(m.rod_tie.begin(), m.rod_tie.end(), static_cast<Index>(t)), x, v, rows);
  return rows;
}

Reactive reactive_forces(const model::Model& m, const std::vector<ConstraintRow>& rows, const Vectors& active, const Vectors& v,
                         double tau) {
  Reactive out;
  out.force.assign(active.size(), Vector3d::Zero());
  out.of_holds = out.force;
  std::vector<std::size_t> use;
  for (std::size_t r = 0; r < rows.size(); ++r)
    if (moves_something(rows[r])) use.push_back(r);
  Eigen::VectorXd lambda;
  while (!use.empty()) {  // ends: every round but the last drops a thread
    Eigen::VectorXd b(static_cast<Eigen::Index>(use.size()));
    for (std::size_t r = 0; r < use.size(); ++r) {
      const ConstraintRow& row = rows[use[r]];
      double pushed = 0, rate = row.drift;
      for (int k = 0; k < row.n; ++k) {
        pushed += row.gradient[k].dot(active[row.particle[k]]) / m.mass[row.particle[k]];
        rate += row.gradient[k].dot(v[row.particle[k]]);
      }
      b[static_cast<Eigen::Index>(r)] = -(pushed + row.bend + 2 / tau * rate + row.value / (tau * tau));
    }
    lambda = solve(m, rows, use, b, tau, out.redundant);
    std::vector<std::size_t> kept;
    for (std::size_t r = 0; r < use.size(); ++r)
      if (!rows[use[r]].pulls_only || lambda[static_cast<Eigen::Index>(r)] <= 0) kept.push_back(use[r]);
    if (kept.size() == use.size()) break;
    use.swap(kept);
    lambda.resize(0);
  }
  for (std::size_t r = 0; r < use.size() && lambda.size() > 0; ++r) {
    const ConstraintRow& row = rows[use[r]];
    for (int k = 0; k < row.n; ++k) {
      const Vector3d f = lambda[static_cast<Eigen::Index>(r)] * row.gradient[k];
      out.force[row.particle[k]] += f;
      if (row.hold >= 0) out.of_holds[row.particle[k]] += f;
    }
  }
  return out;
}

}  // namespace garment::simulator
