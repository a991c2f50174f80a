#include "interpreter/session/changes.hpp"

#include <algorithm>

namespace garment::session {
namespace {

using model::Index;
using model::PanelRange;

const PanelRange* find_panel(const model::Model& model, const std::string& name) {
  for (const PanelRange& panel : model.panels)
    if (panel.name == name) return &panel;
  return nullptr;
}

bool same_grid(const model::Model& a, const PanelRange& in_a, const model::Model& b, const PanelRange& in_b) {
  if (in_a.n_vertices != in_b.n_vertices || in_a.n_triangles != in_b.n_triangles) return false;
  for (Index k = 0; k < in_a.n_vertices; ++k)
    if (a.vertex_uv[in_a.first_vertex + k] != b.vertex_uv[in_b.first_vertex + k]) return false;
  for (Index t = 0; t < in_a.n_triangles; ++t)
    for (int c = 0; c < 3; ++c)
      if (a.triangle[in_a.first_triangle + t][c] - in_a.first_vertex !=
          b.triangle[in_b.first_triangle + t][c] - in_b.first_vertex)
        return false;
  return true;
}

}  // namespace

PanelChanges compare_panels(const model::Model& before, const model::Model& now) {
  PanelChanges changes;
  for (const PanelRange& panel : now.panels) {
    const PanelRange* was = find_panel(before, panel.name);
    const bool same = was != nullptr && same_grid(before, *was, now, panel);
    (same ? changes.kept : changes.meshed).push_back(panel.name);
  }
  for (const PanelRange& panel : before.panels)
    if (find_panel(now, panel.name) == nullptr) changes.gone.push_back(panel.name);
  return changes;
}

std::string listed(const std::vector<std::string>& names, std::size_t most) {
  std::string text;
  for (std::size_t k = 0; k < std::min(most, names.size()); ++k) text += (k > 0 ? ", " : "") + names[k];
  if (names.size() > most) text += " and " + std::to_string(names.size() - most) + " more";
  return text;
}

}  // namespace garment::session
