#include "runtime/simulator/constraint_steps.hpp"

namespace garment::simulator {
namespace {

using Eigen::Vector3d;

constexpr double kConstraintTime = 5;  // tau over h

}  // namespace

TimeStep ConstraintSteps::step(MotionState& s, double h) {
  TimeStep report;
  cloth_.go_to(s.time + h);
  find_active_forces(s, h, report);
  find_reactive_forces(s, h);
  find_velocities(s, h);
  find_collisions(s, h);
  resolve_collisions(h, report);
  report.done = move(s, h, report);
  return report;
}

/// Elastic and damping forces, weight, loads.
void ConstraintSteps::find_active_forces(const MotionState& s, double h, TimeStep& report) {
  const bool goes_on = !s.x_before.empty();
  cloth_.begin_step(s.x, goes_on ? &s.x_before : nullptr);
  const Energies e = cloth_.assemble(s.x, s.v, goes_on ? s.step_before : h, s.time, false);
  report.damping = 2 * e.dissipation * (goes_on ? h / s.step_before : 1);
}

void ConstraintSteps::find_reactive_forces(const MotionState& s, double h) {
  reactive_ = reactive_forces(cloth_.model(), constraint_rows(cloth_.model(), cloth_, s.x, s.v, h), cloth_.force(), s.v,
                              kConstraintTime * h);
}

void ConstraintSteps::find_velocities(const MotionState& s, double h) {
  v_.resize(s.x.size());
  for (std::size_t i = 0; i < v_.size(); ++i)
    v_[i] = s.v[i] + h / start_.mass[i] * (cloth_.force()[i] + reactive_.force[i]);
}

void ConstraintSteps::find_collisions(const MotionState& s, double h) { touching_ = contacts_of(cloth_, s.x, h); }

void ConstraintSteps::resolve_collisions(double h, TimeStep& report) {
  report.friction = part(cloth_.model(), cloth_.holds(), touching_, h, v_);
}

bool ConstraintSteps::move(MotionState& s, double h, TimeStep& report) {
  dx_.resize(v_.size());
  for (std::size_t i = 0; i < v_.size(); ++i) {
    dx_[i] = h * v_[i];
    if (!dx_[i].allFinite()) return false;
  }
  if (cloth_.keep_apart(s.x, dx_) > 0) {
    cloth_.put_back();
    return false;
  }
  report.unborne.assign(v_.size(), Vector3d::Zero());
  for (std::size_t i = 0; i < v_.size(); ++i) {
    report.unborne[i] = -reactive_.of_holds[i];
    report.work += reactive_.of_holds[i].dot(dx_[i]);
  }
  const auto& loads = cloth_.loads().force();
  for (std::size_t i = 0; i < loads.size(); ++i) report.work += loads[i].dot(dx_[i]);
  s.x_before = s.x;
  s.v_before.swap(s.v);
  for (std::size_t i = 0; i < s.x.size(); ++i) s.x[i] += dx_[i];
  s.v = v_;
  report.stored = cloth_.energies(s.x, h).stored;
  cloth_.accept(s.x);
  s.step_before = h;
  s.time += h;
  return true;
}

}  // namespace garment::simulator
