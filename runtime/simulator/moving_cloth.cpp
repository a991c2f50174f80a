#include "runtime/simulator/moving_cloth.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/base/parallel.hpp"
#include "runtime/simulator/cloth_contact.hpp"
#include "runtime/simulator/truncate.hpp"

namespace garment::simulator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vectors = std::vector<Vector3d>;

constexpr double kFrictionGive = 1e-5;        // m, by which what sticks gives way: cloth in motion feels its springs
constexpr double kLateHoldSpeed = 1;          // m/s, of what is not yet where its hold is
constexpr double kLeastWay = 2e-3;            // m, that a particle may go in one iteration however near a body is
constexpr double kNearCloth = 0.05;           // m round the cloth, where the speed of bodies counts

/// The model for the elastic forces alone.
model::Model without_ties(model::Model m) {
  m.tie.clear();
  m.tie_weights.clear();
  m.tie_length.clear();
  m.tie_stiffness.clear();
  m.tie_closure.clear();
  m.rod_tie.clear();
  return m;
}

}  // namespace

MovingCloth::MovingCloth(const model::Model& model, const std::vector<body::Body>& bodies, bool self_collision, double time, Acts acts)
    : start_(model),
      bodies_given_(bodies),
      constrained_(acts == Acts::all),
      moved_(model::at_time(model, time)),
      last_holds_(moved_.hold_point),
      elastic_(constrained_ ? model : without_ties(model)),
      damping_(model, elastic_),
      inner_(model, elastic_),
      holds_(moved_),
      matrix_(elastic_.make_matrix()),
      linear_(matrix_.pattern(), holds_),
      mesh_(model, no_bodies(), ContactOptions{self_collision, kSelfOffset, 0}),
      candidates_(mesh_, mean_edge(model)),
      bodies_(moved_, bodies, mean_edge(model), {}),
      friction_(model.n_particles(), kFrictionGive, bodies_.stiffness()),
      cloth_friction_(model, Rubbing::all, kFrictionGive, kContactStiffness),
      loads_(moved_),
      touching_(model.n_particles(), 0) {
  const double gravity = model.gravity.norm() > 0 ? model.gravity.norm() : kStandardGravity;
  double sum = 0;
  for (double m : model.mass) sum += m * m * gravity * gravity;
  rms_weight_ = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, model.n_particles())));
  go_to(time);
  last_placements_ = placements_;
  for (const body::Body& body : bodies)
    for (const auto& t : body.mesh.triangles)
      for (int k = 0; k < 3; ++k)
        fine_bodies_ = fine_bodies_ && (body.mesh.vertices[t[k]] - body.mesh.vertices[t[(k + 1) % 3]]).norm() < kNearCloth;
}

void MovingCloth::go_to(double time) {
  if (start_.motions.empty()) return;
  model::move_holds(start_, time, moved_);
  holds_ = Holds(moved_);  // planes tilt with what they move with
  placements_.assign(bodies_given_.size(), {});
  bool any = false;
  for (const model::Motion& m : start_.motions) {
    if (m.body < 0 || static_cast<std::size_t>(m.body) >= placements_.size()) continue;
    placements_[static_cast<std::size_t>(m.body)] = model::placement_at(m, time);
    any = true;
  }
  if (!any) return;
  bodies_.place(placements_, friction_);
  looked_ = false;
}

/// Finds what lies near what at x, unless that is known from the last time.
void MovingCloth::look_around(const Vectors& x) {
  if (looked_ && x == looked_at_) return;
  looked_ = true;
  looked_at_ = x;
  candidates_.refresh(x);
  bodies_.find(x);
  weigh_contacts(x);
}

/// Contacts of x, and what they weigh until the next look.
void MovingCloth::weigh_contacts(const Vectors& x) {
  active_contacts(mesh_, candidates_.list(), x, contacts_);
  shares_.assign(candidates_.list().pairs().size(), 0.0F);
  for (const Contact& c : contacts_) shares_[c.pair] = static_cast<float>(c.share);
}

