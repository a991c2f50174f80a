#include "runtime/modeller/chart.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "runtime/base/portable_math.hpp"

namespace garment::modeller {
namespace {

using Eigen::Vector2d;
using geometry::cross;
using model::Index;

/// A side of the developed region: triangle `t` lies beyond it.
struct Front {
  Index t;
  Index a, b;  // particles
  Vector2d at_a, at_b;
  Vector2d inner;  // a point on the developed side
};

/// The third particle of the triangle beyond `f`, laid out rigidly over the side; false where it has none.
bool unfold(const Sheet& sheet, const model::Model& model, const Front& f, Index& apex, Vector2d& at,
            int corner[3]) {
  const model::Indices<3>& p = sheet.particle[f.t];
  int ka = -1, kb = -1;
  for (int k = 0; k < 3; ++k) {
    if (p[k] == f.a) ka = k;
    if (p[k] == f.b) kb = k;
  }
  if (ka < 0 || kb < 0) return false;
  int kc = 3 - ka - kb;
  Vector2d a = model.vertex_uv[sheet.vertex[f.t][ka]], b = model.vertex_uv[sheet.vertex[f.t][kb]],
           c = model.vertex_uv[sheet.vertex[f.t][kc]];
  Vector2d side = b - a, laid = f.at_b - f.at_a;
  double along = (c - a).dot(side) / side.squaredNorm(), height = std::abs(cross(side, c - a)) / side.norm();
  Vector2d out(-laid.y(), laid.x());
  out /= out.norm();
  if (out.dot(f.inner - f.at_a) > 0) out = -out;
  apex = p[kc];
  at = f.at_a + along * laid + height * out;
  corner[0] = ka;
  corner[1] = kb;
  corner[2] = kc;
  return true;
}

}  // namespace

std::optional<Chart> develop(const Sheet& sheet, const model::Model& model, Index centre, int layers) {
  Chart chart;
  chart.fan = closed_fan(sheet, centre);
  std::size_t n = chart.fan.size();
  if (n < 3) return std::nullopt;
  std::vector<double> angle(n), length_here(n), length_ahead(n);
  double total = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const FanTriangle& f = chart.fan[k];
    const model::Indices<3>& v = sheet.vertex[f.triangle];
    Vector2d o = model.vertex_uv[v[f.centre]], a = model.vertex_uv[v[f.here]] - o,
             b = model.vertex_uv[v[f.ahead]] - o;
    angle[k] = portable::atan2(std::abs(cross(a, b)), a.dot(b));
    length_here[k] = a.norm();
    length_ahead[k] = b.norm();
    total += angle[k];
  }
  constexpr double kTurn = 2 * portable::kPi;
  if (total < 0.5 * kTurn || total > 2 * kTurn) return std::nullopt;
  double direction = 0;
  for (std::size_t k = 0; k < n; ++k) {
    // a merged side may have two rest lengths (ease): the mean of both triangles
    double length = 0.5 * (length_here[k] + length_ahead[(k + n - 1) % n]);
    Index p = sheet.particle[chart.fan[k].triangle][chart.fan[k].here];
    for (const Chart::Point& known : chart.points)
      if (known.particle == p) return std::nullopt;  // a tube three particles round
    chart.points.push_back({p, {length * portable::cos(direction), length * portable::sin(direction)}});
    direction += angle[k] * (kTurn / total);
  }
  std::vector<Front> fronts;
  for (std::size_t k = 0; k < n; ++k) {
    const Chart::Point &a = chart.points[k], &b = chart.points[(k + 1) % n];
    chart.fan_at.push_back({a.at, b.at});
    Index beyond = sheet.next[chart.fan[k].triangle][chart.fan[k].centre];
    if (beyond >= 0) fronts.push_back({beyond, a.particle, b.particle, a.at, b.at, Vector2d(0, 0)});
  }
  for (int layer = 1; layer < layers; ++layer) {
    std::vector<Front> further;
    for (const Front& f : fronts) {
      Index apex;
      Vector2d at;
      int corner[3];
      if (!unfold(sheet, model, f, apex, at, corner)) continue;
      bool known = apex == centre;
      for (const Chart::Point& p : chart.points) known = known || p.particle == apex;
      if (known) continue;
      chart.points.push_back({apex, at});
      Index over_b = sheet.next[f.t][corner[0]], over_a = sheet.next[f.t][corner[1]];
      if (over_b >= 0) further.push_back({over_b, f.b, apex, f.at_b, at, f.at_a});
      if (over_a >= 0) further.push_back({over_a, apex, f.a, at, f.at_a, f.at_b});
    }
    fronts = std::move(further);
  }
  return chart;
}

