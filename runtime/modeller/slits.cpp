#include "runtime/modeller/slits.hpp"

#include <algorithm>

namespace garment::modeller {
namespace {

using geometry::cross;

constexpr double kHalfGap = 0.05e-3;  // m

/// Ways along the slit at one of its vertices; zero beyond its ends.
struct Station {
  int vertex;
  Point2 from, on;  // from the one before, on to the next

  /// Does what lies in the direction `d` lie to the left of the slit?
  bool is_left(const Point2& d) const {
    if (from.isZero()) return cross(on, d) > 0;
    if (on.isZero()) return cross(from, d) > 0;
    return cross(from, on) >= 0 ? cross(from, d) > 0 && cross(on, d) > 0 : cross(from, d) > 0 || cross(on, d) > 0;
  }
  Point2 left() const {
    const Point2 way = (from.isZero() ? from : Point2(from.normalized())) + (on.isZero() ? on : Point2(on.normalized()));
    return Point2(-way.y(), way.x()).normalized();
  }
};

/// The vertices that become two.
std::vector<Station> stations(const std::vector<int>& chain, const Border& border, const PanelMesh& mesh) {
  std::vector<Station> result;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const bool end = k == 0 || k + 1 == chain.size();
    if (end && static_cast<std::size_t>(chain[k]) >= border.n_outline()) continue;  // the cut ends inside
    Station s{chain[k], Point2(0, 0), Point2(0, 0)};
    if (k > 0) s.from = mesh.at[chain[k]] - mesh.at[chain[k - 1]];
    if (k + 1 < chain.size()) s.on = mesh.at[chain[k + 1]] - mesh.at[chain[k]];
    result.push_back(s);
  }
  return result;
}

void part(const Station& s, PanelMesh& mesh) {
  const auto twin = static_cast<int>(mesh.at.size());
  const Point2 at = mesh.at[s.vertex];
  auto renumber = [&](auto& elements) {
    for (auto& element : elements) {
      const auto here = std::find(element.begin(), element.end(), s.vertex);
      if (here == element.end()) continue;
      Point2 middle(0, 0);
      for (int v : element) middle += mesh.at[v] / static_cast<double>(element.size());
      if (!s.is_left(middle - at)) *here = twin;
    }
  };
  mesh.at.push_back(at);  // stands where its twin is until all are parted
  renumber(mesh.cells);
  renumber(mesh.cut);
  renumber(mesh.cell_halves);
}

}  // namespace

void open_slits(const BorderPanel& panel, const Border& border, PanelMesh& mesh) {
  const std::vector<InnerLine>& lines = panel.outline.lines;
  auto is_cut = [&](const InnerLine& line) {
    return std::any_of(panel.panel->slits.begin(), panel.panel->slits.end(),
                       [&](const design::Slit& slit) { return line.line >= 0 && slit.line == line.line; });
  };
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (!is_cut(lines[k])) continue;
    std::vector<int> chain;
    for (int v = border.loops[border.n_closed + k]; v < border.end_of(border.n_closed + k); ++v) chain.push_back(border.same[v]);
    const std::vector<Station> parted = stations(chain, border, mesh);
    const std::size_t first = mesh.at.size();
    for (const Station& s : parted) part(s, mesh);
    for (std::size_t j = 0; j < parted.size(); ++j) {
      const Point2 off = kHalfGap * parted[j].left();
      mesh.at[parted[j].vertex] += off;
      mesh.at[first + j] -= off;
    }
  }
}

}  // namespace garment::modeller
