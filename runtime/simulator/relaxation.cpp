#include "runtime/simulator/relaxation.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/base/parallel.hpp"
#include "runtime/simulator/cloth_contact.hpp"
#include "runtime/simulator/reactions.hpp"
#include "runtime/simulator/truncate.hpp"

namespace garment::simulator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vectors = std::vector<Vector3d>;

constexpr double kLargestTimeStep = 2.0;   // s
constexpr double kSmallestTimeStep = 1e-4; // s
constexpr double kLinearTolerance = 0.03;
constexpr int kLinearIterations = 200;
constexpr double kRounding = 1e-10;        // share of the energy that sums of it may be off
constexpr double kSlidingRounding = 1e-13;
constexpr int kForesights = 1;             // times that the contacts of one step are revised
constexpr int kHalvings = 4;               // of a step that would raise the energy
constexpr double kLeastStep = 1e-3;        // share of a step that walls would turn
constexpr double kTurned = 0.5;            // cosine from which a particle counts as having turned back
constexpr int kFreeTurns = 4;              // in a row that say nothing yet
constexpr double kLeastSwing = 2e-5;       // m
constexpr double kLeastDamping = 10, kMostDamping = 1e4;  // N/m
constexpr double kForgetDamping = 0.8;     // per step
constexpr double kMostCoasted = 0.5;       // cells, ahead of a step
constexpr double kHoldSpeed = 5e-3;        // m per step towards a hold's place

double largest(const Vectors& v) {
  double best = 0;
  for (const Vector3d& d : v) best = std::max(best, d.squaredNorm());
  return std::sqrt(best);
}

}  // namespace

Relaxation::Relaxation(const model::Model& model, const std::vector<body::Body>& bodies,
                       const RelaxationSettings& settings)
    : model_(model),
      settings_(settings),
      elastic_(model),
      inner_(model, elastic_),
      holds_(model),
      matrix_(elastic_.make_matrix()),
      linear_(matrix_.pattern(), holds_),
      mesh_(model, no_bodies(), ContactOptions{settings.self_collision, settings.self_offset, 0}),
      candidates_(mesh_, mean_edge(model)),
      bodies_(model, bodies, mean_edge(model), settings.body),
      friction_(model.n_particles(), settings.friction_give, bodies_.stiffness()),
      cloth_friction_(model, Rubbing::stated, settings.friction_give, settings.contact_stiffness),
      loads_(model),
      spacing_(mean_edge(model)),
      rubbed_(friction_) {
  inner_.set_active(settings.hysteresis);
  turns_.assign(model.n_particles(), 0);
  damping_.assign(model.n_particles(), 0);
  last_motion_.assign(model.n_particles(), Vector3d::Zero());
  // Without weight rest is measured by the weight that the cloth would have.
  const double gravity = model.gravity.norm() > 0 ? model.gravity.squaredNorm() : kStandardGravity * kStandardGravity;
  double sum = 0;
  for (double m : model.mass) sum += m * m * gravity;
  rms_weight_ = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, model.n_particles())));
}

void Relaxation::set_tangle(Tangle tangle) {
  tangle_ = std::move(tangle);
  if (candidates_.known()) candidates_.list().exempt(mesh_, tangle_);
}

void Relaxation::refresh_candidates(const Vectors& x) {
  if (candidates_.refresh(x)) exempt_tangle(x);
}

/// What is tangled at x stays out of a new list.
void Relaxation::exempt_tangle(const Vectors& x) {
  if (tangle_.empty()) return;
  tangle_ = find_tangle(mesh_, no_bodies(), x);
  candidates_.list().exempt(mesh_, tangle_);
}

void Relaxation::find_contacts(const Vectors& x, std::vector<Contact>& contacts) const {
  active_contacts(mesh_, candidates_.list(), x, contacts);
}

