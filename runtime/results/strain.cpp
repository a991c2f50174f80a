#include "runtime/results/strain.hpp"

#include <algorithm>

#include "runtime/results/strain_samples.hpp"

namespace garment::results {
namespace {

constexpr model::Index kAllPanels = -1;

struct Weighted {
  double strain, area;
};

Tension tension(std::vector<Weighted> w) {
  Tension out;
  if (w.empty()) return out;
  std::stable_sort(w.begin(), w.end(),
                   [](const Weighted& a, const Weighted& b) { return a.strain < b.strain; });
  out.largest = std::max(0.0, w.back().strain);
  double total = 0;
  for (const Weighted& s : w) total += s.area;
  double below = 0;
  for (const Weighted& s : w) {
    below += s.area;
    if (below >= 0.99 * total) {
      out.p99 = std::max(0.0, s.strain);
      break;
    }
  }
  return out;
}

PanelStrain summarise(std::string name, model::Index panel, const std::vector<StrainSample>& samples,
                      const std::vector<ShearSample>& shears) {
  PanelStrain out;
  out.panel = std::move(name);
  std::vector<Weighted> warp, weft, any;
  for (const StrainSample& s : samples) {
    if (panel != kAllPanels && s.panel != panel) continue;
    (s.direction == Direction::warp ? warp : weft).push_back({s.strain, s.area});
    any.push_back({s.strain, s.area});
  }
  out.warp = tension(std::move(warp));
  out.weft = tension(std::move(weft));
  out.any = tension(std::move(any));
  for (const ShearSample& s : shears)
    if (panel == kAllPanels || s.panel == panel) out.largest_shear = std::max(out.largest_shear, s.angle);
  return out;
}

}  // namespace

StrainReport measure_strain(const model::Model& model, const model::State& state) {
  const VertexTable table(model);
  const std::vector<StrainSample> samples = strain_samples(model, state, table);
  const std::vector<ShearSample> shears = shear_samples(model, state, table);
  StrainReport out;
  for (std::size_t p = 0; p < model.panels.size(); ++p)
    out.panels.push_back(summarise(model.panels[p].name, static_cast<model::Index>(p), samples, shears));
  out.all = summarise("all", kAllPanels, samples, shears);
  return out;
}

std::vector<Eigen::Vector2d> vertex_strain(const model::Model& model, const model::State& state) {
  const VertexTable table(model);
  std::vector<Eigen::Vector2d> sum(model.n_vertices(), Eigen::Vector2d::Zero()), area = sum;
  for (const StrainSample& s : strain_samples(model, state, table)) {
    const auto d = static_cast<Eigen::Index>(s.direction);
    for (int k = 0; k < s.n; ++k) {
      sum[s.vertex[k]][d] += s.area * s.strain;
      area[s.vertex[k]][d] += s.area;
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v)
    for (Eigen::Index d = 0; d < 2; ++d)
      if (area[v][d] > 0) sum[v][d] /= area[v][d];
  return sum;
}

}  // namespace garment::results