namespace {

/// The orthogonal factor of the QR decomposition of `a`, which has more rows than columns: [n x n]. Step by step, as Eigen's
/// HouseholderQR does it for so few columns; its products of blocks would take most of the time to compile this file.
Eigen::MatrixXd orthogonal_factor(Eigen::MatrixXd a) {
  const Eigen::Index n = a.rows(), columns = a.cols();
  std::vector<double> work(static_cast<std::size_t>(n)), coefficient(static_cast<std::size_t>(columns));
  for (Eigen::Index k = 0; k < columns; ++k) {
    double diagonal = 0, &c = coefficient[static_cast<std::size_t>(k)];
    a.col(k).tail(n - k).makeHouseholderInPlace(c, diagonal);
    a(k, k) = diagonal;
    a.bottomRightCorner(n - k, columns - k - 1).applyHouseholderOnTheLeft(a.col(k).tail(n - k - 1), c, work.data());
  }
  Eigen::MatrixXd q = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index k = columns; k-- > 0;)
    q.bottomRows(n - k).applyHouseholderOnTheLeft(a.col(k).tail(n - k - 1), coefficient[static_cast<std::size_t>(k)], work.data());
  return q;
}

/// Rows: the quadratic's terms at every point, times the point's weight (`root`). An orthonormal basis of what the rows do
/// not reach, three vectors a group.
void add_residual(const std::vector<Eigen::Matrix<double, 5, 1>>& rows, const std::vector<double>& root, double scale,
                  CurvatureFit& fit) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  if (n <= 5) return;
  Eigen::MatrixXd terms(n, 5);
  for (Eigen::Index j = 0; j < n; ++j) terms.row(j) = rows[j].transpose();
  const Eigen::MatrixXd basis = orthogonal_factor(std::move(terms));
  for (Eigen::Index first = 5; first < n; first += 3) {
    std::vector<Eigen::Vector3d> group;
    Eigen::Vector3d sum(0, 0, 0);
    for (Eigen::Index j = 0; j < n; ++j) {
      Eigen::Vector3d w(0, 0, 0);
      for (Eigen::Index m = first; m < std::min(first + 3, n); ++m) w[m - first] = basis(j, m) * root[j] / (scale * scale);
      group.push_back(w);
      sum += w;
    }
    group.push_back(-sum);
    fit.residual.push_back(std::move(group));
  }
}

}  // namespace

CurvatureFit fit_curvature(const Chart& chart, Index centre, bool with_residual) {
  using Matrix5 = Eigen::Matrix<double, 5, 5>;
  using Vector5 = Eigen::Matrix<double, 5, 1>;
  CurvatureFit fit;
  double scale = 0;
  for (std::size_t k = 0; k < chart.fan.size(); ++k) scale += chart.points[k].at.norm();
  scale /= static_cast<double>(chart.fan.size());
  Matrix5 normal = Matrix5::Zero();
  std::vector<Vector5> rows;  // the quadratic's terms, weighted
  std::vector<double> root;
  for (const Chart::Point& p : chart.points) {
    double x = p.at.x() / scale, y = p.at.y() / scale;
    double weight =
        1 / std::max(1e-4, x * x + y * y);  // errors count by distance squared: nearer points tell more
    Vector5 row;
    row << x, y, x * x / 2, y * y / 2, x * y;
    rows.push_back(weight * row);
    root.push_back(weight);
    normal += rows.back() * rows.back().transpose();
  }
  Eigen::SelfAdjointEigenSolver<Matrix5> eigen(normal);
  Vector5 inverse;
  fit.complete = true;
  for (int k = 0; k < 5; ++k) {
    bool solid = eigen.eigenvalues()[k] > 1e-5 * eigen.eigenvalues()[4];
    inverse[k] = solid ? 1 / eigen.eigenvalues()[k] : 0;
    fit.complete = fit.complete && solid;
  }
  Matrix5 pseudo = eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
  Eigen::Vector3d sum(0, 0, 0);
  for (std::size_t j = 0; j < rows.size(); ++j) {
    Eigen::Vector3d w = (pseudo * rows[j]).tail<3>() * (root[j] / (scale * scale));
    fit.particle.push_back(chart.points[j].particle);
    fit.weight.push_back(w);
    sum += w;
  }
  fit.particle.push_back(centre);
  fit.weight.push_back(-sum);
  if (with_residual) add_residual(rows, root, scale, fit);
  return fit;
}

}  // namespace garment::modeller
