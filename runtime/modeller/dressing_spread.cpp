// Seams pull panels that lie apart together: the way goes into the panels, not into the cells beside the seam.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "runtime/modeller/dressing.hpp"

namespace garment::modeller {
namespace {

using Eigen::Vector3d;
using model::Index;

constexpr double kDepth = 0.08;  // m, over which the displacement of a seam dies away
constexpr double kNear = 0.05;   // m
constexpr int kMostSweeps = 400;

/// Wrapped round the torso.
bool is_wrapped(const design::Placement& p) {
  using Kind = design::Placement::Kind;
  const bool limb = p.part.starts_with("arm") || p.part.starts_with("leg") || p.part == "neck";
  return (p.kind == Kind::on_part || p.kind == Kind::around) && !limb;
}

/// Vertices of a panel that share a particle with panels that have no place yet.
std::vector<Index> goes_on_from(const model::Model& model, const model::PanelRange& range, const std::vector<bool>& waited_for) {
  std::vector<Index> found;
  for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v)
    if (waited_for[model.vertex_particle[v]]) found.push_back(v);
  return found;
}

/// Share of its move that a vertex of a wrapped panel takes: it lies on the body, and only a neckline is to run on smoothly.
double share_at(const model::Model& model, Index v, const std::vector<Index>& lines) {
  double nearest = kNear;
  for (Index w : lines) nearest = std::min(nearest, (model.vertex_uv[v] - model.vertex_uv[w]).norm());
  return 1 - nearest / kNear;
}

double mean_edge(const std::set<std::array<Index, 2>>& edges, const model::Model& model) {
  double sum = 0;
  for (auto [a, b] : edges) sum += (model.vertex_uv[a] - model.vertex_uv[b]).norm();
  return edges.empty() ? 1 : sum / static_cast<double>(edges.size());
}

}  // namespace

void spread_seams(const design::Garment& garment, const model::Model& model, const std::vector<bool>& placed,
                  const std::vector<std::pair<Index, Vector3d>>& wanted, std::vector<Vector3d>& place) {
  std::vector<Vector3d> sum(model.n_particles(), Vector3d::Zero());
  std::vector<int> count(model.n_particles(), 0);
  std::vector<bool> waited_for(model.n_particles(), false);
  for (std::size_t v = 0; v < model.n_vertices(); ++v)
    if (!placed[model.vertex_panel[v]]) waited_for[model.vertex_particle[v]] = true;
  for (std::size_t v = 0; v < model.n_vertices(); ++v) {
    if (!placed[model.vertex_panel[v]]) continue;
    sum[model.vertex_particle[v]] += place[v];
    ++count[model.vertex_particle[v]];
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (count[i] > 1) sum[i] /= count[i];
  for (const auto& [i, there] : wanted) {
    sum[i] = there;
    count[i] = std::max(count[i], 2);
  }
  std::vector<Vector3d> move(model.n_vertices(), Vector3d::Zero());
  std::vector<bool> fixed(model.n_vertices(), false);
  for (std::size_t v = 0; v < model.n_vertices(); ++v) {
    Index i = model.vertex_particle[v];
    if (!placed[model.vertex_panel[v]] || count[i] < 2) continue;
    move[v] = sum[i] - place[v];
    place[v] = sum[i];
    fixed[v] = true;
  }
  for (std::size_t p = 0; p < garment.panels.size(); ++p) {
    const model::PanelRange& range = model.panels[p];
    const bool wrapped = is_wrapped(garment.panels[p].placement);
    const std::vector<Index> lines = wrapped ? goes_on_from(model, range, waited_for) : std::vector<Index>{};
    if (!placed[p] || (garment.panels[p].placement.kind != design::Placement::Kind::rigid && lines.empty())) continue;
    std::set<std::array<Index, 2>> edges;
    for (Index t = range.first_triangle; t < range.first_triangle + range.n_triangles; ++t)
      for (int k = 0; k < 3; ++k) {
        Index a = model.triangle[t][k], b = model.triangle[t][(k + 1) % 3];
        edges.insert({std::min(a, b), std::max(a, b)});
      }
    double cells = kDepth / mean_edge(edges, model);
    int sweeps = std::min(kMostSweeps, static_cast<int>(2 * cells * cells) + 1);
    std::vector<Vector3d> total(range.n_vertices);
    std::vector<int> n(range.n_vertices);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      std::fill(total.begin(), total.end(), Vector3d::Zero());
      std::fill(n.begin(), n.end(), 0);
      for (auto [a, b] : edges) {
        total[a - range.first_vertex] += move[b], ++n[a - range.first_vertex];
        total[b - range.first_vertex] += move[a], ++n[b - range.first_vertex];
      }
      for (Index k = 0; k < range.n_vertices; ++k) {
        Index v = range.first_vertex + k;
        if (!fixed[v] && n[k] > 0) move[v] += 0.5 * (total[k] / n[k] - move[v]);
      }
    }
    for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v)
      if (!fixed[v]) place[v] += (wrapped ? share_at(model, v, lines) : 1) * move[v];
  }
}

}  // namespace garment::modeller
