#include "runtime/modeller/reshape.hpp"

#include <Eigen/SparseCholesky>
#include <array>
#include <cmath>

#include "runtime/base/parallel.hpp"
#include "runtime/model/flat_index.hpp"
#include "runtime/modeller/pattern_warp.hpp"

namespace garment::modeller {
namespace {

using model::Index;
using model::Model;
using model::Vector2d;
using model::Vector3d;
using Gradient = Eigen::Matrix<double, 3, 2>;  // of positions by panel coordinates
using StretchTensor = Eigen::Matrix2d;
using Matrix = Eigen::SparseMatrix<double>;
using Vectors = std::vector<Vector3d>;

constexpr double kHeld = 1e-4;           // m, by which a held particle may be off
constexpr int kRounds = 3;              // of turning and solving
constexpr double kWeakLength = 10;      // m, over which the weak spring bends the cloth
constexpr double kRestingLength = 0.02; // m, the same of cloth that rests on a body
constexpr double kHoldStiffness = 1e3;  // of holds, against about 1 of the cloth
constexpr double kTouching = 4e-3;      // m from the body
constexpr double kUpward = 0.2;         // of the body's normal, from which it carries
constexpr double kFlat = 1e-9;          // ratio of areas at which a triangle has no direction

/// Gradients of the three hat functions of a triangle, and its area.
struct Triangle {
  std::array<Vector2d, 3> hat;
  double area = 0;
};

Triangle measure(const Model& m, std::size_t t) {
  const Vector2d &a = m.vertex_uv[m.triangle[t][0]], &b = m.vertex_uv[m.triangle[t][1]], &c = m.vertex_uv[m.triangle[t][2]];
  const double twice = (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  Triangle out;
  if (!(std::abs(twice) > 1e-14)) return {{Vector2d::Zero(), Vector2d::Zero(), Vector2d::Zero()}, 0};
  auto square = [&](const Vector2d& side) { return Vector2d(Vector2d(-side.y(), side.x()) / twice); };
  out.hat = {square(c - b), square(a - c), square(b - a)};
  out.area = std::abs(twice) / 2;
  return out;
}

Gradient gradient(const Model& m, std::size_t t, const Triangle& measure, const Vectors& x) {
  Gradient g = Gradient::Zero();
  const auto corner = m.corners(t);
  for (int k = 0; k < 3; ++k) g += x[corner[k]] * measure.hat[k].transpose();
  return g;
}

/// The square root of g^T g.
StretchTensor stretch_of(const Gradient& g) {
  const StretchTensor c = g.transpose() * g;
  const double root = std::sqrt(std::max(0.0, c.determinant()));
  const double size = std::sqrt(c.trace() + 2 * root);
  if (!(root > kFlat) || !(size > 0)) return StretchTensor::Identity();
  return (c + root * StretchTensor::Identity()) / size;
}

/// g without its stretch; zero where it has no direction.
Gradient turn_of(const Gradient& g) {
  const StretchTensor s = stretch_of(g);
  const Gradient turn = g * s.inverse();
  const bool well = (turn.transpose() * turn - StretchTensor::Identity()).norm() < 1e-3;
  return well ? turn : Gradient(Gradient::Zero());
}

/// How the cloth was stretched at the places of the new triangles; not at all in new panels.
std::vector<StretchTensor> old_stretches(const ModelledGarment& before, const Vectors& position, const ModelledGarment& now) {
  const Model &is = now.model, &was = before.model;
  std::vector<StretchTensor> out(is.n_triangles(), StretchTensor::Identity());
  for (std::size_t p = 0; p < is.panels.size(); ++p) {
    const Index old = find_panel(was, is.panels[p].name);
    if (old < 0) continue;
    const model::FlatIndex index(was, old);
    const PatternWarp warp(before.garment.panels[old], now.garment.panels[p]);
    const model::PanelRange& range = is.panels[p];
    parallel_for(static_cast<std::size_t>(range.n_triangles), 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const std::size_t t = static_cast<std::size_t>(range.first_triangle) + k;
        Vector2d middle = Vector2d::Zero();
        for (Index v : is.triangle[t]) middle += is.vertex_uv[v] / 3;
        std::array<double, 3> w{};
        const Index there = index.locate(warp(middle), w);
        if (there < 0) continue;
        const auto from = static_cast<std::size_t>(there);
        out[t] = stretch_of(gradient(was, from, measure(was, from), position));
      }
    });
  }
  return out;
}

/// One linear system for each axis: the matrices differ in what is held.
class Reshaping {
 public:
  Reshaping(const Model& m, const Vectors& laid, const std::vector<body::Body>& bodies) : m_(m), laid_(laid) {
    const std::size_t n = m.n_particles();
    std::vector<double> area(n, 0);
    triangle_.resize(m.n_triangles());
    for (std::size_t t = 0; t < m.n_triangles(); ++t) {
      triangle_[t] = measure(m, t);
      for (Index i : m.corners(t)) area[i] += triangle_[t].area / 3;
    }
    for (int axis = 0; axis < 3; ++axis) {
      spring_[axis].resize(n);
      for (std::size_t i = 0; i < n; ++i)
        spring_[axis][i] = std::max(area[i], 1e-12) / (kWeakLength * kWeakLength);
      aim_[axis].resize(n);
      for (std::size_t i = 0; i < n; ++i) aim_[axis][i] = laid[i][axis];
    }
    rest_on(bodies, area);
    hold();
    factor();
  }

