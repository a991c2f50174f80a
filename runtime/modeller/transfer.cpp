#include "runtime/modeller/transfer.hpp"

#include <array>

#include "runtime/base/parallel.hpp"
#include "runtime/model/flat_index.hpp"
#include "runtime/modeller/pattern_warp.hpp"

namespace garment::modeller {
namespace {

using model::Index;
using model::Vector3d;

/// Of a vertex of the new model.
struct OldPlace {
  Vector3d at = Vector3d::Zero();
  Index exact = -1;  ///< old particle that lies here
  bool known = false;
};

/// Do both panels have the same vertices in the same order?
bool same_grid(const model::Model& a, const model::PanelRange& in_a, const model::Model& b,
               const model::PanelRange& in_b) {
  if (in_a.n_vertices != in_b.n_vertices || in_a.n_triangles != in_b.n_triangles) return false;
  for (Index k = 0; k < in_a.n_vertices; ++k)
    if (a.vertex_uv[in_a.first_vertex + k] != b.vertex_uv[in_b.first_vertex + k]) return false;
  return true;
}

void carry_old_panel(const ModelledGarment& before, Index old, const std::vector<Vector3d>& position,
                     const ModelledGarment& now, Index panel, std::vector<OldPlace>& places) {
  const model::PanelRange &was = before.model.panels[old], &is = now.model.panels[panel];
  if (same_grid(before.model, was, now.model, is)) {
    for (Index k = 0; k < is.n_vertices; ++k) {
      const Index particle = before.model.vertex_particle[was.first_vertex + k];
      places[is.first_vertex + k] = {position[particle], particle, true};
    }
    return;
  }
  const model::FlatIndex index(before.model, old);
  const PatternWarp warp(before.garment.panels[old], now.garment.panels[panel]);
  parallel_for(static_cast<std::size_t>(is.n_vertices), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t v = static_cast<std::size_t>(is.first_vertex) + k;
      std::array<double, 3> w{};
      const Index t = index.locate(warp(now.model.vertex_uv[v]), w);
      if (t < 0) continue;
      places[v].known = true;
      for (int c = 0; c < 3; ++c)
        places[v].at += w[c] * position[before.model.vertex_particle[before.model.triangle[t][c]]];
    }
  });
}

/// Particles by the mean of their known vertices; where all of these lay on one old particle, exactly there.
/// Says which particles are known.
std::vector<bool> gather(const model::Model& model, const std::vector<Vector3d>& position,
                         const std::vector<OldPlace>& places, Transferred& out) {
  const std::size_t n = model.n_particles();
  out.position.assign(n, Vector3d::Zero());
  std::vector<int> count(n, 0);
  std::vector<Index> exact(n, -1);
  for (std::size_t v = 0; v < places.size(); ++v) {
    if (!places[v].known) continue;
    const Index i = model.vertex_particle[v];
    exact[i] = count[i] == 0 || exact[i] == places[v].exact ? places[v].exact : -1;
    out.position[i] += places[v].at;
    ++count[i];
  }
  std::vector<bool> known(n, false);
  for (std::size_t i = 0; i < n; ++i) {
    if (count[i] == 0) continue;
    known[i] = true;
    out.n_kept += exact[i] >= 0 ? 1 : 0;
    out.position[i] = exact[i] >= 0 ? position[exact[i]] : Vector3d(out.position[i] / count[i]);
  }
  return known;
}

/// New panels: their start, moved by the mean of what their seams moved by.
void bring_fresh(const model::Model& model, const std::vector<bool>& fresh_panel,
                 const std::vector<bool>& known, Transferred& out) {
  for (std::size_t p = 0; p < model.panels.size(); ++p) {
    if (!fresh_panel[p]) continue;
    const model::PanelRange& range = model.panels[p];
    Vector3d way = Vector3d::Zero();
    int count = 0;
    for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v)
      if (const Index i = model.vertex_particle[v]; known[i]) {
        way += out.position[i] - model.start[i];
        ++count;
      }
    if (count > 0) way /= count;
    for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v)
      if (const Index i = model.vertex_particle[v]; !known[i]) out.position[i] = model.start[i] + way;
  }
  for (std::size_t i = 0; i < known.size(); ++i) out.n_fresh += known[i] ? 0 : 1;
}

}  // namespace

Transferred transfer(const ModelledGarment& before, const std::vector<Vector3d>& position,
                     const ModelledGarment& now) {
  Transferred out;
  std::vector<OldPlace> places(now.model.n_vertices());
  std::vector<bool> fresh(now.model.panels.size(), false);
  for (std::size_t p = 0; p < now.model.panels.size(); ++p) {
    const Index old = find_panel(before.model, now.model.panels[p].name);
    fresh[p] = old < 0;
    if (old >= 0) carry_old_panel(before, old, position, now, static_cast<Index>(p), places);
  }
  const std::vector<bool> known = gather(now.model, position, places, out);
  bring_fresh(now.model, fresh, known, out);
  return out;
}

}  // namespace garment::modeller
