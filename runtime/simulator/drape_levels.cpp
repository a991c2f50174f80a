#include "runtime/simulator/drape_levels.hpp"

#include <algorithm>

#include "runtime/simulator/prolong.hpp"

namespace garment::simulator {
namespace {

constexpr int kMostCoarseSteps = 250;  // a coarse garment that is not near rest by then hangs in its grid

}  // namespace

DrapeReport drape_levels(const std::vector<model::Model>& coarse, const model::Model& model,
                         const std::vector<body::Body>& bodies, model::State& state, const DrapeSettings& settings) {
  const model::Model* from = nullptr;
  std::vector<model::Vector3d> positions;
  int steps = 0;
  for (const model::Model& level : coarse) {
    model::State on_level;
    on_level.position = from ? prolong(*from, positions, level) : level.start;
    DrapeSettings rough = settings;
    // A coarse garment only has to find the folds; the fine one comes to rest.
    rough.settle = Settle::preview;
    rough.near_rest = from != nullptr;
    rough.certify = false;
    rough.hysteresis = false;
    rough.max_steps = std::min(std::max(1, settings.max_steps - steps), kMostCoarseSteps);
    DrapeReport report = drape(level, bodies, on_level, rough);
    steps += report.steps;
    if (report.status == DrapeStatus::interrupted) {
      state.position = prolong(level, on_level.position, model);
      state.velocity.assign(model.n_particles(), model::Vector3d::Zero());
      report.steps = steps;
      return report;
    }
    // What a coarse cloth cuts off a body the finer one mends; what it ties into knots stays tied.
    if (report.status == DrapeStatus::diverged || report.self_intersections > 0) continue;
    from = &level;
    positions = std::move(on_level.position);
  }
  if (from) state.position = prolong(*from, positions, model);
  DrapeSettings fine = settings;
  fine.near_rest = settings.near_rest || from != nullptr;
  fine.max_steps = std::max(1, settings.max_steps - steps);
  DrapeReport report = drape(model, bodies, state, fine);
  report.steps += steps;
  return report;
}

}  // namespace garment::simulator
