#include "runtime/simulator/implicit_steps.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/base/parallel.hpp"

namespace garment::simulator {
namespace {

using Eigen::Vector3d;
using Vectors = std::vector<Vector3d>;

constexpr int kMostIterations = 30;
constexpr int kMostSolves = 8;        // of a semi-implicit step
constexpr int kNewtonHalvings = 8;
constexpr double kNewtonLinearTolerance = 0.03;
constexpr double kManyFresh = 0.1;    // share of what touches that does so for the first time
constexpr int kEulerSteps = 10;       // after one in which something came to touch: more will, and BDF2 would be tried in vain
constexpr int kNewtonLinearIterations = 300;
constexpr double kDrift = 0.02;       // of the tolerance, that all of the equations together may be off: what slides has little to drive it
constexpr double kNewtonRounding = 1e-11;  // share of the energy that sums of it may be off
constexpr double kGoodEnough = 10;    // times the tolerance, where the iterations come to a stand

double mean_size(const Vectors& f) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : f) sum += p;
  return sum.norm() / static_cast<double>(std::max<std::size_t>(1, f.size()));
}

double rms(const Vectors& f) {
  double sum = 0;
  for (const Vector3d& p : f) sum += p.squaredNorm();
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, f.size())));
}

}  // namespace

double kinetic_energy(const model::Model& model, const Vectors& v) {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) sum += 0.5 * model.mass[i] * v[i].squaredNorm();
  return sum;
}

void ImplicitSteps::set_scheme(const MotionState& s, double h, Scheme scheme) {
  scheme_ = scheme;
  beta_ = scheme == Scheme::euler ? h : 2 * h / 3;
  aim_.resize(s.x.size());
  for (std::size_t i = 0; i < aim_.size(); ++i)
    aim_[i] = scheme == Scheme::euler ? Vector3d(s.x[i] + h * s.v[i])
                                      : Vector3d((4 * s.x[i] - s.x_before[i]) / 3 + 2 * h / 9 * (4 * s.v[i] - s.v_before[i]));
}

double ImplicitSteps::inertia(const Vectors& x) const {
  const model::Model& m = cloth_.model();
  return parallel_sum(x.size(), 4096, 0.0, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += m.mass[i] * (x[i] - aim_[i]).squaredNorm();
    return sum / (2 * beta_ * beta_);
  });
}

const Vectors& ImplicitSteps::velocity(const MotionState& s, const Vectors& x, double h) {
  v_.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    v_[i] = scheme_ == Scheme::euler ? Vector3d((x[i] - s.x[i]) / h)
                                     : Vector3d((3 * x[i] - 4 * s.x[i] + s.x_before[i]) / (2 * h));
  return v_;
}

/// x_ where Newton's method begins: as far as nothing meets on the way there.
void ImplicitSteps::guess(const MotionState& s, double h) {
  const model::Model& m = cloth_.model();
  x_ = s.x;
  dx_.resize(s.x.size());
  for (std::size_t i = 0; i < dx_.size(); ++i)
    dx_[i] = is_single() && !flies_ ? Vector3d::Zero() : Vector3d(aim_[i] - s.x[i] + beta_ * beta_ * m.gravity);
  cloth_.held_motion(s.x, h, dx_);
  cloth_.keep_apart(s.x, dx_);
  for (std::size_t i = 0; i < dx_.size(); ++i) x_[i] += dx_[i];
}

/// Goes along dx_ as far as the energy does not rise, and returns which share; 0 where it does however short the way.
double ImplicitSteps::search(double before, double h) {
  trial_.resize(x_.size());
  double share = 1;
  for (int k = 0; k <= kNewtonHalvings; ++k, share *= 0.5) {
    for (std::size_t i = 0; i < x_.size(); ++i) trial_[i] = x_[i] + share * dx_[i];
    const double after = cloth_.energies(trial_, h).sum() + inertia(trial_);
    if (after > before + kNewtonRounding * std::abs(before) + 1e-16 || !std::isfinite(after)) continue;
    x_.swap(trial_);
    return share;
  }
  return 0;
}

