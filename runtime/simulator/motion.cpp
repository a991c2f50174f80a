#include "runtime/simulator/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/base/number.hpp"
#include "runtime/model/archive_points.hpp"
#include "runtime/simulator/certificate.hpp"
#include "runtime/simulator/cloth_contact.hpp"
#include "runtime/simulator/constraint_steps.hpp"
#include "runtime/simulator/culprit.hpp"
#include "runtime/simulator/explicit_steps.hpp"
#include "runtime/simulator/implicit_steps.hpp"
#include "runtime/simulator/moved_bodies.hpp"
#include "runtime/simulator/quasi_static_steps.hpp"
#include "runtime/simulator/reactions.hpp"
#include "runtime/simulator/solver_state.hpp"

namespace garment::simulator {
namespace {

using Eigen::Vector3d;
using Vectors = std::vector<Vector3d>;

constexpr double kUsualStep = 1.0 / 240;   // s, of implicit steps
constexpr double kSemiStep = 1.0 / 60;     // s, of semi-implicit ones
constexpr double kShareOfBound = 0.9;      // of the stability bound, where no step is stated
constexpr int kMostHalvings = 6;
constexpr int kGrowAfter = 8;              // steps that go well, before one that was halved is doubled
constexpr double kBodyStride = 0.5;        // of the distance at which bodies begin to push
constexpr double kOpen = 0.5;              // strain of seams that are still open
constexpr double kSameShare = 1e-3;        // of a step
constexpr int kLookAgain = 2000;           // explicit steps between two looks at their bound

/// One motion under way.
class Mover {
 public:
  Mover(const model::Model& model, const std::vector<body::Body>& bodies, model::State& state, const MotionSettings& settings,
        DrapeReport& report)
      : model_(model),
        settings_(settings),
        report_(report),
        cloth_(model, bodies, settings.self_collision, state.time,
               settings.method == MotionMethod::dynamic_constraints ? MovingCloth::Acts::without_constraints : MovingCloth::Acts::all),
        implicit_(cloth_, settings.tolerance,
                  settings.method == MotionMethod::semi_implicit ? ImplicitSteps::Effort::one_solve : ImplicitSteps::Effort::converged),
        explicit_(cloth_),
        constraints_(cloth_, model),
        begun_(state.time) {
    s_.x = state.position;
    s_.v = state.velocity;
    s_.v.resize(s_.x.size(), Vector3d::Zero());
    s_.time = state.time;
    cloth_.inner_friction().take_anchors(state.slip);
  }

  void go() {
    if (!settings_.checkpoints.resume.empty()) {
      if (!settings_.checkpoints.restore(*this)) return void(report_ = not_resumed());
    } else {
      start_report();
      if (!find_step()) return;
      tell_frame();
    }
    const double end = begun_ + settings_.duration;
    while (s_.time < end - kSameTime) {
      const bool stop_asked = settings_.interrupted && settings_.interrupted();
      settings_.checkpoints.look(*this, stop_asked);
      if (stop_asked) {
        report_.status = DrapeStatus::interrupted;
        return;
      }
      if (report_.motion.steps >= settings_.max_steps) return out_of_steps();
      const double same = kSameShare * step_;  // stops so near are one: a step between them is all rounding
      const double stop = frame_ > end - same ? end : frame_;
      if (!step(stop)) return;
      if (s_.time >= frame_ - same) tell_frame();
    }
    report_.status = DrapeStatus::ran;
  }

  /// In a checkpoint between two steps.
  void keep(Archive& a) {
    const std::size_t n = model_.n_particles();
    keep_positions(a, s_.x, n, kSelfOffset);
    model::keep(a, s_.v, n);
    model::keep(a, s_.x_before, n, true);
    model::keep(a, s_.v_before, n, s_.x_before.empty());
    for (double* value : {&s_.step_before, &s_.time, &begun_, &step_}) a.keep(*value);
    a.keep_any(frame_);
    for (int* count : {&halvings_, &well_}) {
      a.keep(*count);
      a.demand(*count >= 0 && *count <= kMostCounted);
    }
    a.demand(step_ > 0 && halvings_ <= kMostHalvings && s_.time >= begun_ && (s_.x_before.empty() || s_.step_before > 0));
    a.demand(s_.time <= begun_ + settings_.duration + kSameTime && frame_ >= s_.time - kSameShare * step_);
    simulator::keep(a, report_, model_.holders.size());
    a.keep(redundant_);
    implicit_.keep(a);
    if (a.ok()) cloth_.keep(a, s_.time);
    if (a.reading() && a.ok()) tell_redundant();
  }

