#include "runtime/simulator/drape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "runtime/base/number.hpp"
#include "runtime/simulator/awake.hpp"
#include "runtime/simulator/certificate.hpp"
#include "runtime/simulator/culprit.hpp"
#include "runtime/simulator/relaxation.hpp"
#include "runtime/simulator/rest.hpp"
#include "runtime/simulator/solver_state.hpp"

namespace garment::simulator {
namespace {

using Eigen::Vector3d;
using Vectors = std::vector<Vector3d>;

constexpr double kSoftTensile = 0.1;        // share of the tensile stiffness in the first stages (continuation)
constexpr double kSoftResidual = 0.5;       // residual at which the true stiffness comes in
constexpr int kSoftSteps = 60;
constexpr double kClosedStrain = 0.3;       // largest strain of seams that count as closed
constexpr int kDressingSteps = 300;
constexpr int kLookEvery = 10;              // steps between two looks at the strain
constexpr double kClosingRate = 0.95;       // strain over the strain at the last look of seams that still close
constexpr double kNearRest = 1;             // residual from which the body is looked at
constexpr int kRepairEvery = 10;            // steps between two looks at the body
constexpr double kFirstTimeStep = 1.0 / 60; // s
constexpr double kExactGive = 2e-7;         // m, of friction where the drape is to be exact
constexpr double kCalmTimeStep = 0.02;      // s, in which soft folds hardly move while threads come right
constexpr double kCalmStep = 0.15e-3;       // m, largest way of a step from which the folds have arrived
constexpr int kCalmSteps = 4;
constexpr int kCalmPause = 10;              // steps until the next try
constexpr double kCalmResidual = 20;        // times that of rest, from which calming is worth a try
constexpr int kMostRefused = 12;            // steps in a row
constexpr int kMostRepairs = 12;            // times that a garment at rest may still pierce a body
constexpr double kExtraOffset = 1e-3;       // m, by which a particle of a pierced part is pushed farther, each time
constexpr double kMostExtraOffset = 20e-3;  // m
constexpr double kSlidingResidual = 0.05;   // rest where sliders act and the drape is to be exact: stiff, they hold or slip to the last bits
constexpr int kEveningSteps = 60;           // that may begin uneven
constexpr int kMostEvenSteps = 1500;        // of settling, after which the two halves go their own ways
constexpr double kLeastPaired = 0.95;       // of the particles; fewer are no image any more
constexpr double kSymmetric = 3e-3;         // m, from its own image
constexpr int kIncrements = 10;             // of the weight, where the cloth's own friction acts

bool all_finite(const Vectors& x) {
  return std::all_of(x.begin(), x.end(), [](const Vector3d& p) { return p.allFinite(); });
}

/// What the loops of one drape share.
struct Drape {
  const model::Model& model;
  const std::vector<body::Body>& bodies;
  const DrapeSettings& settings;
  DrapeReport& report;
  Vectors x;
  Vectors infinite{};  // where positions became no numbers

