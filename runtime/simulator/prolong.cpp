#include "runtime/simulator/prolong.hpp"

#include <array>

#include "runtime/base/parallel.hpp"
#include "runtime/model/flat_index.hpp"

namespace garment::simulator {
namespace {

using model::Index;
using model::Model;
using model::Vector3d;

}  // namespace

std::vector<Vector3d> prolong(const Model& coarse, const std::vector<Vector3d>& positions, const Model& fine) {
  std::vector<Vector3d> place(fine.n_vertices(), Vector3d::Zero());
  for (std::size_t p = 0; p < fine.panels.size(); ++p) {
    model::FlatIndex index(coarse, static_cast<Index>(p));
    const model::PanelRange& range = fine.panels[p];
    parallel_for(static_cast<std::size_t>(range.n_vertices), 512, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        auto v = static_cast<std::size_t>(range.first_vertex) + k;
        std::array<double, 3> w{};
        Index t = index.locate(fine.vertex_uv[v], w);
        if (t < 0) continue;
        for (int c = 0; c < 3; ++c) place[v] += w[c] * positions[coarse.vertex_particle[coarse.triangle[t][c]]];
      }
    });
  }
  std::vector<Vector3d> out(fine.n_particles(), Vector3d::Zero());
  std::vector<int> count(fine.n_particles(), 0);
  for (std::size_t v = 0; v < fine.n_vertices(); ++v) {
    out[fine.vertex_particle[v]] += place[v];
    ++count[fine.vertex_particle[v]];
  }
  for (std::size_t i = 0; i < out.size(); ++i)
    if (count[i] > 1) out[i] /= count[i];
  return out;
}

}  // namespace garment::simulator