void MovingCloth::begin_step(const Vectors& x, const Vectors* strained) {
  elastic_.follow(x);
  damping_.begin(strained ? *strained : x);
  look_around(x);
  friction_.begin_step();
  bodies_.add_normal_forces(x, friction_);
  friction_.freeze(x);
  cloth_friction_.begin(mesh_, candidates_.list(), contacts_, kContactStiffness);
}

double MovingCloth::weight_energy(const Vectors& x) const {
  return parallel_sum(x.size(), 4096, 0.0, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum -= moved_.mass[i] * moved_.gravity.dot(x[i]);
    return sum;
  });
}

double MovingCloth::contact_energy_sum(const std::vector<Contact>& contacts) const {
  double sum = 0;
  for (const Contact& c : contacts) sum += c.share * contact_energy(c.distance, c.contact_distance, kContactStiffness).value;
  return sum;
}

Energies MovingCloth::assemble(const Vectors& x, const Vectors& v, double h, double time, bool with_matrix) {
  Energies e;
  look_around(x);
  if (!with_matrix) {
    matrix_.clear_added();
    e.stored = elastic_.energy_and_force(x, force_);
    e.dissipation = damping_.add_force(x, h, force_);
    e.stored += inner_.add_force(x, force_);
  } else {
    e.stored = elastic_.energy_force_hessian(x, force_, matrix_);
    e.dissipation = damping_.add_force_hessian(x, h, force_, matrix_);
    e.stored += inner_.add_force_hessian(x, force_, matrix_);
  }
  for (std::size_t i = 0; i < x.size(); ++i) force_[i] += moved_.mass[i] * moved_.gravity;
  loads_.follow(x, &v, time);
  loads_.add(force_);
  if (with_matrix) loads_.add_stiffness(matrix_);
  e.dead_loads = loads_.energy(x);
  e.stored += weight_energy(x);
  if (!constrained_) return e;
  add_contact_forces(contacts_, kContactStiffness, force_, with_matrix ? &matrix_ : nullptr, contact_stiffness_);
  cloth_friction_.add_force(x, force_, with_matrix ? &matrix_ : nullptr, with_matrix ? &contact_stiffness_ : nullptr);
  bodies_.add_forces(x, force_, matrix_);
  friction_.add_force(x, force_, with_matrix ? &matrix_ : nullptr);
  if (with_matrix && !moved_.air.still())
    for (std::size_t i = 0; i < x.size(); ++i) matrix_.add_diagonal(i, loads_.air_damping()[i] / h);
  e.stored += contact_energy_sum(contacts_) + bodies_.energy(x) + friction_.energy(x) + cloth_friction_.energy(x);
  return e;
}

Energies MovingCloth::energies(const Vectors& x, double h) {
  Energies e;
  e.stored = elastic_.energy(x) + inner_.energy(x) + weight_energy(x);
  e.dissipation = damping_.potential(x, h);
  e.dead_loads = loads_.energy(x);
  if (!constrained_) return e;
  active_contacts(mesh_, candidates_.list(), x, trial_contacts_, &shares_);
  e.stored += contact_energy_sum(trial_contacts_) + bodies_.energy(x) + friction_.energy(x) + cloth_friction_.energy(x);
  return e;
}

std::size_t MovingCloth::stop_at_bodies(const Vectors& x, Vectors& dx) {
  std::size_t changed = 0;
  for (std::size_t i = 0; !bodies_given_.empty() && i < dx.size(); ++i) {
    const double size = dx[i].norm();
    if (size <= kLeastWay) continue;
    const double most = std::max(kLeastWay, bodies_.room(i, x[i]));
    if (size <= most) continue;
    dx[i] *= most / size;
    ++changed;
  }
  return changed;
}

std::size_t MovingCloth::keep_apart(const Vectors& x, Vectors& dx) {
  const std::size_t stopped = stop_at_bodies(x, dx);
  if (!mesh_.options.self) return stopped;
  const Vectors wish = dx;
  TruncateStats cut = truncate(mesh_, candidates_.list(), x, dx);
  if (cut.out_of_reach > 0) {  // the list is too old or too short for so wide a step
    candidates_.renew(x);
    weigh_contacts(x);
    dx = wish;
    cut = truncate(mesh_, candidates_.list(), x, dx);
  }
  return stopped + cut.limited;
}

