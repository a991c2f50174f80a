#include "runtime/simulator/culprit.hpp"

#include <algorithm>
#include <limits>

namespace garment::simulator {

Culprit panel_with_most(const model::Model& model, const std::vector<model::Vector3d>& per_particle) {
  if (model.panels.empty()) return {"the garment", {}};
  std::vector<double> sum(model.panels.size(), 0);
  for (std::size_t v = 0; v < model.n_vertices(); ++v) {
    const auto i = static_cast<std::size_t>(model.vertex_particle[v]);
    if (i >= per_particle.size()) continue;
    const model::Vector3d& p = per_particle[i];
    sum[model.vertex_panel[v]] += p.allFinite() ? p.squaredNorm() : std::numeric_limits<double>::infinity();
  }
  const model::PanelRange& panel = model.panels[std::max_element(sum.begin(), sum.end()) - sum.begin()];
  return {"`" + panel.name + "`", panel.origin};
}

Finding infinite_positions(const model::Model& model, const std::vector<model::Vector3d>& x) {
  const Culprit panel = panel_with_most(model, x);
  return {"G0803", Severity::error, "positions of " + panel.name + " became infinite; the last finite state was kept",
          {{panel.origin, "it begins here"}}, "check the fabric for extreme stiffness or density, and the resolution"};
}

}  // namespace garment::simulator
