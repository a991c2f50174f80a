#include "runtime/simulator/friction.hpp"

#include <algorithm>
#include <cmath>

namespace garment::simulator {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {
constexpr double kAtLimit = 0.99;   // share of the limit from which a spring counts as slipping
constexpr double kLeastStiffness = 1e-3; // N/m
constexpr double kSlipShare = 0.01; // of the stiffness that is left along the slip, so that the matrix stays definite
}  // namespace

void BodyFriction::begin_step() {
  for (Touch& t : touch_) {
    t.sum.setZero();
    t.weighted_mu = t.total = 0;
  }
}

void BodyFriction::add_normal_force(std::size_t i, const Vector3d& force, double mu) {
  Touch& t = touch_[i];
  double size = force.norm();
  t.sum += force;
  t.weighted_mu += mu * size;
  t.total += size;
}

void BodyFriction::freeze(const std::vector<Vector3d>& x) {
  active_.clear();
  for (std::size_t i = 0; i < touch_.size(); ++i) {
    Touch& t = touch_[i];
    double n = t.sum.norm();
    if (n <= 0 || t.total <= 0) {
      t.anchored = false;
      continue;
    }
    t.normal = t.sum / n;
    t.limit = n * t.weighted_mu / t.total;
    t.stiffness = std::clamp(t.limit / give_, kLeastStiffness, most_stiffness_);
    if (!t.anchored) t.anchor = x[i];
    t.anchored = true;
    active_.push_back(static_cast<std::uint32_t>(i));
  }
}

double BodyFriction::energy(const std::vector<Vector3d>& x) const {
  double sum = 0;
  for (std::uint32_t i : active_) {
    const Touch& t = touch_[i];
    double u = slip(t, x[i]).norm(), sticking = t.limit / t.stiffness;
    sum += u <= sticking ? t.stiffness / 2 * u * u : t.limit * (u - sticking / 2);
  }
  return sum;
}

void BodyFriction::add_force(const std::vector<Vector3d>& x, std::vector<Vector3d>& force, BlockMatrix* matrix) const {
  for (std::uint32_t i : active_) {
    const Touch& t = touch_[i];
    Vector3d u = slip(t, x[i]);
    double size = u.norm();
    double stiffness = t.stiffness * size <= t.limit ? t.stiffness : t.limit / size;
    // A spring at its limit that is still pulled gives no more resistance along the slip: the solver must not see any,
    // or sliding takes hundreds of steps.
    bool slips = t.stiffness * size >= kAtLimit * t.limit && size > 0 && force[i].dot(u) > t.limit * size;
    force[i] -= stiffness * u;
    if (!matrix) continue;
    Matrix3d plane = Matrix3d::Identity() - t.normal * t.normal.transpose();
    if (slips) plane -= (1 - kSlipShare) * (u * u.transpose()) / (size * size);
    matrix->add_diagonal(i, Matrix3d(stiffness * plane));
  }
}

void BodyFriction::absorb(std::vector<Vector3d>& force, const Holds& holds) const {
  for (std::uint32_t i : active_) {
    const Touch& t = touch_[i];
    Vector3d normal = holds.filtered(i, t.normal);
    if (normal.norm() < 1e-6) continue;
    normal.normalize();
    double pull = force[i].dot(normal);
    Vector3d tangential = force[i] - pull * normal;
    double size = tangential.norm();
    force[i] = std::max(pull, 0.0) * normal + tangential * (size > t.limit ? 1 - t.limit / size : 0.0);
  }
}

void BodyFriction::follow(const std::vector<Vector3d>& x) {
  for (std::uint32_t i : active_) {
    Touch& t = touch_[i];
    Vector3d u = slip(t, x[i]);
    double size = u.norm();
    if (t.stiffness * size <= t.limit) continue;
    t.anchor = x[i] - u * (t.limit / t.stiffness / size);
  }
}

void BodyFriction::clear() {
  for (Touch& t : touch_) t.anchored = false;
  active_.clear();
}

}  // namespace garment::simulator