  bool stop_asked() const { return settings.interrupted && settings.interrupted(); }
  void tell(const StepReport& step, const char* phase) const {
    if (!settings.progress) return;
    settings.progress({report.steps, x.size(), step.residual, target_residual(settings.settle), step.largest_motion, phase});
  }
};

/// Names of the panels that hold the particles of a tangle, for messages.
std::string panels_of(const model::Model& model, const ContactMesh& mesh, const Tangle& tangle, OriginId& origin) {
  std::vector<bool> hit(model.n_particles(), false);
  auto mark = [&](Index p) {
    if (p >= 0 && p < mesh.n_particles) hit[p] = true;
  };
  for (const EdgeHit& h : tangle.hits) {
    for (Index p : mesh.edge[h.edge]) mark(p);
    for (Index p : mesh.triangle[h.triangle]) mark(p);
  }
  for (std::size_t i = 0; i < tangle.inside.size(); ++i)
    if (tangle.inside[i]) hit[i] = true;
  std::map<Index, int> count;
  for (std::size_t v = 0; v < model.n_vertices(); ++v)
    if (hit[model.vertex_particle[v]]) ++count[model.vertex_panel[v]];
  std::string names;
  int most = 0;
  for (auto [panel, n] : count) {
    names += (names.empty() ? "`" : ", `") + model.panels[panel].name + "`";
    if (n > most) most = n, origin = model.panels[panel].origin;
  }
  return names.empty() ? "the garment" : names;
}

/// Pushes what pierces a body, or lies in it, farther out from now on.
void push_pierced(const ContactMesh& mesh, const Tangle& tangle, Relaxation& relaxation) {
  std::vector<bool> raise(static_cast<std::size_t>(mesh.n_particles), false);
  for (const EdgeHit& h : tangle.hits) {
    const auto& e = mesh.edge[h.edge];
    const auto& t = mesh.triangle[h.triangle];
    if (!mesh.is_body(e[0]) && !mesh.is_body(t[0])) continue;
    for (Index p : {e[0], e[1], t[0], t[1], t[2]})
      if (!mesh.is_body(p)) raise[p] = true;
  }
  for (std::size_t i = 0; i < tangle.inside.size(); ++i)
    if (tangle.inside[i]) raise[i] = true;
  for (std::size_t i = 0; i < raise.size(); ++i)
    if (raise[i])
      relaxation.extra_offset()[i] = std::min(kMostExtraOffset, relaxation.extra_offset()[i] + kExtraOffset);
}

/// The garment's way to rest, stage by stage. Stages only ever go forward:
///   dressing   without weight and at a share of the tensile stiffness: seams contract, bodies push out
///   soft       with weight, still soft (continuation in the stiffness)
///   settling   the true cloth, to rest
/// At rest the exact test decides: what still pierces a body is pushed farther out, and settling goes on.
class Way {
 public:
  Way(Drape& d, const ContactMesh& all) : d_(d), all_(all), mirror_(d.settings.symmetric ? Mirror(d.model, d.bodies) : Mirror()), kept_(mirror_), relaxation_(d.model, d.bodies, relaxation_settings(d)), awake_(d.model, d.bodies, kept_, relaxation_) {
    relaxation_.keep_even(kept_);
    if (d.settings.self_collision) relaxation_.set_tangle(find_tangle(relaxation_.mesh(), no_bodies(), d.x));
    if (d.settings.near_rest) {
      enter(Stage::settling);
      relaxation_.set_time_step(kRestTimeStep);
      return;
    }
    relaxation_.set_tensile_scale(kSoftTensile);
    if (largest_thread_strain(d.model, d.x) > kClosedStrain) {
      stage_ = Stage::dressing;
      relaxation_.set_gravity_scale(0);
    }
  }

  /// Goes to rest. The cloth at rest without its own friction is where it would hang in the end; how it came there the sliders must
  /// not learn from the solver. So the weight comes on anew, in increments, each brought to rest with the sliders frozen; or only
  /// the last of them, where the sliders are where they were when the garment hung still (`hangs`).
  DrapeStatus go(bool hangs) {
    const double target = target_residual(d_.settings.settle);
    if (increment_ == 0) {
      const DrapeStatus status = hangs ? DrapeStatus::at_rest : settle(target, d_.settings.certify);
      if (!d_.settings.hysteresis || status != DrapeStatus::at_rest) return status;
      begin_increment(hangs ? kIncrements : 1);
    }
    for (;; begin_increment(increment_ + 1)) {
      const bool last = increment_ == kIncrements;
      const DrapeStatus status = settle(share() * target, last && d_.settings.certify);
      if (status != DrapeStatus::at_rest) return status;
      relaxation_.inner_friction().slip(d_.x);
      if (last) return status;
    }
  }

  Relaxation& relaxation() { return relaxation_; }
  bool even() const { return !kept_.empty() && mirror_.unevenness(d_.x) < kSymmetric; }

