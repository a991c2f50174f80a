#include "runtime/modeller/twins.hpp"

#include <algorithm>
#include <map>

#include "runtime/modeller/mesh_quality.hpp"

namespace garment::modeller {
namespace {

using model::Index;
using Corners = std::array<Index, 3>;

/// A triangle of a panel: one of its cut triangles, or half of a cell.
struct PanelTriangle {
  std::size_t panel;
  bool cut;
  std::size_t index;
};

Corners sorted_corners(const MeshedPanel& p, const std::array<int, 3>& t,
                       const std::vector<Index>& particle) {
  Corners c{particle[p.first_vertex + t[0]], particle[p.first_vertex + t[1]],
            particle[p.first_vertex + t[2]]};
  std::sort(c.begin(), c.end());
  return c;
}

/// Turns the side of triangle t opposite its corner k, if a cut triangle (or the other half of its cell) lies
/// beyond and the shape allows it. The new diagonal lies opposite corner 1 of t.
bool turn(const MeshedPanel& p, std::vector<std::array<int, 3>>& list, bool cut, std::size_t t, int k,
          std::size_t& other) {
  int c = list[t][k], l = list[t][(k + 1) % 3], r = list[t][(k + 2) % 3];
  for (other = cut ? 0 : t ^ 1; other < (cut ? list.size() : (t ^ 1) + 1); ++other) {
    for (int m = 0; m < 3; ++m) {
      if (list[other][(m + 1) % 3] != r || list[other][(m + 2) % 3] != l) continue;
      int d = list[other][m];
      const auto& at = p.mesh.at;
      if (std::min(least_sine(at[c], at[l], at[d]), least_sine(at[d], at[r], at[c])) < 0.1) return false;
      list[t] = {c, l, d};
      list[other] = {d, r, c};
      return true;
    }
  }
  return false;
}

}  // namespace

void part_twins(std::vector<MeshedPanel>& panels, const std::vector<Index>& particle) {
  std::map<Corners, std::vector<PanelTriangle>> triangles;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    for (bool cut : {false, true}) {
      const auto& list = cut ? panels[p].mesh.cut : panels[p].mesh.cell_halves;
      for (std::size_t i = 0; i < list.size(); ++i) {
        // twins have three merged corners, or two and the particle they fold round: the border is near
        bool near = false;
        for (int v : list[i]) near = near || static_cast<std::size_t>(v) < panels[p].mesh.n_border;
        if (near) triangles[sorted_corners(panels[p], list[i], particle)].push_back({p, cut, i});
      }
    }
  }
  std::vector<Corners> twins;
  for (const auto& [corners, places] : triangles)
    if (places.size() > 1) twins.push_back(corners);
  for (const Corners& corners : twins) {
    std::vector<PanelTriangle> places = triangles[corners];
    bool parted = false;
    for (std::size_t i = places.size(); i-- > 0 && !parted;) {
      MeshedPanel& p = panels[places[i].panel];
      auto& list = places[i].cut ? p.mesh.cut : p.mesh.cell_halves;
      if (sorted_corners(p, list[places[i].index], particle) != corners) continue;  // turned since
      for (int k = 0; k < 3 && !parted; ++k) {
        std::size_t other;
        if (!turn(p, list, places[i].cut, places[i].index, k, other)) continue;
        bool fresh = triangles.find(sorted_corners(p, list[places[i].index], particle)) == triangles.end() &&
                     triangles.find(sorted_corners(p, list[other], particle)) == triangles.end();
        if (fresh) {
          parted = true;
        } else {
          std::size_t same = other;
          turn(p, list, places[i].cut, places[i].index, 1, same);  // back
          std::swap(list[places[i].index], list[other]);
        }
      }
    }
  }
}

}  // namespace garment::modeller
