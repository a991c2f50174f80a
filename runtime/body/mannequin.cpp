#include "runtime/body/mannequin.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/body/mesh_repair.hpp"
#include "runtime/body/surface_nets.hpp"

namespace garment::body {
namespace {

constexpr double kCell = 0.0115;       // m, edge of the cubes: the mesh's edges come out about as long
constexpr double kGirthGoal = 0.0003;  // m
constexpr int kFieldRounds = 12, kMeshRounds = 6, kMeshAttempts = 4;
constexpr double kGirthPerBreast = 1.3;  // rise of the bust girth with the distance the breasts stand out
constexpr double kLeastBreast = 0.004, kMostBreast = 0.25;  // m

/// Turns every knob by what its girth is off; returns the largest difference.
template <class Girth>
double adjust(Figure& figure, const Girth& girth_at) {
  double worst = 0;
  std::vector<double> girth;
  for (const Tape& tape : figure.tapes()) girth.push_back(girth_at(tape));
  for (std::size_t i = 0; i < girth.size(); ++i) {
    Tape& tape = figure.tapes()[i];
    double missing = tape.target - girth[i];
    worst = std::max(worst, std::fabs(missing));
    if (girth[i] <= 0) continue;
    if (tape.additive)
      tape.knob = std::clamp(tape.knob + missing / kGirthPerBreast, kLeastBreast, kMostBreast);
    else
      tape.knob = std::clamp(tape.knob * tape.target / girth[i], 0.3, 3.0);
  }
  figure.rebuild();
  return worst;
}

/// Puts the soles on y = 0; returns by how much they were above it.
double stand(HalfSurface& half) {
  double low = 1;
  for (const Vector3d& p : half.vertices) low = std::min(low, p.y());
  for (Vector3d& p : half.vertices) p.y() -= low;
  return low;
}

}  // namespace

double tape_girth(const TriangleMesh& mesh, const Figure& figure, const Tape& tape) {
  Plane plane = figure.tape_plane(tape);
  double best = 0, best_distance = 0.08;
  for (const Loop& loop : slice(mesh, plane)) {
    double distance = loop_centroid(loop).norm();
    if (distance >= best_distance) continue;
    best_distance = distance;
    best = perimeter(convex_hull(loop));
  }
  return best;
}

MannequinResult build_mannequin(const FigureMeasures& measures) {
  Figure figure(measures);
  for (int round = 0; round < kFieldRounds; ++round)
    if (adjust(figure, [&](const Tape& t) { return figure.field_girth(t); }) < kGirthGoal) break;
  Field field = [&figure](const Vector3d& p) { return figure.field(p); };
  Vector3d low = figure.low();
  HalfSurface half;
  double cell = kCell;
  for (int attempt = 0; attempt < kMeshAttempts; ++attempt, cell *= 0.93) {
    // Where two sheets pass through one cube they touch in an edge; other cubes part them.
    half = surface_nets(field, low.y(), low.z(), figure.high(), cell);
    if (check_surface(mirror(half)).crowded_edges == 0) break;
  }
  MannequinResult result;
  for (int round = 0;; ++round) {
    // A mesh lies inside the curved skin between its vertices: the girths are solved on the mesh itself.
    result.mesh = mirror(half);
    result.worst = 0;
    for (const Tape& tape : figure.tapes()) {
      double off = std::fabs(tape_girth(result.mesh, figure, tape) - tape.target);
      if (off > result.worst) result.worst = off, result.worst_tape = tape;
    }
    if (result.worst < kGirthGoal || round == kMeshRounds) break;
    adjust(figure, [&](const Tape& t) { return tape_girth(result.mesh, figure, t); });
    project(half, field, 2);
  }
  for (const Tape& tape : figure.tapes())
    result.levels[tape.level] = {figure.tape_plane(tape).origin.y(), tape_girth(result.mesh, figure, tape)};
  double above = stand(half);
  for (auto& [name, level] : result.levels) level.height -= above;
  result.mesh = mirror(half);
  return result;
}

}  // namespace garment::body