/// What the contacts of x weigh holds for the whole step.
void Relaxation::keep_shares() {
  shares_.assign(candidates_.list().pairs().size(), 0.0F);
  for (const Contact& c : contacts_) shares_[c.pair] = static_cast<float>(c.share);
}

double Relaxation::contact_energy_sum(const std::vector<Contact>& contacts) const {
  return parallel_sum(contacts.size(), 512, 0.0, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t k = begin; k < end; ++k)
      sum += contacts[k].share *
             contact_energy(contacts[k].distance, contacts[k].contact_distance, settings_.contact_stiffness).value;
    return sum;
  });
}

double Relaxation::gravity_energy(const Vectors& x) const {
  Vector3d g = settings_.gravity_scale * model_.gravity;
  return parallel_sum(x.size(), 4096, 0.0, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum -= model_.mass[i] * g.dot(x[i]);
    return sum;
  });
}

double Relaxation::energy(const Vectors& x) const { return elastic_.energy(x) + gravity_energy(x); }

double Relaxation::total_energy(const Vectors& x, std::vector<Contact>& contacts) const {
  active_contacts(mesh_, candidates_.list(), x, contacts, &shares_);
  return energy(x) + inner_.energy(x) + loads_.energy(x, settings_.gravity_scale) + contact_energy_sum(contacts) + bodies_.energy(x) +
         friction_.energy(x) + cloth_friction_.energy(x);
}

void Relaxation::collect_normal_forces(const Vectors& x) {
  friction_.begin_step();
  bodies_.add_normal_forces(x, friction_);
  friction_.freeze(x);
}

void Relaxation::add_external_forces(const Vectors& x, Vectors& force) {
  Vector3d g = settings_.gravity_scale * model_.gravity;
  for (std::size_t i = 0; i < x.size(); ++i) force[i] += model_.mass[i] * g;
  loads_.follow(x);
  loads_.add(force, settings_.gravity_scale);
}

double Relaxation::rms_over_weight(const Vectors& force) const {
  double sum = 0;
  for (const Vector3d& f : force) sum += f.squaredNorm();
  double rms = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, force.size())));
  return rms_weight_ > 0 ? rms / rms_weight_ : rms;
}

double Relaxation::residual(const Vectors& x, Vectors& force) {
  refresh_candidates(x);
  bodies_.find(x);
  find_contacts(x, contacts_);
  elastic_.follow(x);
  elastic_.energy_and_force(x, force);
  inner_.add_force(x, force);
  add_external_forces(x, force);
  collect_normal_forces(x);
  add_contact_forces(contacts_, settings_.contact_stiffness, force, nullptr, stiffness_);
  cloth_friction_.begin(mesh_, candidates_.list(), contacts_, settings_.contact_stiffness);
  cloth_friction_.add_force(x, force, nullptr, nullptr);
  if (inner_.idle()) mirror_.even(force);
  reactions_ = simulator::reactions(model_, holds_, force);
  moments_ = simulator::moments(model_, holds_, force, x);
  return residual_of(force);
}

/// Takes from `force` (all but the bodies') what holds and bodies carry; RMS of the rest over RMS weight.
double Relaxation::residual_of(Vectors& force) const {
  holds_.filter(force);  // first, or friction would spend its strength on what the holds carry
  friction_.absorb(force, holds_);
  return rms_over_weight(force);
}

/// Displaces held particles towards the place of their holds; true when any had to move.
bool Relaxation::move_held(const Vectors& x, Vectors& dx) const {
  bool moved = false;
  for (std::size_t h = 0; h < model_.hold_particle.size(); ++h) {
    auto i = static_cast<std::size_t>(model_.hold_particle[h]);
    const Vector3d off = holds_.error(model_, h, x[i]);
    const double size = off.norm();
    if (size < 1e-9) continue;
    const Vector3d way = size > kHoldSpeed ? Vector3d(off * (kHoldSpeed / size)) : off;
    if (model_.hold_kind[h] == model::HoldKind::plane) {
      const Vector3d n = model_.hold_normal[h].normalized();
      dx[i] += (way - dx[i]).dot(n) * n;  // not in sum: two holds may ask for the same
    } else {
      dx[i] = way;
    }
    moved = moved || size > 1e-5;
  }
  return moved;
}

