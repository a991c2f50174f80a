#include "runtime/simulator/body_contact.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/base/parallel.hpp"
#include "runtime/simulator/contact_stiffness.hpp"

namespace garment::simulator {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vectors = std::vector<Vector3d>;

constexpr double kOnset = 1e-4;          // m, depth at which a push has its whole stiffness
constexpr double kLastGap = 3e-4;        // m from the body, where it hardens
constexpr double kSearch = 0.25;         // m, how deep inside a body a particle may start

// Surfaces that face each other.
constexpr double kFacing = -0.5;         // largest cosine between their normals
constexpr double kShareOfRoom = 0.45;    // of the room between them, that each may keep free
constexpr double kLeastOffset = 4e-4;    // m, that each keeps free all the same
constexpr double kLeastPassage = 3e-3;      // m, narrower places are shut to cloth
constexpr double kLeastWidening = 0.1;   // m per m, below it a narrow place has no mouth
constexpr int kRemembered = 40;          // steps
constexpr double kRememberedWay = 2e-3;  // m
constexpr double kDeepestWedge = 5e-3;   // m, by which a particle is pushed to the mouth in one go

}  // namespace

PushLaw::PushLaw(double depth, double offset, double k) {
  if (depth <= 0) return;
  if (depth < kOnset) {
    stiffness = k * depth / kOnset;
    force = stiffness * depth / 2;
    energy = force * depth / 3;
    return;
  }
  stiffness = k;
  force = k * (depth - kOnset / 2);
  energy = k / 2 * (depth * (depth - kOnset) + kOnset * kOnset / 3);
  const double in = depth - std::max(kOnset, offset - kLastGap), beyond = std::max(0.0, in - 2 * kLastGap);
  if (in <= 0) return;
  const double hard = (kHardening - 1) * k;
  force += hard * (in - beyond);
  energy += hard * (in - beyond) * ((in - beyond) / 2 + beyond);
  if (beyond == 0) stiffness += hard;
}

BodyContact::BodyContact(const model::Model& model, const std::vector<body::Body>& bodies, double spacing,
                         const BodyContactSettings& settings)
    : model_(model),
      bodies_(bodies),
      offset_(settings.offset),
      stiffness_(settings.stiffness * spacing * spacing),
      extra_offset_(model.n_particles(), 0),
      padding_(model.n_particles(), 0),
      memory_(model.n_particles()),
      soundings_(bodies.size(), std::vector<Sounding>(model.n_particles())) {
  for (std::size_t k = 0; k < model.pad_particle.size(); ++k) padding_[model.pad_particle[k]] = model.pad_thickness[k];
  for (const body::Body& body : bodies) {
    std::vector<double>& of_body = friction_.emplace_back(model.n_particles());
    for (std::size_t i = 0; i < of_body.size(); ++i) of_body[i] = std::sqrt(body.friction * model.friction[i]);
  }
  for (std::size_t k = 0; k < model.rub_particle.size(); ++k)
    if (static_cast<std::size_t>(model.rub_body[k]) < friction_.size())
      friction_[model.rub_body[k]][model.rub_particle[k]] = model.rub_factor[k];
}

double BodyContact::least_distance() const {
  double least = 1e300;
  for (std::size_t i = 0; i < padding_.size(); ++i)
    least = std::min(least, offset_ + extra_offset_[i] + model_.thickness[i] / 2 + padding_[i]);
  return least;
}

void BodyContact::find(const Vectors& x) {
  pushes_.clear();
  narrow_.clear();
  for (std::size_t b = 0; b < bodies_.size(); ++b) find_of(b, x);
  if (bodies_.size() > 1)
    std::stable_sort(pushes_.begin(), pushes_.end(), [](const Push& a, const Push& b) { return a.particle < b.particle; });
  for (std::size_t begin = 0, end = 0; begin < pushes_.size(); begin = end) {
    while (end < pushes_.size() && pushes_[end].particle == pushes_[begin].particle) ++end;
    if (end - begin > 1) give_room(x, begin, end);
  }
  remember_narrow(x);
  pushes_.insert(pushes_.end(), narrow_.begin(), narrow_.end());
}