  /// In a checkpoint between two steps.
  void keep(Archive& a) {
    keep_positions(a, d_.x, d_.model.n_particles(), relaxation_.mesh().largest_contact_distance);
    a.keep(stage_, Stage::settling);
    kept_.keep(a, d_.model.n_particles());
    if (a.reading() && a.ok()) relaxation_.keep_even(kept_);
    for (int* count : {&uneven_, &steps_in_stage_, &refused_, &repairs_, &d_.report.steps, &increment_, &most_steps_, &calming_, &pause_}) {
      a.keep(*count);
      a.demand(*count >= 0 && *count <= kMostCounted);
    }
    a.demand(calming_ <= kCalmSteps + 1 && pause_ <= kCalmPause);
    a.demand(increment_ <= kIncrements && (increment_ == 0 || d_.settings.hysteresis));
    a.keep(last_strain_);
    a.keep_any(d_.report.newton_step);
    if (a.reading() && a.ok() && increment_ > 0) relaxation_.inner_friction().set_active(true);
    relaxation_.keep(a);
  }

 private:
  enum class Stage { dressing, soft, settling };

  double share() const { return static_cast<double>(increment_) / kIncrements; }

  void begin_increment(int k) {
    increment_ = k;
    relaxation_.inner_friction().set_active(true);
    relaxation_.set_gravity_scale(share());
    relaxation_.set_tensile_scale(1);
    most_steps_ = d_.report.steps + d_.settings.max_steps;
    enter(Stage::settling);
    relaxation_.set_time_step(kRestTimeStep);
  }

  DrapeStatus settle(double target, bool certify) {
    while (d_.report.steps < most_steps_) {
      const bool stop = d_.stop_asked();
      d_.settings.checkpoints.look(*this, stop);
      if (stop) return DrapeStatus::interrupted;
      if (calming_ > 0)
        relaxation_.set_time_step(calming_ == 1 ? kRestTimeStep : kCalmTimeStep);
      else if (stage_ == Stage::settling)  // before, without weight and soft, cloth thrown ahead turns collars up again
        relaxation_.coast(d_.x);
      before_ = d_.x;
      part_halves();
      StepReport step = relaxation_.step(d_.x);
      ++d_.report.steps;
      ++steps_in_stage_;
      if (!all_finite(d_.x)) {
        d_.infinite.swap(d_.x);
        d_.x = before_;
        return DrapeStatus::diverged;
      }
      d_.tell(step, stage_ == Stage::settling ? "settling" : "dressing");
      d_.report.newton_step = step.newton_step;
      refused_ = step.accepted ? 0 : refused_ + 1;
      if (step.accepted && !relaxation_.inner_friction().idle()) relaxation_.set_time_step(kRestTimeStep);  // sliders cut it short, not folds
      if (refused_ > kMostRefused) return DrapeStatus::not_settled;
      if (stage_ != Stage::settling) {
        advance(step, target);
        continue;
      }
      bool rest = rests(step, target);
      if (!rest) calm(step, target);
      if (!rest && calming_ == 0 && step.accepted && relaxation_.plain()) awake_.settle(relaxation_, before_, target, d_.x);
      if (rest) d_.x = before_;  // the state that was judged
      if (rest && !certify) return DrapeStatus::at_rest;
      bool look = certify && step.residual < kNearRest && steps_in_stage_ % kRepairEvery == 0;
      if (!rest && !look) continue;
      Tangle tangle = find_tangle(all_, d_.bodies, d_.x);
      if (rest && tangle.empty()) return DrapeStatus::at_rest;
      if (rest && ++repairs_ > kMostRepairs) return DrapeStatus::tangled;
      push_pierced(all_, tangle, relaxation_);
      if (!tangle.empty()) relaxation_.stop();
      if (d_.settings.self_collision) relaxation_.set_tangle(find_tangle(relaxation_.mesh(), no_bodies(), d_.x));
      if (rest) {
        steps_in_stage_ = calming_ = pause_ = 0;
        relaxation_.forget_motion();
      }
    }
    return DrapeStatus::not_settled;
  }

  static RelaxationSettings relaxation_settings(const Drape& d) {
    RelaxationSettings settings;
    settings.self_collision = d.settings.self_collision;
    if (d.settings.settle == Settle::exact) settings.friction_give = kExactGive;
    return settings;
  }