  void write(model::State& state) {
    state.position = s_.x;
    state.velocity = s_.v;
    state.time = s_.time;
    if (!cloth_.inner_friction().idle()) state.slip = cloth_.inner_friction().anchors();
  }

 private:
  bool is_explicit() const {
    return settings_.method == MotionMethod::explicit_steps || settings_.method == MotionMethod::dynamic_constraints;
  }

  TimeStep one_step(double h) {
    if (settings_.method == MotionMethod::dynamic_constraints) return constraints_.step(s_, h);
    return is_explicit() ? explicit_.step(s_, h) : implicit_.step(s_, h);
  }

  void start_report() {
    cloth_.begin_step(s_.x);
    const Energies e = cloth_.assemble(s_.x, s_.v, kUsualStep, s_.time, false);
    EnergyBalance& b = report_.motion.balance;
    b.kinetic = b.kinetic_start = kinetic_energy(cloth_.model(), s_.v);
    b.stored = b.stored_start = report_.energy = e.stored;
    report_.reactions = reactions(model_, cloth_.holds(), cloth_.force());
    report_.moments = moments(model_, cloth_.holds(), cloth_.force(), s_.x);
  }

  /// False, with a finding, where the stated step is too long.
  bool find_step() {
    step_ = settings_.step > 0 ? settings_.step : settings_.method == MotionMethod::semi_implicit ? kSemiStep : kUsualStep;
    if (!is_explicit()) return true;
    const double bound = explicit_.stable_step(s_.x);
    report_.motion.stable_step = bound;
    if (settings_.step == 0) step_ = kShareOfBound * bound;
    if (step_ <= bound) return true;
    report_.status = DrapeStatus::diverged;
    report_.findings.push_back(
        {"G0806", Severity::error,
         fmt::format("explicit steps of {} s; this cloth needs {} s or less at {} s", format_number(step_, 3), format_number(bound, 3),
                     format_number(s_.time - begun_, 3)),
         {},
         fmt::format("write `solver {} step {} ms`, leave the step out, or take `solver implicit`; a fabric of less `damping` "
                     "allows longer steps",
                     settings_.method == MotionMethod::dynamic_constraints ? "dynamic_constraints" : "explicit",
                     format_number(0.9e3 * bound, 3))});
    return false;
  }

  /// One step towards `stop`, halved where it fails.
  bool step(double stop) {
    for (;;) {
      const double h = next_step(stop);
      const TimeStep t = one_step(h);
      if (t.done) {
        count(t, h);
        return !is_explicit() || report_.motion.steps % kLookAgain != 0 || find_step();
      }
      report_.residual = number_or_infinite(t.residual);
      if (++halvings_ > kMostHalvings) return stuck(t.unborne.empty() ? s_.v : t.unborne);
      well_ = 0;
    }
  }

  double next_step(double stop) const {
    double most = step_;
    const double speed = cloth_.body_speed(s_.x, s_.time, s_.time + most);
    if (speed > 0) most = std::min(most, kBodyStride * cloth_.push_distance() / speed);
    for (const model::Motion& motion : model_.motions)  // speed changes at poses
      for (const model::Pose& pose : motion.poses)
        if (pose.time > s_.time + kSameShare * step_) most = std::min(most, pose.time - s_.time);
    const double left = stop - s_.time;
    most = std::ldexp(std::min(most, left), -halvings_);
    return left / std::max(1.0, std::ceil(left / most - 1e-6));
  }

  void count(const TimeStep& t, double h) {
    MotionReport& m = report_.motion;
    EnergyBalance& b = m.balance;
    ++m.steps;
    m.iterations += t.iterations;
    m.seconds = s_.time - begun_;
    m.least_step = m.steps == 1 ? h : std::min(m.least_step, h);
    m.largest_step = std::max(m.largest_step, h);
    b.kinetic = kinetic_energy(cloth_.model(), s_.v);
    b.stored = t.stored;
    b.work += t.work;
    b.damping += t.damping;
    b.friction += t.friction;
    b.numerical = b.work - b.damping - b.friction - b.change();
    report_.steps = m.steps;
    report_.residual = t.residual;
    report_.energy = t.stored;
    report_.reactions = reactions(model_, cloth_.holds(), t.unborne);
    report_.moments = moments(model_, cloth_.holds(), t.unborne, s_.x);
    if (m.steps == 1 && settings_.method == MotionMethod::dynamic_constraints) {
      redundant_ = constraints_.redundant();
      tell_redundant();
    }
    if (halvings_ > 0 && ++well_ >= kGrowAfter) --halvings_, well_ = 0;
    if (settings_.progress)
      settings_.progress({m.steps, s_.x.size(), t.residual, settings_.tolerance, 0, "moving", m.seconds, settings_.duration});
  }