/// At the mouth of a narrow place one of its sides is no longer the nearest of its surroundings: the place would be found
/// and lost in turns. Its last plane therefore stays for a while.
void BodyContact::remember_narrow(const Vectors& x) {
  for (Memory& m : memory_)
    if (m.age > kRemembered || (m.age >= 0 && (x[m.push.particle] - m.at).norm() > kRememberedWay)) m.age = -1;
  std::vector<char> found(memory_.size(), 0);
  for (const Push& p : narrow_) {
    memory_[p.particle] = {p, x[p.particle], 0};
    found[p.particle] = 1;
  }
  for (std::size_t i = 0; i < memory_.size(); ++i)
    if (memory_[i].age >= 0 && !found[i]) narrow_.push_back(memory_[i].push);
}

void BodyContact::copy(std::size_t i, const BodyContact& other, std::size_t at) {
  extra_offset_[i] = other.extra_offset_[at];
  memory_[i] = other.memory_[at];
  memory_[i].push.particle = i;
  for (std::size_t b = 0; b < soundings_.size(); ++b) soundings_[b][i] = other.soundings_[b][at];
}

void BodyContact::next_step() {
  for (Memory& m : memory_)
    if (m.age >= 0) ++m.age;
}

/// Distance falls by no more than the way moved, so a particle that was far away need not be asked again until it may
/// have come near; one that was near is searched for only as far as it can have gone.
void BodyContact::find_of(std::size_t b, const Vectors& x) {
  const body::Body& body = bodies_[b];
  std::vector<Sounding>& soundings = soundings_[b];
  const model::Placement* moved_by = placements_.empty() || placements_[b].is_identity() ? nullptr : &placements_[b];
  found_.resize(x.size());
  parallel_for(x.size(), 256, [&](std::size_t begin, std::size_t end) {
    std::vector<body::SurfacePoint> others;
    for (std::size_t i = begin; i < end; ++i) {
      Pushes& out = found_[i];
      out.n = 0;
      const double offset = offset_ + extra_offset_[i] + model_.thickness[i] / 2 + padding_[i];
      Sounding& last = soundings[i];
      const Vector3d at = moved_by ? moved_by->undo(x[i]) : x[i];
      const double moved = last.known ? (at - last.at).norm() : 0;
      if (last.known && last.distance - moved > 2 * offset) continue;
      const double reach = last.known ? std::min(kSearch, std::abs(last.distance) + moved + 1e-6) : kSearch;
      auto hit = body.closest(at, reach);
      if (!hit && reach < kSearch) hit = body.closest(at, kSearch);
      last = {at, hit ? hit->distance : kSearch, true};
      if (!hit || hit->distance >= 2 * offset) continue;
      const double friction = friction_[b][i];
      auto add = [&](const body::SurfacePoint& s) {
        const Vector3d way = moved_by ? Vector3d(moved_by->turn * s.push) : s.push;
        if (out.n < static_cast<int>(out.push.size()))
          out.push[out.n++] = {i, way, way.dot(x[i]) - s.distance, offset, friction, false, static_cast<int>(b)};
      };
      add(*hit);
      body.facing(at, 2 * offset, *hit, others);
      for (const body::SurfacePoint& s : others) add(s);
    }
  });
  for (const Pushes& p : found_) pushes_.insert(pushes_.end(), p.push.begin(), p.push.begin() + p.n);
}

/// Where surfaces face each other (thighs that nearly touch) the offset shrinks to what room there is: pushed from both
/// sides, cloth would jam. And cloth stays out of places too narrow for it: the room d1 + d2 grows along n1 + n2, so what
/// was drawn into a wedge is pushed towards its mouth.
void BodyContact::give_room(const Vectors& x, std::size_t begin, std::size_t end) {
  for (std::size_t a = begin; a < end; ++a)
    for (std::size_t b = a + 1; b < end; ++b) {
      Push &p = pushes_[a], &q = pushes_[b];
      if (p.normal.dot(q.normal) > kFacing) continue;
      auto distance = [&](const Push& push) { return push.normal.dot(x[push.particle]) - push.plane; };
      const double room = std::max(0.0, distance(p) + distance(q));
      const double most = std::max(kLeastOffset, kShareOfRoom * room);
      p.offset = std::min(p.offset, most);
      q.offset = std::min(q.offset, most);
      const Vector3d widening = p.normal + q.normal;
      const double rate = widening.norm();
      const double least = kLeastPassage + 2 * extra_offset_[p.particle];
      if (room > least || rate < kLeastWidening) continue;
      const double depth = std::min((least - room) / rate, kDeepestWedge), offset = 2 * kDeepestWedge;
      const Vector3d out = widening / rate;
      narrow_.push_back({p.particle, out, out.dot(x[p.particle]) - offset + depth, offset, p.friction, false, p.body});
    }
}