/// Forces, matrix and what bodies bear at x. Returns the energy that the line search compares with.
double Relaxation::assemble(const Vectors& x, StepReport& report) {
  refresh_candidates(x);
  bodies_.find(x);
  find_contacts(x, contacts_);
  keep_shares();
  report.contacts = contacts_.size();
  elastic_.follow(x);
  double elastic = elastic_.energy_force_hessian(x, force_, matrix_);
  const double slid = inner_.add_force_hessian(x, force_, matrix_);
  add_external_forces(x, force_);
  loads_.add_stiffness(matrix_, settings_.gravity_scale);
  collect_normal_forces(x);
  add_contact_forces(contacts_, settings_.contact_stiffness, force_, &matrix_, stiffness_);
  cloth_friction_.begin(mesh_, candidates_.list(), contacts_, settings_.contact_stiffness);
  cloth_friction_.add_force(x, force_, &matrix_, &stiffness_);
  if (inner_.idle()) mirror_.even(force_);
  net_ = force_;
  report.residual = residual_of(net_);
  bodies_.add_forces(x, force_, matrix_);
  friction_.add_force(x, force_, &matrix_);
  holds_.filter(force_);
  report.energy = elastic + gravity_energy(x);
  for (std::size_t i = 0; i < x.size(); ++i)
    matrix_.add_diagonal(i, model_.mass[i] / (time_step_ * time_step_) + damping_[i]);
  return report.energy + slid + loads_.energy(x, settings_.gravity_scale) + contact_energy_sum(contacts_) + bodies_.energy(x) +
         friction_.energy(x) + cloth_friction_.energy(x);
}

/// dx_ from the linear system. A particle just off a body feels nothing of it, and the system would send it inside: who
/// would be pressed after the step is counted as touching, and the system is solved again (active set).
void Relaxation::solve_step(const Vectors& x, StepReport& report) {
  for (int round = 0;; ++round) {
    for (int revised = 0;; ++revised) {
      report.linear_iterations +=
          linear_.solve(matrix_, stiffness_, force_, kLinearTolerance, kLinearIterations, dx_, &x, round > 0 && inner_.idle()).iterations;
      if (inner_.idle() || revised == InnerFriction::kRevisions) break;
      inner_.foresee(x, dx_, matrix_);
    }
    if (round == kForesights) return;
    const std::size_t coming = foresee_contacts(x);
    if (bodies_.foresee(x, dx_, holds_, force_, matrix_) + coming == 0) return;
  }
}

/// Counts contacts of cloth with cloth that the step would close as acting already; returns how many.
std::size_t Relaxation::foresee_contacts(const Vectors& x) {
  coming_contacts(mesh_, candidates_.list(), x, dx_, coming_);
  const double stiffness = settings_.contact_stiffness;
  for (const Contact& c : coming_) {
    const double room = c.distance - c.contact_distance;
    ContactStiffness s{{-1, -1, -1, -1}, {0, 0, 0, 0}, c.normal.cast<float>(), static_cast<float>(c.share * stiffness)};
    for (int k = 0; k < 4; ++k) {
      if (c.w[k] == 0) continue;
      s.particle[k] = c.p[k];
      s.weight[k] = static_cast<float>(c.w[k]);
      matrix_.add_diagonal(static_cast<std::size_t>(c.p[k]),
                           Matrix3d(c.share * stiffness * c.w[k] * c.w[k] * c.normal * c.normal.transpose()));
      force_[c.p[k]] -= holds_.filtered(c.p[k], Vector3d(c.share * stiffness * room * c.w[k] * c.normal));
    }
    stiffness_.push_back(s);
  }
  return coming_.size();
}

