#include "runtime/simulator/quasi_static_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/base/number.hpp"
#include "runtime/model/motion.hpp"
#include "runtime/simulator/culprit.hpp"
#include "runtime/simulator/moved_bodies.hpp"
#include "runtime/simulator/relaxation.hpp"
#include "runtime/simulator/rest.hpp"
#include "runtime/simulator/solver_state.hpp"

namespace garment::simulator {
namespace {

using Eigen::Vector3d;
using Vectors = std::vector<Vector3d>;

constexpr int kMostSteps = 600;          // of the relaxation, between two moments
constexpr double kShareOfSpacing = 0.25;
constexpr double kSnap = 2e-5;            // m, far less than cloth keeps from cloth
constexpr double kNothing = 1e-4;        // of the residual at rest: no step is needed to judge it

double mean_spring(const model::Model& model) {
  double sum = 0;
  for (double l : model.spring_rest) sum += l;
  return model.spring_rest.empty() ? 0.01 : sum / static_cast<double>(model.spring_rest.size());
}

std::vector<model::Placement> placements_at(const model::Model& model, std::size_t n_bodies, double time) {
  std::vector<model::Placement> placements(n_bodies);
  for (const model::Motion& m : model.motions)
    if (m.body >= 0 && static_cast<std::size_t>(m.body) < n_bodies)
      placements[static_cast<std::size_t>(m.body)] = model::placement_at(m, time);
  return placements;
}

/// One motion under way.
class Follower {
 public:
  Follower(const model::Model& model, const std::vector<body::Body>& bodies, model::State& state, const MotionSettings& settings,
           DrapeReport& report)
      : start_(model),
        bodies_(bodies),
        state_(state),
        settings_(settings),
        report_(report),
        moved_(model::at_time(model, state.time)),
        relaxation_(moved_, bodies, relaxation_settings(settings)),
        begun_(state.time) {}

  double seconds() const { return state_.time - begun_; }

  void go() {
    if (settings_.checkpoints.resume.empty()) {
      relaxation_.inner_friction().take_anchors(state_.slip);
      place(state_.time);
      begin_to_settle();
    } else if (!settings_.checkpoints.restore(*this)) {
      report_ = not_resumed();
      return;
    }
    const double end = begun_ + settings_.duration;
    while (settle()) {
      if (state_.time >= frame_ - 1e-12) tell_frame();
      if (!(state_.time < end - 1e-12)) {
        report_.status = DrapeStatus::ran;
        return;
      }
      const double to = std::min({end, frame_, state_.time + stride(end)});
      place(to);
      state_.time = to;
      begin_to_settle();
    }
  }

  /// In a checkpoint between two steps of the relaxation.
  void keep(Archive& a) {
    keep_positions(a, state_.position, start_.n_particles(), relaxation_.mesh().largest_contact_distance);
    for (double* value : {&state_.time, &begun_}) a.keep(*value);
    a.keep_any(frame_);
    a.keep(steps_);
    a.demand(steps_ >= 0 && steps_ <= kMostSteps && state_.time >= begun_ && state_.time <= begun_ + settings_.duration);
    simulator::keep(a, report_, start_.holders.size());
    if (a.reading() && a.ok()) place(state_.time);
    if (a.ok()) relaxation_.keep(a);
  }

 private:
  static RelaxationSettings relaxation_settings(const MotionSettings& settings) {
    RelaxationSettings out;
    out.self_collision = settings.self_collision;
    out.hysteresis = true;
    return out;
  }

  void place(double time) {
    model::move_holds(start_, time, moved_);
    relaxation_.follow_holds();
    if (!start_.motions.empty()) relaxation_.place_bodies(placements_at(start_, bodies_.size(), time));
  }

  /// Time until something has gone by a part of the spacing, s.
  double stride(double end) const {
    double most = end - state_.time;
    for (const model::Motion& motion : start_.motions)  // speed changes at poses
      for (const model::Pose& pose : motion.poses)
        if (pose.time > state_.time + kSameTime) most = std::min(most, pose.time - state_.time);
    const double look = std::min(most, 1e-3);
    double speed = 0;
    model::Model later = model::at_time(start_, state_.time + look);
    for (std::size_t h = 0; h < later.hold_point.size(); ++h)
      speed = std::max(speed, (later.hold_point[h] - moved_.hold_point[h]).norm() / look);
    const auto now = placements_at(start_, bodies_.size(), state_.time), then = placements_at(start_, bodies_.size(), state_.time + look);
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      if (!start_.motions.empty())
        for (const Vector3d& v : bodies_[b].mesh.vertices) speed = std::max(speed, (then[b].apply(v) - now[b].apply(v)).norm() / look);
    return speed > 0 ? std::min(most, kShareOfSpacing * mean_spring(start_) / speed) : most;
  }

  void begin_to_settle() {
    relaxation_.set_time_step(kRestTimeStep);
    relaxation_.forget_motion();
    if (!relaxation_.inner_friction().idle()) snap();
    steps_ = 0;
  }

