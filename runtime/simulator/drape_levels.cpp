#include "runtime/simulator/drape_levels.hpp"

#include <algorithm>

#include "runtime/simulator/prolong.hpp"
#include "runtime/simulator/solver_state.hpp"

namespace garment::simulator {
namespace {

constexpr int kMostCoarseSteps = 250;  // a coarse garment that is not near rest by then hangs in its grid

/// How far a drape from coarse to fine has come.
struct Descent {
  std::size_t level = 0;  // of the coarse models, then the fine one
  int from = -1;          // level that `positions` are of; -1: none
  int steps = 0;          // on the levels before
  std::vector<model::Vector3d> positions;

  void keep(Archive& a, const std::vector<model::Model>& coarse) {
    a.keep(level);
    a.keep(from);
    a.keep(steps);
    a.demand(level <= coarse.size() && from >= -1 && from < static_cast<int>(level) && steps >= 0 && steps <= kMostCounted);
    if (!a.ok() || from < 0) return;
    const model::Model& at = coarse[static_cast<std::size_t>(from)];
    keep_positions(a, positions, at.n_particles(), 0);
  }
};

/// The checkpoints of the drape on one level: what it keeps goes behind how far the levels have come.
Checkpoints on_level(const Checkpoints& all, Descent& descent, const std::vector<model::Model>& coarse, std::string_view resume) {
  Checkpoints own;
  own.resume = resume;
  if (!all.keep) return own;
  own.due = all.due;
  own.keep = [&](const std::string& state) {
    Archive a;
    descent.keep(a, coarse);
    all.keep(a.take() + state);
  };
  return own;
}

}  // namespace

DrapeSettings on_coarse_grid(const DrapeSettings& settings, int steps_left) {
  DrapeSettings rough = settings;
  rough.settle = Settle::preview;
  rough.certify = false;
  rough.hysteresis = false;
  rough.max_steps = std::min(std::max(1, steps_left), kMostCoarseSteps);
  return rough;
}

bool found_folds(const DrapeReport& coarse, const DrapeSettings& settings) {
  return coarse.status != DrapeStatus::diverged && (coarse.self_intersections == 0 || !settings.self_collision);
}

DrapeReport drape_levels(const std::vector<model::Model>& coarse, const model::Model& model,
                         const std::vector<body::Body>& bodies, model::State& state, const DrapeSettings& settings) {
  Descent d;
  std::string_view resume;
  if (!settings.checkpoints.resume.empty()) {
    Archive a(settings.checkpoints.resume);
    d.keep(a, coarse);
    resume = a.rest();
    if (!a.ok() || resume.empty()) return not_resumed();
  }
  for (; d.level < coarse.size(); ++d.level, resume = {}) {
    const model::Model& level = coarse[d.level];
    model::State on_grid;
    on_grid.position = d.from >= 0 ? prolong(coarse[static_cast<std::size_t>(d.from)], d.positions, level) : level.start;
    DrapeSettings rough = on_coarse_grid(settings, settings.max_steps - d.steps);
    rough.near_rest = d.from >= 0;
    rough.checkpoints = on_level(settings.checkpoints, d, coarse, resume);
    DrapeReport report = drape(level, bodies, on_grid, rough);
    if (report.status == DrapeStatus::not_resumed) return report;
    d.steps += report.steps;
    if (report.status == DrapeStatus::interrupted) {
      state.position = prolong(level, on_grid.position, model);
      state.velocity.assign(model.n_particles(), model::Vector3d::Zero());
      report.steps = d.steps;
      return report;
    }
    if (!found_folds(report, settings)) continue;
    d.from = static_cast<int>(d.level);
    d.positions = std::move(on_grid.position);
  }
  if (d.from >= 0) state.position = prolong(coarse[static_cast<std::size_t>(d.from)], d.positions, model);
  DrapeSettings fine = settings;
  fine.near_rest = settings.near_rest || d.from >= 0;
  fine.max_steps = std::max(1, settings.max_steps - d.steps);
  fine.checkpoints = on_level(settings.checkpoints, d, coarse, resume);
  DrapeReport report = drape(model, bodies, state, fine);
  report.steps += d.steps;
  return report;
}

}  // namespace garment::simulator