  void tell_redundant() {
    if (redundant_ == 0) return;
    report_.findings.push_back({"G0809", Severity::note,
                                fmt::format("{} of the rows of the constraints say what others say already", redundant_),
                                {},
                                "nothing is to be done: they share the force; a particle that is both pinned and constrained has such rows"});
  }

  /// `unsolved`: what is left of the equations, or what else tells panels that are at rest from others.
  bool stuck(const Vectors& unsolved) {
    const Culprit panel = panel_with_most(model_, unsolved);
    const bool finite = std::isfinite(report_.residual);
    report_.status = DrapeStatus::diverged;
    report_.findings.push_back(
        {"G0807", Severity::error,
         fmt::format("at {} s no step of {} s or less could be made, most of what is left is in {}; the state before it was kept",
                     format_number(s_.time - begun_, 4), format_number(std::ldexp(step_, -kMostHalvings), 3), panel.name),
         {{panel.origin, "most of what is left acts here"}},
         finite ? "let the garment come to rest first (`drape until rest`), or move what moves it more slowly"
                : "check the fabric for extreme stiffness or density, and the resolution"});
    return false;
  }

  void out_of_steps() {
    report_.status = DrapeStatus::not_settled;
    const Culprit panel = panel_with_most(model_, s_.v);
    report_.findings.push_back({"G0802", Severity::error,
                                fmt::format("after {} steps the garment has moved for {} of {} s; {} moves most", report_.motion.steps,
                                            format_number(s_.time - begun_, 4), format_number(settings_.duration, 4), panel.name),
                                {{panel.origin, "it moves most"}},
                                "let the garment move for a shorter time, or take longer steps (`solver implicit step 10 ms`)"});
  }

  double next_frame() const {
    return settings_.next_frame ? settings_.next_frame(s_.time) : std::numeric_limits<double>::infinity();
  }
  void tell_frame() {
    if (settings_.frame) {
      model::State now;
      write(now);
      settings_.frame(now, report_);
    }
    frame_ = next_frame();
  }

  const model::Model& model_;
  const MotionSettings& settings_;
  DrapeReport& report_;
  MovingCloth cloth_;
  ImplicitSteps implicit_;
  ExplicitSteps explicit_;
  ConstraintSteps constraints_;
  MotionState s_;
  double begun_, step_ = kUsualStep;
  double frame_ = std::numeric_limits<double>::infinity();  // s, the next
  int halvings_ = 0, well_ = 0;
  std::size_t redundant_ = 0;  // rows of the first step
};

bool is_open(const model::Model& model, const model::State& state, DrapeReport& report) {
  const double strain = largest_thread_strain(model, state.position);
  if (strain < kOpen) return false;
  report.status = DrapeStatus::not_settled;
  report.findings.push_back({"G0805", Severity::error,
                             fmt::format("the garment cannot begin to move: its cloth is stretched by {}%, as seams that are still "
                                         "open are",
                                         format_number(100 * strain, 2)),
                             {},
                             "write `drape until rest` above `drape for`: it closes the seams"});
  return true;
}

void look_at(const model::Model& model, const model::State& state, const std::vector<body::Body>& bodies, DrapeReport& report) {
  const Certificate certificate = certify(model, state, bodies);
  report.self_intersections = certificate.self_intersections;
  report.body_intersections = certificate.body_intersections;
  report.inside_body = certificate.inside_body;
  if (certificate.clean() || report.status != DrapeStatus::ran) return;
  report.findings.push_back({"G0808", Severity::warning,
                             fmt::format("where the motion ends cloth cuts cloth or a body in {} places, and {} particles lie inside one",
                                         report.self_intersections + report.body_intersections, report.inside_body),
                             {},
                             "`drape until rest` after it takes them apart; a finer resolution keeps cloth off sharp bodies"});
}

}  // namespace

DrapeReport move_on(const model::Model& model, const std::vector<body::Body>& bodies, model::State& state,
                    const MotionSettings& settings) {
  DrapeReport report;
  if (state.position.empty()) state.position = model.start;
  if (is_open(model, state, report)) return report;
  if (settings.method == MotionMethod::quasi_static) {
    report = follow_paths(model, bodies, state, settings);
    if (report.status == DrapeStatus::not_resumed) return report;
    look_at(model, state, bodies_at(bodies, model, state.time), report);
    return report;
  }
  Mover mover(model, bodies, state, settings, report);
  mover.go();
  if (report.status == DrapeStatus::not_resumed) return report;
  mover.write(state);
  look_at(model, state, bodies_at(bodies, model, state.time), report);
  return report;
}

}  // namespace garment::simulator