/// Forces and what is left of the equations at x_.
void ImplicitSteps::look(const MotionState& s, double h, bool with_matrix, TimeStep& report) {
  const model::Model& m = cloth_.model();
  energies_ = cloth_.assemble(x_, velocity(s, x_, h), h, s.time + h, with_matrix);
  residual_ = cloth_.force();
  for (std::size_t i = 0; i < x_.size(); ++i) residual_[i] -= m.mass[i] / (beta_ * beta_) * (x_[i] - aim_[i]);
  report.unborne = residual_;
  cloth_.holds().filter(residual_);
  report.residual = rms(residual_) / std::max(cloth_.rms_weight(), 1e-300);
}

bool ImplicitSteps::solve(const MotionState& s, double h, TimeStep& report) {
  const model::Model& m = cloth_.model();
  double last = 1e300;
  const int most = is_single() ? kMostSolves : kMostIterations;
  for (report.iterations = 0; report.iterations < most; ++report.iterations) {
    look(s, h, true, report);
    const bool drifts = !is_single() && mean_size(residual_) > kDrift * tolerance_ * cloth_.rms_weight();
    if (report.residual <= tolerance_ && !drifts) return true;
    if (!std::isfinite(report.residual)) return false;
    last = report.residual;
    for (std::size_t i = 0; i < x_.size(); ++i) cloth_.matrix().add_diagonal(i, m.mass[i] / (beta_ * beta_));
    cloth_.solve(residual_, kNewtonLinearTolerance, kNewtonLinearIterations, x_, dx_);
    const bool cut = cloth_.keep_apart(x_, dx_) > 0;
    const double share = search(energies_.sum() + inertia(x_), h);
    if (share == 0 || (is_single() && !cut && share == 1)) {
      ++report.iterations;
      break;
    }
  }
  if (!is_single()) return last <= kGoodEnough * tolerance_;
  look(s, h, false, report);
  return std::isfinite(report.residual);
}

void ImplicitSteps::finish(MotionState& s, double h, TimeStep& report) {
  velocity(s, x_, h);
  const Vectors& loads = cloth_.loads().force();
  for (std::size_t i = 0; i < loads.size(); ++i) report.work += loads[i].dot(x_[i] - s.x[i]);
  for (std::size_t i = 0; i < x_.size(); ++i)  // what holds add is what the others leave
    report.work -= (report.unborne[i] - cloth_.holds().filtered(i, report.unborne[i])).dot(x_[i] - s.x[i]);
  report.stored = energies_.stored;
  report.damping = 2 * energies_.dissipation;
  const MovingCloth::Accepted accepted = cloth_.accept(x_);
  report.friction = accepted.friction_heat;
  report.work += accepted.work_of_bodies;
  s.x_before.swap(s.x);
  s.v_before.swap(s.v);
  s.x.swap(x_);
  s.v = v_;
  s.step_before = h;
  s.time += h;
  report.done = true;
}

TimeStep ImplicitSteps::step(MotionState& state, double h) {
  const bool goes_on = euler_steps_ == 0 && !state.x_before.empty() && std::abs(state.step_before - h) < 1e-9 * h;
  for (Scheme scheme : {Scheme::bdf2, Scheme::euler}) {
    if (scheme == Scheme::bdf2 && (!goes_on || is_single())) continue;
    TimeStep report;
    cloth_.go_to(state.time + h);
    cloth_.begin_step(state.x);
    set_scheme(state, h, scheme);
    guess(state, h);
    bool solved = solve(state, h, report);
    const double fresh = solved ? cloth_.new_contacts(x_) : 0;
    const bool touches = fresh > 0;
    if (touches) euler_steps_ = kEulerSteps;
    flies_ = report.iterations == 0;
    if (fresh > kManyFresh && scheme == Scheme::euler && !is_single()) {  // what lands rubs from its first step on
      cloth_.rub(x_, state.x);
      solved = solve(state, h, report);
    }
    if (solved && (scheme == Scheme::euler || !touches)) {
      euler_steps_ = std::max(0, euler_steps_ - 1);
      finish(state, h, report);
      return report;
    }
    cloth_.put_back();
    if (!solved && scheme == Scheme::euler) return report;
  }
  return {};
}

}  // namespace garment::simulator