double BodyContact::energy(const Vectors& x) const {
  double sum = 0;
  for (const Push& p : pushes_) sum += PushLaw(p.depth(x), p.offset, stiffness_).energy;
  return sum;
}

void BodyContact::add_forces(const Vectors& x, Vectors& force, BlockMatrix& matrix) const {
  for (const Push& p : pushes_) {
    const double depth = p.depth(x);
    if (depth <= 0) continue;
    const PushLaw law(depth, p.offset, stiffness_);
    force[p.particle] += law.force * p.normal;
    matrix.add_diagonal(p.particle, Matrix3d(law.stiffness * p.normal * p.normal.transpose()));
  }
}

void BodyContact::add_normal_forces(const Vectors& x, BodyFriction& friction) const {
  for (const Push& p : pushes_) {
    const double depth = p.depth(x);
    if (depth > 0) friction.add_normal_force(p.particle, PushLaw(depth, p.offset, stiffness_).force * p.normal, p.friction);
  }
}

void BodyContact::place(const std::vector<model::Placement>& placements, BodyFriction& friction) {
  const std::vector<model::Placement> before =
      placements_.empty() ? std::vector<model::Placement>(bodies_.size()) : placements_;
  placements_ = placements;
  std::size_t last = static_cast<std::size_t>(-1);
  for (const Push& p : pushes_) {
    if (p.particle == last || p.body < 0) continue;
    last = p.particle;
    const model::Placement &from = before[p.body], &to = placements_[p.body];
    friction.carry(p.particle, [&](const Vector3d& anchor) { return to.apply(from.undo(anchor)); });
  }
}

double BodyContact::work_of_motion(const std::vector<model::Placement>& before, const Vectors& x,
                                   const BodyFriction& friction) const {
  double work = 0;
  std::size_t last = static_cast<std::size_t>(-1);
  for (const Push& p : pushes_) {
    const double depth = p.depth(x);
    if (depth <= 0 || p.body < 0 || placements_.empty()) continue;
    const Vector3d way = x[p.particle] - before[p.body].apply(placements_[p.body].undo(x[p.particle]));
    work += PushLaw(depth, p.offset, stiffness_).force * p.normal.dot(way);
    if (p.particle != last) work += friction.force_on(p.particle, x[p.particle]).dot(way);
    last = p.particle;
  }
  return work;
}

void BodyContact::pressed(const Vectors& x, std::vector<char>& out) const {
  out.assign(x.size(), 0);
  for (const Push& p : pushes_)
    if (p.depth(x) > 0) out[p.particle] = 1;
}

double BodyContact::room(std::size_t i, const Vector3d& x) const {
  double least = kSearch;
  for (std::size_t b = 0; b < soundings_.size(); ++b) {
    const Sounding& last = soundings_[b][i];
    if (!last.known) return 0;
    const Vector3d at = placements_.empty() ? x : placements_[b].undo(x);
    least = std::min(least, last.distance - (at - last.at).norm());
  }
  return std::max(0.0, least);
}

std::size_t BodyContact::foresee(const Vectors& x, const Vectors& dx, const Holds& holds, Vectors& force,
                                 BlockMatrix& matrix) {
  std::size_t fresh = 0;
  for (Push& p : pushes_) {
    const double depth = p.depth(x);
    if (depth > 0 || p.foreseen || depth - p.normal.dot(dx[p.particle]) < kForeseenDepth) continue;
    p.foreseen = true;
    ++fresh;
    matrix.add_diagonal(p.particle, Matrix3d(stiffness_ * p.normal * p.normal.transpose()));
    force[p.particle] += holds.filtered(p.particle, Vector3d(stiffness_ * depth * p.normal));
  }
  return fresh;
}

}  // namespace garment::simulator