/// Adds to dx_ what holds and tangles ask for; true when the energy may rise for it.
bool Relaxation::drive(const Vectors& x) {
  bool driven = move_held(x, dx_);
  if (tangle_.empty()) return driven;
  untangle_displacements(mesh_, no_bodies(), x, tangle_, untangle_);
  for (std::size_t i = 0; i < x.size(); ++i) dx_[i] += holds_.filtered(i, untangle_[i]);
  return true;
}

/// Shortens displacements that would lead farther than the leash.
void Relaxation::pull_back(const Vectors& x) {
  for (std::size_t i = 0; i < place_.size(); ++i) {
    const Vector3d off = x[i] - place_[i], d = dx_[i];
    if ((off + d).squaredNorm() <= leash_ * leash_) continue;
    // The larger root of |off + s d| = leash: off is within.
    const double a = d.squaredNorm(), b = off.dot(d), c = std::min(0.0, off.squaredNorm() - leash_ * leash_);
    dx_[i] *= a > 0 ? std::clamp((std::sqrt(b * b - a * c) - b) / a, 0.0, 1.0) : 0;
    at_leash_ = true;
  }
}

/// Bounds dx_: at most one cell, and nothing that starts an intersection.
TruncateStats Relaxation::keep_apart(const Vectors& x) {
  double stride = largest(dx_);
  if (stride > spacing_)  // farther than a cell the linear picture of the folds says nothing
    for (Vector3d& d : dx_) d *= spacing_ / stride;
  at_leash_ = false;
  pull_back(x);
  whole_ = dx_;
  TruncateStats cut = truncate(mesh_, candidates_.list(), x, dx_);
  if (cut.out_of_reach == 0) return cut;
  candidates_.renew(x);  // the list is too old or too short for so wide a step
  exempt_tangle(x);
  find_contacts(x, contacts_);
  keep_shares();
  dx_ = whole_;
  return truncate(mesh_, candidates_.list(), x, dx_);
}

/// Goes along dx_ to trial_, as far as the energy does not rise (unless driven); returns the energy there.
double Relaxation::search(const Vectors& x, double before, bool driven, StepReport& report) {
  trial_.resize(x.size());
  double after = 0;
  // Sliders that take turns between holding and slipping do so within what the sums are off by.
  const double above = inner_.idle() ? kRounding * std::abs(before) + 1e-12 : kSlidingRounding * std::abs(before) + 1e-16;
  auto go = [&] {
    for (std::size_t i = 0; i < x.size(); ++i) trial_[i] = x[i] + report.scale * dx_[i];
    after = total_energy(trial_, trial_contacts_);
    return driven || !(after > before + above);
  };
  bool well = go();
  for (int k = 0; k < kHalvings && !well; ++k) {
    report.scale *= 0.5;
    well = go();
  }
  report.accepted = well && std::isfinite(after);
  return after;
}

/// A particle that goes back and forth between two places (at a kink of a body, where contacts change) moves less each time.
void Relaxation::damp(const Vectors& before, const Vectors& after) {
  for (std::size_t i = 0; i < after.size(); ++i) {
    const Vector3d motion = after[i] - before[i];
    const bool turned = motion.dot(last_motion_[i]) < -kTurned * motion.norm() * last_motion_[i].norm() &&
                        std::min(motion.norm(), last_motion_[i].norm()) > kLeastSwing;
    turns_[i] = turned ? turns_[i] + 1 : 0;
    damping_[i] = turned && turns_[i] > kFreeTurns ? std::clamp(2 * damping_[i], kLeastDamping, kMostDamping)
                                                   : kForgetDamping * damping_[i];
    if (damping_[i] < 0.1 * kLeastDamping) damping_[i] = 0;
    last_motion_[i] = motion;
  }
}

void Relaxation::borrow(Relaxation& whole, const std::vector<model::Index>& particle) {
  for (std::size_t k = 0; k < particle.size(); ++k) {
    const auto i = static_cast<std::size_t>(particle[k]);
    friction_.copy(k, whole.friction_, i);
    bodies_.copy(k, whole.bodies_, i);
  }
  time_step_ = whole.time_step_;
}