  /// Places that cannot come to lie evenly, between layers whose triangles differ on the two sides, go their own ways; where they
  /// are many, or others follow, or the garment does not come to rest, all do.
  void part_halves() {
    if (kept_.empty()) return;
    uneven_ += relaxation_.uneven() ? 1 : 0;
    const bool restless = stage_ == Stage::settling && steps_in_stage_ > kMostEvenSteps;
    if (uneven_ < kEveningSteps && !restless) return;
    uneven_ = 0;
    const bool parted = kept_.n_paired() < d_.x.size();
    kept_ = kept_.where_even(d_.x, kEven);
    if (restless || parted || static_cast<double>(kept_.n_paired()) < kLeastPaired * static_cast<double>(d_.x.size())) kept_ = Mirror();
    relaxation_.keep_even(kept_);
    relaxation_.forget_motion();
  }

  void advance(const StepReport& step, double target) {
    if (stage_ == Stage::dressing) {
      if (steps_in_stage_ % kLookEvery != 0) return;
      double strain = largest_thread_strain(d_.model, d_.x);
      // Closed, or as far closed as the body lets it (a garment smaller than its body stays stretched).
      bool closed = strain < kClosedStrain || strain > kClosingRate * last_strain_;
      last_strain_ = strain;
      if (!closed && steps_in_stage_ < kDressingSteps) return;
      relaxation_.set_gravity_scale(1);
      enter(Stage::soft);
    } else if (step.residual < std::max(kSoftResidual, target) || steps_in_stage_ > kSoftSteps) {
      relaxation_.set_tensile_scale(1);
      enter(Stage::settling);
    }
  }

  /// Every long step along a fold that still travels stretches threads to the second order: near rest the residual tells of the
  /// last step more than of the place. Some steps too short for folds bring the threads right, and then the place is judged.
  void calm(const StepReport& step, double target) {
    if (d_.settings.settle != Settle::equilibrium || !relaxation_.inner_friction().idle()) return;
    if (calming_ > 1) {
      calming_ = step.residual <= target ? 1 : calming_ - 1;
    } else if (calming_ == 1) {
      calming_ = 0;
      pause_ = kCalmPause;
    } else if (pause_ > 0) {
      --pause_;
    } else if (step.time_step < kRestTimeStep) {
      if (step.residual <= target) calming_ = 1;  // only the step is too short to judge by
    } else if (std::max(step.newton_step, step.largest_motion) < kCalmStep && step.residual < kCalmResidual * target) {
      calming_ = kCalmSteps + 1;
    }
    if (calming_ > 0) relaxation_.stop();
  }

  void enter(Stage stage) {
    stage_ = stage;
    calming_ = pause_ = 0;
    steps_in_stage_ = 0;
    relaxation_.set_time_step(kFirstTimeStep);
    relaxation_.forget_motion();
  }

  bool rests(const StepReport& step, double target) const {
    if (!relaxation_.inner_friction().idle() && d_.settings.settle == Settle::exact)
      return steps_in_stage_ >= 2 && step.residual <= kSlidingResidual && step.time_step >= kRestTimeStep && step.newton_step < kSlidingStep;
    if (steps_in_stage_ < 2 || !(step.residual <= target)) return false;
    if (d_.settings.settle == Settle::preview) return true;
    return step.time_step >= kRestTimeStep && step.newton_step < kRestStep;
  }