  Vectors solve(const std::vector<StretchTensor>& stretch, const Vectors& x) {
    const std::size_t n = m_.n_particles();
    std::array<Eigen::VectorXd, 3> right;
    for (int axis = 0; axis < 3; ++axis) right[axis] = spring_[axis].cwiseProduct(aim_[axis]);
    for (std::size_t t = 0; t < m_.n_triangles(); ++t) {
      const Gradient wanted = turn_of(gradient(m_, t, triangle_[t], x)) * stretch[t];
      const auto corner = m_.corners(t);
      for (int k = 0; k < 3; ++k) {
        const Vector3d part = triangle_[t].area * (wanted * triangle_[t].hat[k]);
        for (int axis = 0; axis < 3; ++axis) right[axis][corner[k]] += part[axis];
      }
    }
    Vectors out(n);
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::VectorXd found = solver_[axis == 1 ? 1 : 0].solve(right[axis]);
      for (std::size_t i = 0; i < n; ++i) out[i][axis] = found[static_cast<Eigen::Index>(i)];
    }
    return out;
  }

  bool well() const { return well_; }

 private:
  /// Cloth on shoulders, or on a floor, keeps its height.
  void rest_on(const std::vector<body::Body>& bodies, const std::vector<double>& area) {
    parallel_for(laid_.size(), 128, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        for (const body::Body& body : bodies) {
          const auto near = body.closest(laid_[i], kTouching);
          if (!near || near->normal.y() < kUpward) continue;
          spring_[1][static_cast<Eigen::Index>(i)] += area[i] * near->normal.y() / (kRestingLength * kRestingLength);
        }
    });
  }

  /// Holds in a plane are levels: they hold the height.
  void hold() {
    for (std::size_t h = 0; h < m_.hold_particle.size(); ++h)
      for (int axis = 0; axis < 3; ++axis) {
        if (m_.hold_kind[h] == model::HoldKind::plane && axis != 1) continue;
        spring_[axis][m_.hold_particle[h]] += kHoldStiffness;
        aim_[axis][m_.hold_particle[h]] = m_.hold_point[h][axis];
      }
  }

  void factor() {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(9 * m_.n_triangles());
    for (std::size_t t = 0; t < m_.n_triangles(); ++t) {
      const auto corner = m_.corners(t);
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          if (corner[a] >= corner[b])
            entries.emplace_back(corner[a], corner[b], triangle_[t].area * triangle_[t].hat[a].dot(triangle_[t].hat[b]));
    }
    const auto n = static_cast<Eigen::Index>(m_.n_particles());
    for (int which = 0; which < 2; ++which) {
      std::vector<Eigen::Triplet<double>> all = entries;
      for (Eigen::Index i = 0; i < n; ++i) all.emplace_back(i, i, spring_[which][i]);
      Matrix matrix(n, n);
      matrix.setFromTriplets(all.begin(), all.end());
      solver_[which].compute(matrix);
      well_ = well_ && solver_[which].info() == Eigen::Success;
    }
  }

  const Model& m_;
  const Vectors& laid_;
  std::vector<Triangle> triangle_;
  std::array<Eigen::VectorXd, 3> spring_, aim_;       // of each axis [n_particles]
  std::array<Eigen::SimplicialLDLT<Matrix>, 2> solver_;  // of x and z, of y
  bool well_ = true;
};

/// Nothing was changed, and every hold is where it was?
bool at_home(const Model& m, const Transferred& laid) {
  if (laid.n_kept < m.n_particles()) return false;
  for (std::size_t h = 0; h < m.hold_particle.size(); ++h) {
    const Vector3d off = laid.position[m.hold_particle[h]] - m.hold_point[h];
    const bool point = m.hold_kind[h] == model::HoldKind::point;
    if ((point ? off.norm() : std::abs(off.dot(m.hold_normal[h]))) > kHeld) return false;
  }
  return true;
}

}  // namespace

Vectors reshape(const ModelledGarment& before, const Vectors& position, const ModelledGarment& now,
                const Transferred& laid, const std::vector<body::Body>& bodies) {
  if (at_home(now.model, laid)) return laid.position;
  const std::vector<StretchTensor> stretch = old_stretches(before, position, now);
  Reshaping reshaping(now.model, laid.position, bodies);
  if (!reshaping.well()) return laid.position;
  Vectors x = laid.position;
  for (int round = 0; round < kRounds; ++round) x = reshaping.solve(stretch, x);
  return x;
}

}  // namespace garment::modeller
