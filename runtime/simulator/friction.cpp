#include "runtime/simulator/friction.hpp"

#include <algorithm>
#include <cmath>

namespace garment::simulator {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {
constexpr double kAtLimit = 0.99;   // share of the limit from which a spring counts as slipping
constexpr double kFollowLoad = 0.5;        // share of a change of the load that the limit takes up in one step
constexpr double kCancelled = 0.1;         // sums of normal forces below this share of their sizes have no direction
constexpr int kBearingSweeps = 40;                // over the directions that press on a particle
}  // namespace

void BodyFriction::begin_step() {
  for (Touch& t : touch_) {
    t.sum.setZero();
    t.weighted_mu = t.total = 0;
    t.n_pressing = 0;
  }
}

void BodyFriction::add_normal_force(std::size_t i, const Vector3d& force, double mu) {
  Touch& t = touch_[i];
  double size = force.norm();
  t.sum += force;
  t.weighted_mu += mu * size;
  t.total += size;
  if (size > 0 && t.n_pressing < static_cast<int>(t.pressing.size())) t.pressing[t.n_pressing++] = force / size;
}

void BodyFriction::freeze(const std::vector<Vector3d>& x) {
  active_.clear();
  for (std::size_t i = 0; i < touch_.size(); ++i) {
    Touch& t = touch_[i];
    if (t.total <= 0) {
      t.anchored = false;
      continue;
    }
    // Pinched from two sides the forces cancel, their directions do not.
    const double n = t.sum.norm();
    t.normal = n > kCancelled * t.total ? Vector3d(t.sum / n) : t.pressing[0];
    t.bearable = t.weighted_mu;
    t.limit = t.anchored ? t.limit + kFollowLoad * (t.bearable - t.limit) : t.bearable;
    t.stiffness = std::clamp(t.limit / give_, kLeastAnchorStiffness, most_stiffness_);
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

/// What is left of `f` where several places press on a particle: the part that no sum of their normal forces bears
/// (Hildreth's projection on the cone of what leads away from all of them), less friction, which acts in any direction since
/// each place bears along itself.
Vector3d BodyFriction::left_by(const Touch& t, Vector3d f, std::size_t i, const Holds& holds) const {
  std::array<double, 8> borne{};
  for (int sweep = 0; sweep < kBearingSweeps; ++sweep)
    for (int k = 0; k < t.n_pressing; ++k) {
      Vector3d n = holds.filtered(i, t.pressing[k]);
      const double size = n.norm();
      if (size < 1e-6) continue;
      n /= size;
      const double change = std::max(-f.dot(n), -borne[k]);
      borne[k] += change;
      f += change * n;
    }
  const double size = f.norm();
  return size > t.bearable ? Vector3d(f * (1 - t.bearable / size)) : Vector3d::Zero();
}

void BodyFriction::absorb(std::vector<Vector3d>& force, const Holds& holds) const {
  for (std::uint32_t i : active_) {
    const Touch& t = touch_[i];
    if (t.n_pressing > 1) {
      force[i] = left_by(t, force[i], i, holds);
      continue;
    }
    Vector3d normal = holds.filtered(i, t.normal);
    if (normal.norm() < 1e-6) continue;
    normal.normalize();
    double pull = force[i].dot(normal);
    Vector3d tangential = force[i] - pull * normal;
    double size = tangential.norm();
    force[i] = std::max(pull, 0.0) * normal + tangential * (size > t.bearable ? 1 - t.bearable / size : 0.0);
  }
}

double BodyFriction::follow(const std::vector<Vector3d>& x) {
  double heat = 0;
  for (std::uint32_t i : active_) {
    Touch& t = touch_[i];
    Vector3d u = slip(t, x[i]);
    double size = u.norm();
    if (t.stiffness * size <= t.limit) continue;
    t.anchor = x[i] - u * (t.limit / t.stiffness / size);
    heat += t.limit * (size - t.limit / t.stiffness);
  }
  return heat;
}

void BodyFriction::clear() {
  for (Touch& t : touch_) t.anchored = false;
  active_.clear();
}

}  // namespace garment::simulator