void Relaxation::give_back(Relaxation& whole, const std::vector<model::Index>& particle, const std::vector<char>& free) {
  for (std::size_t k = 0; k < particle.size(); ++k) {
    if (free[k] == 0) continue;
    const auto i = static_cast<std::size_t>(particle[k]);
    whole.friction_.copy(i, friction_, k);
    whole.bodies_.copy(i, bodies_, k);
  }
  whole.stop();
}

void Relaxation::coast(Vectors& x) {
  origin_.clear();
  // In a tangle the energy says nothing; where cloth rubs on cloth, or within itself, the way counts.
  if (!plain()) return momentum_.forget();
  double share = momentum_.share();
  if (share <= 0) return;
  const Vectors& way = momentum_.way();
  share = std::min(share, kMostCoasted * spacing_ / std::max(largest(way), 1e-12));
  dx_.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) dx_[i] = holds_.filtered(i, Vector3d(share * way[i]));
  pull_back(x);
  refresh_candidates(x);
  truncate(mesh_, candidates_.list(), x, dx_);
  origin_ = x;
  rubbed_ = friction_;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += dx_[i];
}

StepReport Relaxation::step(Vectors& x) {
  StepReport report;
  report.time_step = time_step_;
  double before = assemble(x, report);
  wish_ = force_;  // without the forces that only keep foreseen contacts from closing
  solve_step(x, report);
  report.newton_step = largest(dx_);
  double predicted = 0;  // decrease of the energy that the quadratic model promises, at least half of f . dx
  for (std::size_t i = 0; i < x.size(); ++i) predicted += wish_[i].dot(dx_[i]);
  bool driven = drive(x);
  uneven_ = inner_.idle() && mirror_.unevenness(x) > kEven;
  driven |= uneven_;
  if (inner_.idle()) mirror_.even(x, dx_);
  TruncateStats cut = keep_apart(x);
  double after = search(x, before, driven, report);
  // Cutting single particles back turns the step, perhaps uphill. The whole step made shorter does not turn.
  for (double share = 0.5; !report.accepted && cut.limited > 0 && share > kLeastStep; share *= 0.5) {
    for (std::size_t i = 0; i < x.size(); ++i) dx_[i] = share * whole_[i];
    if (truncate(mesh_, candidates_.list(), x, dx_).limited > 0) continue;
    report.scale = 1;
    after = search(x, before, driven, report);
    break;
  }
  report.limited = cut.limited;
  if (!origin_.empty() && (!report.accepted || momentum_.rose(after))) {
    x.swap(origin_);
    friction_ = rubbed_;
    origin_.clear();
    momentum_.forget();
    return report;
  }
  if (!report.accepted) {
    time_step_ = std::max(kSmallestTimeStep, time_step_ / 4);
    return report;
  }
  damp(x, trial_);
  momentum_.went(origin_.empty() ? x : origin_, trial_, wish_, after);
  report.largest_motion = largest(momentum_.way());
  if (driven) momentum_.forget();
  origin_.clear();
  bodies_.next_step();
  x.swap(trial_);
  friction_.follow(x);
  cloth_friction_.follow(x);
  double gain = before - after;
  bool below_rounding = predicted < kRounding * std::abs(before);  // then the gain says nothing
  if (below_rounding && report.scale == 1)
    time_step_ = std::min(kLargestTimeStep, time_step_ * 1.5);
  else if (report.scale < 1 || gain < 0.1 * predicted)
    time_step_ = std::max(kSmallestTimeStep, time_step_ * (report.scale < 0.5 ? 0.4 : 0.8));
  else if (gain > 0.3 * predicted)
    time_step_ = std::min(kLargestTimeStep, time_step_ * 1.5);
  return report;
}

}  // namespace garment::simulator
