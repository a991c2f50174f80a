#include "runtime/simulator/drape_again.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/simulator/drape_levels.hpp"
#include "runtime/simulator/prolong.hpp"

namespace garment::simulator {
namespace {

using model::Vector3d;
using Vectors = std::vector<Vector3d>;

constexpr double kMuch = 0.03;  // stretch or squeeze of a spring
constexpr double kMany = 0.30;  // share of the springs, beyond that at rest

}  // namespace

double strained_share(const model::Model& model, const Vectors& position) {
  std::size_t n = 0;
  for (std::size_t s = 0; s < model.spring.size(); ++s) {
    const double length = (position[model.spring[s][0]] - position[model.spring[s][1]]).norm();
    n += std::abs(length / model.spring_rest[s] - 1) > kMuch ? 1 : 0;
  }
  return model.spring.empty() ? 0 : static_cast<double>(n) / static_cast<double>(model.spring.size());
}

bool far_from_rest(const model::Model& model, const Vectors& position, double at_rest) {
  return strained_share(model, position) > at_rest + kMany;
}

DrapeReport drape_again(const std::vector<model::Model>& coarse, const model::Model& model,
                        const std::vector<body::Body>& bodies, model::State& state,
                        const DrapeSettings& settings) {
  int steps = 0;
  for (const model::Model& level : coarse) {
    model::State on_level;
    on_level.position = prolong(model, state.position, level);
    const Vectors before = prolong(level, on_level.position, model);
    DrapeSettings rough = on_coarse_grid(settings, settings.max_steps);
    rough.near_rest = true;
    const DrapeReport report = drape(level, bodies, on_level, rough);
    steps += report.steps;
    if (report.status == DrapeStatus::interrupted) {  // the fine garment as it lies is consistent
      state.velocity.assign(model.n_particles(), Vector3d::Zero());
      DrapeReport stopped = report;
      stopped.steps = steps;
      return stopped;
    }
    if (!found_folds(report, settings)) continue;
    const Vectors after = prolong(level, on_level.position, model);
    for (std::size_t i = 0; i < state.position.size(); ++i) state.position[i] += after[i] - before[i];
  }
  DrapeSettings fine = settings;
  fine.near_rest = true;
  DrapeReport report = drape(model, bodies, state, fine);
  report.steps += steps;
  return report;
}

}  // namespace garment::simulator