  Drape& d_;
  const ContactMesh& all_;
  const Mirror mirror_;
  Mirror kept_;  // what of it is kept
  Relaxation relaxation_;
  Awake awake_;
  Stage stage_ = Stage::soft;
  int most_steps_ = d_.settings.max_steps, increment_ = 0;  // of the weight, 0: the sliders have not begun
  int uneven_ = 0;  // steps that began uneven
  int steps_in_stage_ = 0, refused_ = 0, repairs_ = 0;
  int calming_ = 0;  // steps to go until the place is judged, that one included
  int pause_ = 0;    // steps until the next try
  double last_strain_ = 1e300;
  Vectors before_;
};

/// What most likely keeps the garment from rest.
std::string advice(const Drape& d) {
  constexpr double kTornApart = 0.5;  // strain that no worn garment has
  constexpr double kFallen = 0.5;     // m, in the mean
  const double strain = largest_thread_strain(d.model, d.x);
  if (strain > kTornApart)
    return fmt::format("cloth is stretched by {}%: pieces sewn together start far apart, twisted or on the wrong side; look at the "
                       "pictures, at which ends meet in the seams, and where the pieces are placed",
                       format_number(100 * strain, 2));
  double fallen = 0;
  for (std::size_t i = 0; i < d.x.size(); ++i) fallen += (d.model.start[i].y() - d.x[i].y()) / static_cast<double>(d.x.size());
  if (fallen > kFallen) return "the garment falls and nothing catches it: attach or pin it";
  return "allow more steps, or a coarser grid; a garment that slides without end is attached to a level";
}

void explain(Drape& d, const ContactMesh& all, const Vectors& force) {
  Findings& findings = d.report.findings;
  if (d.report.status == DrapeStatus::tangled) {
    Tangle tangle = find_tangle(all, d.bodies, d.x);
    OriginId origin;
    std::string names = panels_of(d.model, all, tangle, origin);
    findings.push_back({"G0801", Severity::error,
                        fmt::format("{} could not be freed: {} places cut cloth or body, {} particles lie inside a body",
                                    names, tangle.hits.size(), tangle.n_inside),
                        {{origin, "the panel with most of them"}},
                        "place the panels farther from the body and from each other, or in the order in which they are worn"});
  }
  if (d.report.status == DrapeStatus::not_settled) {
    const Culprit panel = panel_with_most(d.model, force);
    findings.push_back({"G0802", Severity::error,
                        fmt::format("after {} steps the residual is {} of the weight, {} is rest; most of it is in {}",
                                    d.report.steps, format_number(d.report.residual, 3),
                                    format_number(target_residual(d.settings.settle), 3), panel.name),
                        {{panel.origin, "most of the net force acts here"}},
                        advice(d)});
  }
  if (d.report.status == DrapeStatus::diverged)
    findings.push_back(infinite_positions(d.model, d.infinite));
}

}  // namespace

double number_or_infinite(double value) { return std::isnan(value) ? std::numeric_limits<double>::infinity() : value; }

DrapeReport not_resumed() {
  DrapeReport report;
  report.status = DrapeStatus::not_resumed;
  report.findings.push_back({"G0810", Severity::error, "the checkpoint holds no state that this drape could have been in", {},
                             "run it from the start, without `--resume`"});
  return report;
}

double target_residual(Settle settle) {
  switch (settle) {
    case Settle::preview: return 0.3;
    case Settle::equilibrium: return 0.05;
    case Settle::exact: return 1e-6;
  }
  return 0.05;
}

DrapeReport drape(const model::Model& model, const std::vector<body::Body>& bodies, model::State& state,
                  const DrapeSettings& settings) {
  DrapeReport report;
  Drape d{model, bodies, settings, report, state.position.empty() ? model.start : state.position};
  ContactMesh all(model, bodies, ContactOptions{settings.self_collision, 0, 0});
  Way way(d, all);
  if (!settings.checkpoints.resume.empty() && !settings.checkpoints.restore(way)) return not_resumed();
  const bool hangs = settings.hysteresis && settings.checkpoints.resume.empty() && way.relaxation().inner_friction().take_anchors(state.slip);
  report.status = way.go(hangs);
  report.symmetric = way.even();
  if (!way.relaxation().inner_friction().idle()) state.slip = way.relaxation().inner_friction().anchors();
  Vectors force;
  report.residual = number_or_infinite(way.relaxation().residual(d.x, force));
  report.energy = way.relaxation().energy(d.x);
  report.reactions = way.relaxation().reactions();
  report.moments = way.relaxation().moments();
  state.position = d.x;
  state.velocity.assign(d.x.size(), Vector3d::Zero());
  Certificate certificate = certify(model, state, bodies);
  report.self_intersections = certificate.self_intersections;
  report.body_intersections = certificate.body_intersections;
  report.inside_body = certificate.inside_body;
  if (!certificate.clean() && report.status == DrapeStatus::at_rest) report.status = DrapeStatus::tangled;
  explain(d, all, force);
  return report;
}

}  // namespace garment::simulator
