#include "runtime/simulator/explicit_steps.hpp"

#include <algorithm>
#include <cmath>

namespace garment::simulator {
namespace {

using Eigen::Vector3d;
using Vectors = std::vector<Vector3d>;

constexpr int kPowerIterations = 100;
constexpr double kSpare = 1.05;  // in omega^2

}  // namespace

double stability_bound(double omega, double tau) {
  if (!(omega > 0)) return 1e300;
  const double z = omega * tau / 2;
  return 2 / omega / (std::sqrt(1 + z * z) + z);  // the same, without the difference of large numbers
}

double ExplicitSteps::stable_step(const Vectors& x) {
  const model::Model& m = cloth_.model();
  v_.assign(x.size(), Vector3d::Zero());
  cloth_.begin_step(x);
  cloth_.assemble(x, v_, 1e9, 0, true);
  double contact = 0;
  for (double mass : m.mass) contact = std::max(contact, cloth_.largest_contact_stiffness() / mass);
  p_.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)  // no pattern of the grid
    for (int k = 0; k < 3; ++k) p_[i][k] = static_cast<float>((7 * i + 3 * static_cast<std::size_t>(k)) % 11) - 5;
  double elastic = 0;
  for (int k = 0; k < kPowerIterations; ++k) {
    cloth_.matrix().multiply(p_, q_);
    double size = 0, product = 0, own = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      q_[i] = cloth_.holds().filtered(i, q_[i]);
      product += static_cast<double>(p_[i].dot(q_[i]));
      own += m.mass[i] * static_cast<double>(p_[i].squaredNorm());
      q_[i] /= static_cast<float>(m.mass[i]);
      size = std::max(size, static_cast<double>(q_[i].norm()));
    }
    if (!(size > 0) || !(own > 0)) break;
    elastic = product / own;
    for (std::size_t i = 0; i < x.size(); ++i) p_[i] = q_[i] / static_cast<float>(size);
  }
  return stability_bound(std::sqrt(kSpare * elastic + contact), cloth_.damping().largest_time());
}

TimeStep ExplicitSteps::step(MotionState& s, double h) {
  TimeStep report;
  const model::Model& m = cloth_.model();
  cloth_.go_to(s.time + h);
  const bool goes_on = !s.x_before.empty();
  cloth_.begin_step(s.x, goes_on ? &s.x_before : nullptr);  // dampers by the change of strain in the step before
  const Energies e = cloth_.assemble(s.x, s.v, goes_on ? s.step_before : h, s.time, false);
  v_.resize(s.x.size());
  dx_.resize(s.x.size());
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    v_[i] = s.v[i] + h / m.mass[i] * cloth_.holds().filtered(i, cloth_.force()[i]);
    dx_[i] = h * v_[i];
  }
  cloth_.held_motion(s.x, h, dx_);
  if (cloth_.keep_apart(s.x, dx_) > 0) {
    cloth_.put_back();
    return report;
  }
  report.unborne = cloth_.force();
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    v_[i] = dx_[i] / h;
    report.unborne[i] -= m.mass[i] / h * (v_[i] - s.v[i]);
    report.work -= (report.unborne[i] - cloth_.holds().filtered(i, report.unborne[i])).dot(dx_[i]);
    if (!dx_[i].allFinite()) return report;
  }
  const Vectors& loads = cloth_.loads().force();
  for (std::size_t i = 0; i < loads.size(); ++i) report.work += loads[i].dot(dx_[i]);
  s.x_before = s.x;
  s.v_before.swap(s.v);
  for (std::size_t i = 0; i < s.x.size(); ++i) s.x[i] += dx_[i];
  s.v = v_;
  report.damping = 2 * e.dissipation * (goes_on ? h / s.step_before : 1);
  report.stored = cloth_.energies(s.x, h).stored;
  const MovingCloth::Accepted accepted = cloth_.accept(s.x);
  report.friction = accepted.friction_heat;
  report.work += accepted.work_of_bodies;
  s.step_before = h;
  s.time += h;
  report.done = true;
  return report;
}

}  // namespace garment::simulator
