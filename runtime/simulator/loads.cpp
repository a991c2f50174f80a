#include "runtime/simulator/loads.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "runtime/base/portable_math.hpp"

namespace garment::simulator {

using Eigen::Vector3d;
using Vectors = std::vector<Vector3d>;

namespace {

constexpr double kGustPeriod = 3;  // s

Vector3d area_vector(const model::Indices<3>& c, const Vectors& x) {
  return 0.5 * (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]);
}

}  // namespace

Vector3d wind_at(const model::Air& air, double time) {
  if (air.gust == 0) return air.wind;
  return (1 + 0.5 * air.gust * (1 - portable::cos(2 * portable::kPi * time / kGustPeriod))) * air.wind;
}

Vector3d air_force(const Vector3d& a, const Vector3d& u, double drag) {
  const double area = a.norm();
  if (!(area > 0)) return Vector3d::Zero();
  const double along = kSkinShare * drag, pressure = 0.5 * kAirDensity * u.norm();
  return pressure * ((drag - along) * (u.dot(a) / area) * a + along * area * u);
}

Loads::Loads(const model::Model& model)
    : model_(model), empty_(model.load_particle.empty() && model.pressed_triangle.empty() && model.air.still()) {}

void Loads::follow(const Vectors& x, const Vectors* velocity, double time) {
  if (empty_) return;
  force_.assign(x.size(), Vector3d::Zero());
  for (std::size_t k = 0; k < model_.load_particle.size(); ++k) force_[model_.load_particle[k]] += model_.load_force[k];
  triangle_stiffness_.assign(model_.n_triangles(), 0);
  auto share = [&](std::size_t t, const model::Indices<3>& c, const Vector3d& a, const Vector3d& f) {
    for (const model::Index i : c) force_[i] += f / 3;
    triangle_stiffness_[t] += f.norm() / std::sqrt(std::max(a.norm(), 1e-12)) / 3;
  };
  for (std::size_t k = 0; k < model_.pressed_triangle.size(); ++k) {
    const auto t = static_cast<std::size_t>(model_.pressed_triangle[k]);
    const auto c = model_.corners(t);
    const Vector3d a = area_vector(c, x);
    share(t, c, a, model_.pressed_pascals[k] * a);
  }
  if (model_.air.still()) return;
  const Vector3d wind = wind_at(model_.air, time);
  air_damping_.assign(x.size(), 0);
  for (std::size_t t = 0; t < model_.n_triangles(); ++t) {
    const auto c = model_.corners(t);
    Vector3d u = wind;
    if (velocity) u -= ((*velocity)[c[0]] + (*velocity)[c[1]] + (*velocity)[c[2]]) / 3;
    const Vector3d a = area_vector(c, x);
    share(t, c, a, air_force(a, u, model_.air.drag));
    for (const model::Index i : c) air_damping_[i] += kAirDensity * u.norm() * model_.air.drag * a.norm() / 3;
  }
}

void Loads::add(Vectors& force, double scale) const {
  for (std::size_t i = 0; i < force_.size(); ++i) force[i] += scale * force_[i];
}

void Loads::add_stiffness(BlockMatrix& matrix, double scale) {
  if (triangle_stiffness_.empty()) return;
  if (triangle_blocks_.empty())
    for (std::size_t t = 0; t < model_.n_triangles(); ++t) {
      const auto c = model_.corners(t);
      model::Indices<3>& blocks = triangle_blocks_.emplace_back();
      for (int k = 0; k < 3; ++k) {
        const model::Index a = std::min(c[k], c[(k + 1) % 3]), b = std::max(c[k], c[(k + 1) % 3]);
        blocks[k] = a == b ? -1 : matrix.pattern().find(a, b);
      }
    }
  for (std::size_t t = 0; t < triangle_blocks_.size(); ++t) {
    const auto s = static_cast<float>(scale * triangle_stiffness_[t]);
    if (s == 0) continue;
    for (const model::Index at : triangle_blocks_[t]) {
      if (at < 0) continue;
      float* b = matrix.raw_block(static_cast<std::size_t>(at));
      b[0] -= s;
      b[4] -= s;
      b[8] -= s;
    }
  }
  matrix.finish_assembly();
}

double Loads::energy(const Vectors& x, double scale) const {
  double sum = 0;
  for (std::size_t i = 0; i < force_.size(); ++i) sum -= force_[i].dot(x[i]);
  return scale * sum;
}

}  // namespace garment::simulator