  bool settle() {
    const bool slides = !relaxation_.inner_friction().idle();
    const double target = target_residual(Settle::equilibrium), most = slides ? kSlidingStep : kRestStep;
    Vectors before;
    for (; steps_ < kMostSteps && report_.steps < settings_.max_steps; ++steps_) {
      const bool stop_asked = settings_.interrupted && settings_.interrupted();
      settings_.checkpoints.look(*this, stop_asked);
      if (stop_asked) {
        report_.status = DrapeStatus::interrupted;
        return false;
      }
      before = state_.position;
      const StepReport step = relaxation_.step(state_.position);
      ++report_.steps;
      if (!std::all_of(state_.position.begin(), state_.position.end(), [](const Vector3d& p) { return p.allFinite(); })) {
        report_.findings.push_back(infinite_positions(start_, state_.position));
        state_.position = before;
        report_.status = DrapeStatus::diverged;
        return false;
      }
      report_.residual = step.residual;
      report_.newton_step = step.newton_step;
      if (settings_.progress)
        settings_.progress({report_.steps, state_.position.size(), step.residual, target,
                            step.largest_motion, "following", state_.time - begun_, settings_.duration});
      if (slides && step.accepted) relaxation_.set_time_step(kRestTimeStep);  // sliders, not folds, cut it
      const bool judged = step.residual <= kNothing * target || (step.time_step >= kRestTimeStep && step.newton_step < most);
      if (steps_ > 0 && step.residual <= target && judged && held_in_place()) return slip();
    }
    report_.status = DrapeStatus::not_settled;
    Vectors force;
    relaxation_.residual(state_.position, force);
    const Culprit panel = panel_with_most(start_, force);
    report_.findings.push_back({"G0802", Severity::error,
                                fmt::format("at {} s the residual is {} of the weight after {} steps, {} is rest; most of it is in {}",
                                            format_number(state_.time, 4), format_number(report_.residual, 3), steps_,
                                            format_number(target, 3), panel.name),
                                {{panel.origin, "most of the net force acts here"}},
                                "move it less far, or let the cloth move in earnest: leave `solver quasi_static` out"});
    return false;
  }

  /// Puts what is all but in its hold right there: the energy rises for it, which a step of so little would not be let.
  void snap() {
    for (std::size_t h = 0; h < moved_.hold_particle.size(); ++h) {
      Vector3d& x = state_.position[static_cast<std::size_t>(moved_.hold_particle[h])];
      if (moved_.hold_kind[h] == model::HoldKind::point && (moved_.hold_point[h] - x).norm() < kSnap) x = moved_.hold_point[h];
    }
  }

  /// What slipped on the way to rest stays there.
  bool slip() {
    relaxation_.inner_friction().slip(state_.position);
    if (!relaxation_.inner_friction().idle()) state_.slip = relaxation_.inner_friction().anchors();
    return true;
  }

  bool held_in_place() const {
    for (std::size_t h = 0; h < moved_.hold_particle.size(); ++h) {
      const Vector3d off = moved_.hold_point[h] - state_.position[moved_.hold_particle[h]];
      const Vector3d n = moved_.hold_normal[h];
      const bool point = moved_.hold_kind[h] == model::HoldKind::point;
      if ((point ? off.norm() : std::abs(off.dot(n.normalized()))) > 1e-6) return false;
    }
    return true;
  }

  double next_frame() const {
    return settings_.next_frame ? settings_.next_frame(state_.time) : std::numeric_limits<double>::infinity();
  }

  void tell_frame() {
    Vectors force;
    report_.residual = relaxation_.residual(state_.position, force);
    report_.reactions = relaxation_.reactions();
    report_.moments = relaxation_.moments();
    report_.energy = relaxation_.energy(state_.position);
    report_.motion.seconds = state_.time - begun_;
    if (settings_.frame) settings_.frame(state_, report_);
    frame_ = next_frame();
  }

  const model::Model& start_;
  const std::vector<body::Body>& bodies_;
  model::State& state_;
  const MotionSettings& settings_;
  DrapeReport& report_;
  model::Model moved_;
  Relaxation relaxation_;
  double begun_;
  double frame_ = -std::numeric_limits<double>::infinity();  // s, the next; the first is where it begins
  int steps_ = 0;                                            // since something was moved last
};

}  // namespace

DrapeReport follow_paths(const model::Model& model, const std::vector<body::Body>& bodies, model::State& state,
                         const MotionSettings& settings) {
  DrapeReport report;
  Follower follower(model, bodies, state, settings, report);
  follower.go();
  if (report.status == DrapeStatus::not_resumed) return report;
  state.velocity.assign(state.position.size(), Vector3d::Zero());
  report.motion.seconds = follower.seconds();
  const model::Model moved = model::at_time(model, state.time);
  const std::vector<body::Body> now = bodies_at(bodies, model, state.time);
  RelaxationSettings end;
  end.self_collision = settings.self_collision;
  end.hysteresis = true;
  Relaxation last(moved, now, end);
  last.inner_friction().take_anchors(state.slip);
  Vectors force;
  (void)last.residual(state.position, force);
  report.reactions = last.reactions();
  report.moments = last.moments();
  report.energy = last.energy(state.position);
  return report;
}

}  // namespace garment::simulator
