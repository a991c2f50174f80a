#include "runtime/modeller/slits.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "runtime/base/portable_math.hpp"

namespace garment::modeller {
namespace {

using geometry::cross;

constexpr double kHalfGap = 0.05e-3;  // m
constexpr double kFarthest = 3;       // times kHalfGap: how far a particle moves into a narrow piece between two slits

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

using Chain = std::vector<int>;  // the vertices of a slit, one after the other

/// The vertices of a slit that become two.
std::vector<Station> stations(const Chain& chain, const std::set<int>& shared, const Border& border, const PanelMesh& mesh) {
  std::vector<Station> result;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    if (shared.contains(chain[k])) continue;
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

/// Vertices on more than one slit, or on one more than once.
std::set<int> shared_vertices(const std::vector<Chain>& chains) {
  std::set<int> known, shared;
  for (const Chain& chain : chains)
    for (int v : chain)
      if (!known.insert(v).second) shared.insert(v);
  return shared;
}

/// A way that leads off a vertex where slits meet: along a slit, or along the border.
struct Ray {
  Point2 way;
  double angle;  // from the first slit, counter-clockwise
  bool slit;
};

/// The ways off vertex `v`, counter-clockwise from that of its first slit.
std::vector<Ray> rays_of(int v, const std::vector<Chain>& chains, const Border& border, const PanelMesh& mesh) {
  std::vector<int> ends;
  for (const Chain& chain : chains)
    for (std::size_t k = 0; k < chain.size(); ++k) {
      if (chain[k] != v) continue;
      if (k + 1 < chain.size()) ends.push_back(chain[k + 1]);
      if (k > 0) ends.push_back(chain[k - 1]);
    }
  const std::size_t n_slits = ends.size();
  const auto n = static_cast<int>(border.n_outline());
  for (int u = 0; u < n; ++u) {
    if (border.next[u] == v) ends.push_back(u);
    if (u == v) ends.push_back(border.next[u]);
  }
  std::vector<Ray> rays;
  std::set<int> known;
  for (std::size_t k = 0; k < ends.size(); ++k)
    if (known.insert(ends[k]).second) rays.push_back({mesh.at[ends[k]] - mesh.at[v], 0, k < n_slits});
  for (Ray& ray : rays) {
    const Point2& first = rays[0].way;
    const double angle = portable::atan2(cross(first, ray.way), first.dot(ray.way));
    ray.angle = &ray == &rays[0] ? 0 : angle < 0 ? angle + 2 * portable::kPi : angle;
  }
  std::stable_sort(rays.begin(), rays.end(), [](const Ray& a, const Ray& b) { return a.angle < b.angle; });
  return rays;
}

/// Where the particle of the piece between two ways goes: as far from either as half the gap.
Point2 into_piece(const Ray& right, const Ray& left, double angle) {
  auto turned = [](const Point2& d) { return Point2(Point2(-d.y(), d.x()).normalized()); };
  if (!left.slit || !right.slit) return kHalfGap * (right.slit ? turned(right.way) : left.slit ? Point2(-turned(left.way)) : Point2(0, 0));
  const double half = angle / 2;
  const Point2 r = right.way.normalized(), n = turned(right.way);
  const double far = std::min(kFarthest, 1 / std::max(1e-9, portable::sin(half)));
  return far * kHalfGap * (portable::cos(half) * r + portable::sin(half) * n);
}

/// Parts vertex `v` into the pieces of cloth between the slits that meet there; `moved` gets how far each particle goes. Nothing
/// of the mesh may have moved yet.
void part_shared(int v, const std::vector<Chain>& chains, const Border& border, PanelMesh& mesh,
                 std::vector<std::pair<int, Point2>>& moved) {
  const std::vector<Ray> rays = rays_of(v, chains, border, mesh);
  const Point2 at = mesh.at[v];
  if (rays.size() < 2) return;  // the same cut, drawn twice, ends here
  std::vector<int> number(rays.size(), -1);  // of the particle of each piece, from ray k to the next
  bool kept = false;
  auto piece_at = [&](const Point2& d) {
    const double turn = portable::atan2(cross(rays[0].way, d), rays[0].way.dot(d));
    const double angle = turn < 0 ? turn + 2 * portable::kPi : turn;
    std::size_t k = rays.size() - 1;
    while (k > 0 && rays[k].angle > angle) --k;
    return k;
  };
  auto renumber = [&](auto& elements) {
    for (auto& element : elements) {
      const auto here = std::find(element.begin(), element.end(), v);
      if (here == element.end()) continue;
      Point2 middle(0, 0);
      for (int u : element) middle += mesh.at[u] / static_cast<double>(element.size());
      const std::size_t k = piece_at(middle - at);
      if (number[k] < 0) {
        number[k] = kept ? static_cast<int>(mesh.at.size()) : v;
        if (kept) mesh.at.push_back(at);
        kept = true;
      }
      *here = number[k];
    }
  };
  renumber(mesh.cells);
  renumber(mesh.cut);
  renumber(mesh.cell_halves);
  for (std::size_t k = 0; k < rays.size(); ++k) {
    if (number[k] < 0) continue;
    const Ray& left = rays[(k + 1) % rays.size()];
    moved.emplace_back(number[k], into_piece(rays[k], left, k + 1 < rays.size() ? left.angle - rays[k].angle : 2 * portable::kPi - rays[k].angle));
  }
}

}  // namespace

void open_slits(const BorderPanel& panel, const Border& border, PanelMesh& mesh) {
  const std::vector<InnerLine>& lines = panel.outline.lines;
  auto is_cut = [&](const InnerLine& line) {
    return std::any_of(panel.panel->slits.begin(), panel.panel->slits.end(),
                       [&](const design::Slit& slit) { return line.line >= 0 && slit.line == line.line; });
  };
  std::vector<Chain> chains;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (!is_cut(lines[k])) continue;
    chains.emplace_back();
    for (int v = border.loops[border.n_closed + k]; v < border.end_of(border.n_closed + k); ++v) chains.back().push_back(border.same[v]);
  }
  const std::set<int> shared = shared_vertices(chains);
  std::vector<std::pair<int, Point2>> moved;
  for (const Chain& chain : chains) {
    for (const Station& s : stations(chain, shared, border, mesh)) {
      const Point2 off = kHalfGap * s.left();
      moved.emplace_back(s.vertex, off);
      moved.emplace_back(static_cast<int>(mesh.at.size()), -off);
      part(s, mesh);
    }
  }
  for (int v : shared) part_shared(v, chains, border, mesh, moved);
  for (const auto& [vertex, off] : moved) mesh.at[vertex] += off;
}

}  // namespace garment::modeller