void MovingCloth::held_motion(const Vectors& x, double h, Vectors& dx) const {
  std::vector<char> begun(dx.size(), 0);
  for (std::size_t k = 0; k < moved_.hold_particle.size(); ++k) {
    const auto i = static_cast<std::size_t>(moved_.hold_particle[k]);
    const Vector3d off = holds_.error(moved_, k, x[i]);  // to where the hold is now
    Vector3d with = moved_.hold_point[k] - last_holds_[k];
    if (moved_.hold_kind[k] == model::HoldKind::plane) {
      const Vector3d n = moved_.hold_normal[k].normalized();
      with = n * n.dot(with);
      if (!begun[i]) dx[i] = holds_.filtered(i, dx[i]);
    }
    begun[i] = 1;
    const Vector3d late = off - with;
    const double size = late.norm(), most = kLateHoldSpeed * h;
    const Vector3d way = with + (size > most ? Vector3d(late * (most / size)) : late);
    if (moved_.hold_kind[k] == model::HoldKind::plane) {
      const Vector3d n = moved_.hold_normal[k].normalized();
      dx[i] += (way - dx[i]).dot(n) * n;  // not in sum: two holds may ask for the same
    } else {
      dx[i] = way;
    }
  }
}

double MovingCloth::new_contacts(const Vectors& x) {
  bodies_.pressed(x, touched_);
  for (const Contact& c : contacts_)
    for (Index p : c.p)
      if (p >= 0 && p < mesh_.n_particles) touched_[p] = 1;
  double fresh = 0, all = 0;
  for (std::size_t i = 0; i < touched_.size(); ++i) {
    all += touched_[i];
    fresh += touched_[i] && !touching_[i] ? 1 : 0;
  }
  return all > 0 ? fresh / all : 0;
}

void MovingCloth::rub(const Vectors& x, const Vectors& x0) {
  friction_.begin_step();
  bodies_.add_normal_forces(x, friction_);
  friction_.freeze(x0);
}

MovingCloth::Accepted MovingCloth::accept(const Vectors& x) {
  Accepted out;
  new_contacts(x);
  touching_ = touched_;
  if (constrained_ && !placements_.empty()) out.work_of_bodies = bodies_.work_of_motion(last_placements_, x, friction_);
  if (constrained_) out.friction_heat = friction_.follow(x) + cloth_friction_.follow(x);
  out.friction_heat += inner_.slip(x);
  bodies_.next_step();
  last_holds_ = moved_.hold_point;
  last_placements_ = placements_;
  return out;
}

double MovingCloth::body_speed(const Vectors& x, double from, double to) const {
  double most = 0;
  if (start_.motions.empty()) return 0;
  Vector3d low = Vector3d::Constant(1e300), high = -low;
  for (const Vector3d& p : x) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  low.array() -= kNearCloth;
  high.array() += kNearCloth;
  for (const model::Motion& m : start_.motions) {
    if (m.body < 0 || static_cast<std::size_t>(m.body) >= bodies_given_.size() || !(to > from)) continue;
    const model::Placement a = model::placement_at(m, from), b = model::placement_at(m, to);
    for (const Vector3d& v : bodies_given_[static_cast<std::size_t>(m.body)].mesh.vertices) {
      const Vector3d at = a.apply(v), way = b.apply(v) - at;
      const Vector3d end = at + way;
      const bool near = (at.cwiseMax(end).array() > low.array()).all() && (at.cwiseMin(end).array() < high.array()).all();
      if (near || !fine_bodies_) most = std::max(most, way.norm() / (to - from));
    }
  }
  return most;
}

Vector3d MovingCloth::body_velocity(const Push& push, const Vector3d& x, double h) const {
  if (push.body < 0 || placements_.empty() || last_placements_.empty()) return Vector3d::Zero();
  return (x - last_placements_[push.body].apply(placements_[push.body].undo(x))) / h;
}

double MovingCloth::largest_contact_stiffness() const {
  if (!constrained_) return 0;
  return (bodies_given_.empty() ? 0 : kHardening * bodies_.stiffness()) + (mesh_.options.self ? 8 * kContactStiffness : 0);
}

}  // namespace garment::simulator
