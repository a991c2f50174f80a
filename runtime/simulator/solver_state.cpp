#include "runtime/simulator/solver_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/model/archive_points.hpp"
#include "runtime/simulator/implicit_steps.hpp"
#include "runtime/simulator/moving_cloth.hpp"
#include "runtime/simulator/relaxation.hpp"

namespace garment::simulator {
namespace {

using Eigen::Vector3d;
using Vectors = std::vector<Vector3d>;

constexpr double kFarthest = 1e6;      // m
constexpr double kMostCrowded = 1000;  // particles in one place, in the mean over the particles
constexpr double kFarthestRoom = 4;    // spacings that any list of pairs reaches beyond contact

/// How many particles share a cube of this size with a particle, in the mean.
double crowd(const Vectors& x, double size) {
  std::vector<std::array<std::int64_t, 3>> place(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    for (int k = 0; k < 3; ++k) place[i][k] = static_cast<std::int64_t>(std::floor(x[i][k] / size));
  std::sort(place.begin(), place.end());
  double sum = 0;
  for (std::size_t begin = 0, end = 0; begin < place.size(); begin = end) {
    while (end < place.size() && place[end] == place[begin]) ++end;
    sum += static_cast<double>(end - begin) * static_cast<double>(end - begin);
  }
  return x.empty() ? 0 : sum / static_cast<double>(x.size());
}

}  // namespace

void keep_positions(Archive& a, Vectors& x, std::size_t n, double reach) {
  model::keep(a, x, n);
  if (!a.reading() || !a.ok()) return;
  for (const Vector3d& p : x) a.demand(p.cwiseAbs().maxCoeff() <= kFarthest);
  if (a.ok()) a.demand(crowd(x, std::max(reach, 1e-4)) <= kMostCrowded);
}

void keep(Archive& a, Tangle& tangle, const ContactMesh& mesh) {
  if (!a.length(tangle.hits, sizeof(EdgeHit))) return;
  for (EdgeHit& hit : tangle.hits) {
    a.keep(hit.edge);
    a.keep(hit.triangle);
    a.demand(hit.edge >= 0 && static_cast<std::size_t>(hit.edge) < mesh.edge.size());
    a.demand(hit.triangle >= 0 && static_cast<std::size_t>(hit.triangle) < mesh.triangle.size());
  }
  a.keep(tangle.inside);
  a.demand(tangle.inside.size() == static_cast<std::size_t>(mesh.n_particles) || tangle.empty());
  tangle.n_inside = static_cast<std::size_t>(std::count_if(tangle.inside.begin(), tangle.inside.end(), [](auto in) { return in != 0; }));
  if (!a.ok()) tangle = {};
}

void keep(Archive& a, DrapeReport& report, std::size_t n_holders) {
  a.keep(report.status, DrapeStatus::not_resumed);
  a.keep(report.steps);
  for (double* value : {&report.residual, &report.newton_step, &report.energy}) a.keep_any(*value);
  for (std::size_t* count : {&report.self_intersections, &report.body_intersections, &report.inside_body}) a.keep(*count);
  model::keep(a, report.reactions, n_holders, true);
  model::keep(a, report.moments, n_holders, true);
  MotionReport& m = report.motion;
  EnergyBalance& b = m.balance;
  a.keep(m.steps);
  a.keep(m.iterations);
  for (double* value : {&m.seconds, &m.least_step, &m.largest_step, &m.stable_step, &b.kinetic, &b.stored, &b.kinetic_start,
                        &b.stored_start, &b.work, &b.damping, &b.friction, &b.numerical})
    a.keep_any(*value);
}

// ---- what is near

/// The list is found again from the positions at which it was found.
void KeptCandidates::keep(Archive& a) {
  a.keep(known_);
  a.keep(served_);
  a.keep(room_);
  a.demand(served_ >= 0 && served_ <= kMostCounted && room_ > 0 && room_ <= kFarthestRoom * spacing_);
  if (!known_ || !a.ok()) return;
  Vectors reference = candidates_.reference();
  double radius = candidates_.radius();
  a.keep(radius);
  a.demand(radius >= 0 && radius <= (mesh_.largest_contact_distance + kFarthestRoom * spacing_) * (1 + 1e-9));
  keep_positions(a, reference, static_cast<std::size_t>(mesh_.n_particles), radius);
  if (!a.reading()) return;
  known_ = a.ok();
  if (known_) candidates_.rebuild(mesh_, reference, radius);
}

// ---- particles and bodies

void BodyContact::keep(Archive& a) {
  const std::size_t n = model_.n_particles();
  const auto bodies = static_cast<int>(bodies_.size());
  model::keep(a, extra_offset_, n);
  for (std::vector<Sounding>& of_body : soundings_)
    for (Sounding& s : of_body) {
      a.keep(s.known);
      if (!s.known) continue;
      model::keep(a, s.at);
      a.keep(s.distance);
    }
  for (std::size_t i = 0; i < memory_.size(); ++i) {
    Memory& m = memory_[i];
    a.keep(m.age);
    if (m.age < 0) continue;
    m.push.particle = i;
    for (Vector3d* v : {&m.push.normal, &m.at}) model::keep(a, *v);
    for (double* v : {&m.push.plane, &m.push.offset, &m.push.friction}) a.keep(*v);
    a.keep(m.push.foreseen);
    a.keep(m.push.body);
    a.demand(m.push.body >= -1 && m.push.body < bodies);
  }
  if (!a.length(pushes_, sizeof(std::size_t))) return;
  for (Push& p : pushes_) {
    if (a.reading()) p = {0, Vector3d::Zero(), 0, 0, 0};
    a.keep(p.particle);
    model::keep(a, p.normal);
    for (double* v : {&p.plane, &p.offset, &p.friction}) a.keep(*v);
    a.keep(p.foreseen);
    a.keep(p.body);
    a.demand(p.particle < n && p.body >= -1 && p.body < bodies);
  }
  if (!a.ok()) pushes_.clear();
}

void BodyFriction::keep(Archive& a) {
  for (Touch& t : touch_) {
    a.keep(t.anchored);
    if (!t.anchored) continue;
    model::keep(a, t.anchor);
    a.keep(t.limit);
  }
}

void ClothFriction::keep(Archive& a) {
  if (!a.length(touches_, sizeof(std::uint64_t) + sizeof(Vector3d))) return;
  for (Touch& t : touches_) {
    if (a.reading()) t = {};
    a.keep(t.key);
    model::keep(a, t.stretch);
  }
  a.demand(std::is_sorted(touches_.begin(), touches_.end(), [](const Touch& s, const Touch& t) { return s.key < t.key; }));
  if (!a.ok()) touches_.clear();
}

// ---- the linear solver

void Preconditioner::keep(Archive& a) {
  a.keep(grouped_);
  a.keep(rounded_);
  if (!grouped_ || !a.ok()) return;
  std::vector<Index> of = groups_.of;
  model::keep(a, of, pattern_.n_rows());
  if (!a.reading() || !a.ok()) return;
  const Index n_groups = of.empty() ? 0 : *std::max_element(of.begin(), of.end()) + 1;
  std::vector<Index> size(static_cast<std::size_t>(std::clamp<Index>(n_groups, 0, static_cast<Index>(of.size()))), 0);
  for (const Index g : of) {
    a.demand(g >= -1 && g < static_cast<Index>(size.size()));
    if (a.ok() && g >= 0) ++size[static_cast<std::size_t>(g)];
  }
  a.demand(std::find(size.begin(), size.end(), 0) == size.end());
  if (!a.ok()) return;
  groups_ = listed(std::move(of), static_cast<int>(size.size()));
  make_coarse_pattern();
}

void LinearSolver::keep(Archive& a) { preconditioner_.keep(a); }

void InnerFriction::keep(Archive& a) {
  bool acts = !idle_;
  a.keep(acts);
  a.demand(acts == !idle_);
  if (!acts || !a.ok()) return;
  std::vector<double> now = anchors();
  a.keep(now);
  if (a.reading() && a.ok()) a.demand(take_anchors(now));
}

// ---- the solvers

void Momentum::keep(Archive& a, std::size_t n) {
  bool moves = !way_.empty();
  a.keep(moves);
  if (moves) model::keep(a, way_, n);
  a.keep(pace_);
  a.keep_any(energy_);
  a.demand(pace_ >= 1);
}

void Relaxation::keep(Archive& a) {
  const std::size_t n = model_.n_particles();
  double tensile_scale = elastic_.tensile_scale();
  for (double* value : {&settings_.gravity_scale, &tensile_scale, &time_step_}) a.keep(*value);
  a.demand(tensile_scale > 0 && tensile_scale <= 1 && time_step_ > 1e-6 && time_step_ < 1e3);
  model::keep(a, damping_, n);
  model::keep(a, turns_, n);
  for (const int turns : turns_) a.demand(turns >= 0 && turns < kMostCounted);
  model::keep(a, last_motion_, n);
  momentum_.keep(a, n);
  simulator::keep(a, tangle_, mesh_);
  bodies_.keep(a);
  friction_.keep(a);
  cloth_friction_.keep(a);
  inner_.keep(a);
  linear_.keep(a);
  candidates_.keep(a);
  if (!a.reading() || !a.ok()) return;
  elastic_.set_tensile_scale(tensile_scale);
  if (candidates_.known()) candidates_.list().exempt(mesh_, tangle_);
}

void MovingCloth::keep(Archive& a, double time) {
  if (a.reading()) {
    go_to(time);
    last_placements_ = placements_;
    last_holds_ = moved_.hold_point;
  }
  if (a.length(touching_, 1)) a.numbers(touching_.data(), touching_.size());
  a.demand(touching_.size() == moved_.n_particles());
  bodies_.keep(a);
  friction_.keep(a);
  cloth_friction_.keep(a);
  inner_.keep(a);
  linear_.keep(a);
  candidates_.keep(a);
  a.keep(looked_);
  if (!looked_) return;
  keep_positions(a, looked_at_, moved_.n_particles(), kSelfOffset);
  looked_ = looked_ && a.ok();
  if (a.reading() && looked_) weigh_contacts(looked_at_);
}

void ImplicitSteps::keep(Archive& a) {
  a.keep(flies_);
  a.keep(euler_steps_);
  a.demand(euler_steps_ >= 0 && euler_steps_ <= kMostCounted);
}

}  // namespace garment::simulator
