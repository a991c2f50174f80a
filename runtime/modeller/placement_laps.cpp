#include "runtime/modeller/placement_laps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/model/flat_index.hpp"
#include "runtime/modeller/flat_start.hpp"
#include "runtime/modeller/placement_carry.hpp"

namespace garment::modeller {
namespace {

using Eigen::Vector2d;
using model::Index;

constexpr double kMostLap = 0.5;     // of the smaller panel's vertices
constexpr double kFade = 0.06;       // m, over which the lift dies away beside the lap
constexpr double kLapOfGrid = 0.5;   // of the grid's spacing: facets of both that bend otherwise keep apart
constexpr double kLeastLap = 0.01;   // m: so the ends of a collar, which lap at the same place, find room side by side

/// Where vertices of one panel lie in the pattern of another that shares its ring.
class Overlap {
 public:
  Overlap(const Workspace& w, const OnRing& upper, const OnRing& lower)
      : w_(w), range_(w.model.panels[upper.panel]), lower_(w.model.panels[lower.panel]), index_(w.model, static_cast<Index>(lower.panel)),
        shift_(lower.middle - upper.middle, upper.base - lower.base) {}

  Vector2d at(Index v) const { return w_.flat[v].head<2>() + shift_; }
  bool on(Index v) const {
    std::array<double, 3> weights{};
    return index_.locate(at(v), weights) >= 0 && *std::min_element(weights.begin(), weights.end()) > -1e-6;
  }
  Index count() const {
    Index n = 0;
    for (Index v = range_.first_vertex; v < range_.first_vertex + range_.n_vertices; ++v) n += on(v);
    return n;
  }
  /// Distance to the nearest vertex, m.
  double beside(Index v) const {
    double nearest = 1e300;
    for (Index u = lower_.first_vertex; u < lower_.first_vertex + lower_.n_vertices; ++u)
      nearest = std::min(nearest, (w_.flat[u].head<2>() - at(v)).squaredNorm());
    return std::sqrt(nearest);
  }

 private:
  const Workspace& w_;
  const model::PanelRange &range_, &lower_;
  model::FlatIndex index_;
  Vector2d shift_;
};

bool is_stacked(const Workspace& w, std::size_t a, std::size_t b) {
  return std::any_of(w.garment.stackings.begin(), w.garment.stackings.end(), [&](const design::Stacking& s) {
    return (s.panel == static_cast<int>(a) && s.other == static_cast<int>(b)) || (s.panel == static_cast<int>(b) && s.other == static_cast<int>(a));
  });
}

bool is_sewn(const Workspace& w, std::size_t a, std::size_t b) {
  std::vector<bool> other(w.garment.panels.size(), false);
  other[b] = true;
  return count_shared_particles(w.model, a, other) > 0;
}

/// More buttons hold `a` over `b` than `b` over `a`: above 0.
int buttoned_over(const Workspace& w, std::size_t a, std::size_t b) {
  int n = 0;
  for (const design::Button& button : w.garment.buttons) {
    std::vector<int> layers;  // from the outermost
    for (const design::ButtonHole& hole : button.holes) layers.push_back(hole.panel);
    layers.push_back(button.panel);
    const auto first = std::find(layers.begin(), layers.end(), static_cast<int>(a)), second = std::find(layers.begin(), layers.end(), static_cast<int>(b));
    if (first == layers.end() || second == layers.end()) continue;
    n += first < second ? 1 : -1;
  }
  return n;
}

bool lies_over(const Workspace& w, std::size_t a, std::size_t b) {
  if (const int n = buttoned_over(w, a, b); n != 0) return n > 0;
  const design::Panel &p = w.garment.panels[a], &q = w.garment.panels[b];
  if (p.placement.offset != q.placement.offset) return p.placement.offset > q.placement.offset;
  return p.name < q.name;
}

}  // namespace

void lift_laps(Workspace& w, const std::vector<OnRing>& panels) {
  std::vector<std::pair<Index, double>> lifts;
  for (const OnRing& upper : panels)
    for (const OnRing& lower : panels) {
      const design::Panel &p = w.garment.panels[upper.panel], &q = w.garment.panels[lower.panel];
      if (upper.panel == lower.panel || p.placement.part != q.placement.part || !lies_over(w, upper.panel, lower.panel)) continue;
      if (is_stacked(w, upper.panel, lower.panel) || is_sewn(w, upper.panel, lower.panel)) continue;
      const Overlap overlap(w, upper, lower);
      const model::PanelRange &range = w.model.panels[upper.panel], &under = w.model.panels[lower.panel];
      const Index lapped = overlap.count();
      if (lapped == 0 || lapped > kMostLap * std::min(range.n_vertices, under.n_vertices)) continue;
      const double grid = std::max(p.resolution, q.resolution);
      const double gap = std::max({layer_gap(w.garment, static_cast<int>(upper.panel)), layer_gap(w.garment, static_cast<int>(lower.panel)),
                                   kLapOfGrid * grid, kLeastLap, std::abs(p.placement.offset - q.placement.offset)});
      for_each_vertex(w.model, upper.panel, [&](Index v) {
        const double beside = overlap.on(v) ? 0 : std::max(0.0, overlap.beside(v) - grid);
        if (beside < kFade) lifts.emplace_back(v, gap * (1 - beside / kFade));
      });
    }
  for (const auto& [v, lift] : lifts) w.flat[v].z() += lift;
}

}  // namespace garment::modeller
