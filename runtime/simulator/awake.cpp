#include "runtime/simulator/awake.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/model/part.hpp"
#include "runtime/simulator/candidates.hpp"

namespace garment::simulator {
namespace {

using Vectors = std::vector<Vector3d>;

constexpr double kAwake = 3e-5;        // m in one step
constexpr int kRings = 2;              // of particles about those that go along
constexpr double kLittle = 0.1;        // of the particles
constexpr double kLittleWithSleeping = 0.15;  // the same with the sleeping ones about them
constexpr int kMostSteps = 30;
constexpr double kLeash = 0.25;        // cells that a particle may go before it could meet what was left out
constexpr double kSettled = 0.3;       // of the target: what a part then adds to the residual counts no more
constexpr double kSettledStep = 1e-4;  // m

std::size_t count(const std::vector<char>& marks) { return static_cast<std::size_t>(std::count(marks.begin(), marks.end(), 1)); }

}  // namespace

Awake::Awake(const model::Model& model, const std::vector<body::Body>& bodies, const Mirror& mirror, const Relaxation& whole)
    : model_(model), bodies_(bodies), mirror_(mirror), mesh_(whole.mesh()) {
  for (std::size_t t = 0; t < model.n_triangles(); ++t) {
    const auto c = model.corners(t);
    if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) triangle_.push_back(t);
  }
}

std::vector<char> Awake::moving(const Vectors& before, const Vectors& x) const {
  std::vector<char> free(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) free[i] = (x[i] - before[i]).squaredNorm() > kAwake * kAwake ? 1 : 0;
  mirror_.spread(free);
  for (int ring = 0; ring < kRings; ++ring) {
    std::vector<char> wider = free;
    for (const auto& e : mesh_.edge)
      if (free[e[0]] != 0 || free[e[1]] != 0) wider[e[0]] = wider[e[1]] = 1;
    free.swap(wider);
  }
  return free;
}

/// Triangles of sleeping cloth that what is free may come to touch before it has gone as far as `leash`.
std::vector<char> Awake::near(const std::vector<char>& free, const Vectors& x, double leash) const {
  std::vector<char> marks(model_.n_triangles(), 0);
  if (!mesh_.options.self) return marks;
  Candidates list;
  list.rebuild(mesh_, x, mesh_.largest_contact_distance + leash);
  auto moves = [&](const auto& points) { return std::any_of(points.begin(), points.end(), [&](Index p) { return free[p] != 0; }); };
  auto mark = [&](Index t) { marks[triangle_[static_cast<std::size_t>(t)]] = 1; };
  for (std::size_t k = list.begin(PairKind::cloth_vt); k < list.end(PairKind::cloth_vt); ++k) {
    const Pair& pair = list.pairs()[k];
    if (free[pair.a] != 0)
      mark(pair.b);
    else if (moves(mesh_.triangle[pair.b]))
      mark(mesh_.point_triangles[pair.a][0]);
  }
  for (std::size_t k = list.begin(PairKind::cloth_ee); k < list.end(PairKind::cloth_ee); ++k) {
    const Pair& pair = list.pairs()[k];
    if (moves(mesh_.edge[pair.a])) mark(mesh_.edge_triangles[pair.b][0]);
    if (moves(mesh_.edge[pair.b])) mark(mesh_.edge_triangles[pair.a][0]);
  }
  return marks;
}

int Awake::settle(Relaxation& whole, const Vectors& before, double target, Vectors& x) const {
  auto share = [&](double of) { return static_cast<std::size_t>(of * static_cast<double>(x.size())); };
  const std::vector<char> free = moving(before, x);
  if (const std::size_t n = count(free); n == 0 || n > share(kLittle)) return 0;
  const double leash = kLeash * mean_edge(model_);
  const model::Part part = model::part_of(model_, free, near(free, x, leash), x);
  if (part.particle.size() > share(kLittleWithSleeping)) return 0;
  Relaxation own(part.model, bodies_, whole.settings());
  own.borrow(whole, part.particle);
  own.keep_even(mirror_.of_part(part.particle, part.free));
  own.keep_near(part.model.start, leash);
  Vectors at = part.model.start;
  // What the part adds to the residual of the whole.
  const double part_of_residual = std::sqrt(static_cast<double>(at.size()) / static_cast<double>(x.size())) * own.rms_weight() / whole.rms_weight();
  int steps = 0;
  while (steps < kMostSteps) {
    own.coast(at);
    const StepReport step = own.step(at);
    ++steps;
    if (!step.accepted || own.at_leash() || (part_of_residual * step.residual < kSettled * target && step.newton_step < kSettledStep)) break;
  }
  for (std::size_t k = 0; k < at.size(); ++k)
    if (part.free[k] != 0) x[static_cast<std::size_t>(part.particle[k])] = at[k];
  own.give_back(whole, part.particle, part.free);
  return steps;
}

}  // namespace garment::simulator
