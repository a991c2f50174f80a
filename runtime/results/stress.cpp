#include "runtime/results/stress.hpp"

#include <algorithm>
#include <vector>

#include "runtime/simulator/tensile_table.hpp"

namespace garment::results {

std::optional<double> largest_tension(const model::Model& model, const model::State& state, const std::string& panel) {
  model::Index wanted = -1;
  for (std::size_t p = 0; p < model.panels.size(); ++p)
    if (model.panels[p].name == panel) wanted = static_cast<model::Index>(p);
  if (!panel.empty() && wanted < 0) return std::nullopt;
  std::vector<simulator::TensileTable> laws;
  for (const model::TensileLaw& law : model.laws) laws.emplace_back(law);
  const std::vector<model::Vector3d>& x = state.position;
  double most = 0;
  for (std::size_t s = 0; s < model.spring.size(); ++s) {
    if (wanted >= 0 && model.spring_panel[s] != wanted) continue;
    const double length = (x[model.spring[s][1]] - x[model.spring[s][0]]).norm();
    most = std::max(most, laws[model.spring_law[s]].at(length / model.spring_rest[s] - 1).force);
  }
  for (std::size_t k = 0; k < model.membrane.size(); ++k) {
    if (wanted >= 0 && model.membrane_panel[k] != wanted) continue;
    for (int d = 0; d < 2; ++d) {
      model::Vector3d along = model::Vector3d::Zero();
      for (int j = 0; j < 3; ++j) along += model.membrane_weights[k][3 * d + j] * x[model.membrane[k][j]];
      most = std::max(most, laws[model.membrane_law[k][d]].at(along.norm() - 1).force);
    }
  }
  return most;
}

}  // namespace garment::results
