#include "runtime/modeller/grid_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "runtime/geometry/triangulate.hpp"
#include "runtime/modeller/mesh_quality.hpp"

namespace garment::modeller {
namespace {

using Eigen::Vector2d;

constexpr double kClear = 0.45;  // of the spacing: least distance of a crossing from the border
constexpr double kOnCrossing =
    1e-6;                        // of the spacing: a border vertex this near to a crossing is that crossing
constexpr double kBeside = 0.3;  // of the spacing: a border vertex this near to the side of a cell cuts it

double distance_squared(const Vector2d& x, const Vector2d& a, const Vector2d& b) {
  Vector2d d = b - a;
  double t = std::clamp((x - a).dot(d) / std::max(1e-300, d.squaredNorm()), 0.0, 1.0);
  return (a + t * d - x).squaredNorm();
}

/// Does segment a-b enter the open box?
bool enters(const Vector2d& a, const Vector2d& b, const Vector2d& low, const Vector2d& high) {
  double t0 = 0, t1 = 1;
  for (int k = 0; k < 2; ++k) {
    double d = b[k] - a[k];
    if (d == 0) {
      if (a[k] <= low[k] || a[k] >= high[k]) return false;
      continue;
    }
    double u = (low[k] - a[k]) / d, v = (high[k] - a[k]) / d;
    if (u > v) std::swap(u, v);
    t0 = std::max(t0, u);
    t1 = std::min(t1, v);
  }
  return t0 < t1;
}

/// The grid over the border's bounding box; works in units of the spacings.
class Grid {
 public:
  Grid(const LoopBorder& border, double hp, double hq)
      : next_(border.next), lines_(border.lines), used_(border.at.size(), 0), hp_(hp), hq_(hq) {
    for (std::size_t k = 0; k < next_.size(); ++k)
      if (next_[k] >= 0) used_[k] = used_[next_[k]] = 1;
    for (const auto& line : lines_) used_[line[0]] = used_[line[1]] = 1;
    for (const auto& [a, b] : lines_) both_ways_.insert({{a, b}, {b, a}});
    Vector2d low(1e300, 1e300), high(-1e300, -1e300);
    for (const Vector2d& x : border.at) {
      loop_.emplace_back(x.x() / hp, x.y() / hq);
      low = low.cwiseMin(loop_.back());
      high = high.cwiseMax(loop_.back());
    }
    i0_ = static_cast<int>(std::floor(low.x())) - 1;
    j0_ = static_cast<int>(std::floor(low.y())) - 1;
    ni_ = static_cast<int>(std::ceil(high.x())) + 2 - i0_;
    nj_ = static_cast<int>(std::ceil(high.y())) + 2 - j0_;
    node_.assign(static_cast<std::size_t>(ni_) * nj_, kFree);
    cut_.assign(node_.size(), 0);
  }

  void build(LoopMesh& mesh) {
    block_near_border();
    place_interior(mesh);
    place_on_border();
    mark_cut_cells();
    collect_full_cells(mesh);
  }

  /// Directed border of what is left between loop and full cells.
  std::vector<std::array<int, 2>> ring_border() const {
    int n = static_cast<int>(loop_.size());
    auto on_loop = [&](int u, int v) { return u < n && v == next_[u]; };
    std::vector<char> taken(loop_.size(), 0);
    std::set<std::array<int, 2>> open = both_ways_;  // sides of lines with no full cell to their left
    std::vector<std::array<int, 2>> inner;
    for (int j = 0; j + 1 < nj_; ++j) {
      for (int i = 0; i + 1 < ni_; ++i) {
        if (!full(i, j)) continue;
        const std::array<int, 4> c = corners(i, j);
        const std::array<bool, 4> beyond{full(i, j - 1), full(i + 1, j), full(i, j + 1), full(i - 1, j)};
        for (int k = 0; k < 4; ++k) {
          int u = c[k], v = c[(k + 1) % 4];
          if (on_loop(u, v))
            taken[u] = 1;
          else if (both_ways_.count({u, v}) > 0)
            open.erase({u, v});
          else if (!beyond[k])
            inner.push_back({v, u});
        }
      }
    }
    std::vector<std::array<int, 2>> border;
    for (int u = 0; u < n; ++u)
      if (!taken[u] && next_[u] >= 0) border.push_back({u, next_[u]});
    border.insert(border.end(), open.begin(), open.end());
    border.insert(border.end(), inner.begin(), inner.end());
    return border;
  }

 private:
  static constexpr int kFree = -1, kBlocked = -2;
  std::vector<Vector2d> loop_;
  const std::vector<int>& next_;
  const std::vector<std::array<int, 2>>& lines_;
  std::set<std::array<int, 2>> both_ways_;  // the segments of the lines, from either end
  std::vector<char> used_;                  // vertices on any segment
  double hp_, hq_;
  int i0_ = 0, j0_ = 0, ni_ = 0, nj_ = 0;
  std::vector<int> node_;  // vertex at each crossing
  std::vector<char>
      cut_;  // cell (i, j) has its lowest corner at node (i, j); 0 inside, 1 cut or outside, 2 full

  std::size_t at(int i, int j) const { return static_cast<std::size_t>(j) * ni_ + i; }
  bool full(int i, int j) const { return i >= 0 && j >= 0 && i < ni_ && j < nj_ && cut_[at(i, j)] == 2; }
  std::array<int, 4> corners(int i, int j) const {
    return {node_[at(i, j)], node_[at(i + 1, j)], node_[at(i + 1, j + 1)], node_[at(i, j + 1)]};
  }

  template <class F>
  void for_each_segment(const F& f) const {
    for (std::size_t k = 0; k < loop_.size(); ++k)
      if (next_[k] >= 0) f(loop_[k], loop_[next_[k]]);
    for (const auto& [a, b] : lines_) f(loop_[a], loop_[b]);
  }

  /// Calls f(i, j) for grid indices within `reach` of the box of a and b.
  template <class F>
  void for_each_near(const Vector2d& a, const Vector2d& b, double reach, const F& f) const {
    Vector2d low = a.cwiseMin(b), high = a.cwiseMax(b);
    int ia = std::max(0, static_cast<int>(std::floor(low.x() - reach)) - i0_);
    int ib = std::min(ni_ - 1, static_cast<int>(std::ceil(high.x() + reach)) - i0_);
    int ja = std::max(0, static_cast<int>(std::floor(low.y() - reach)) - j0_);
    int jb = std::min(nj_ - 1, static_cast<int>(std::ceil(high.y() + reach)) - j0_);
    for (int j = ja; j <= jb; ++j)
      for (int i = ia; i <= ib; ++i) f(i, j);
  }

  void block_near_border() {
    double h = std::min(hp_, hq_), clear = kClear * h;
    Vector2d scale(hp_, hq_);
    for_each_segment([&](const Vector2d& a, const Vector2d& b) {
      Vector2d sa = a.cwiseProduct(scale), sb = b.cwiseProduct(scale);
      for_each_near(a, b, kClear, [&](int i, int j) {
        Vector2d x((i + i0_) * hp_, (j + j0_) * hq_);
        if (distance_squared(x, sa, sb) < clear * clear) node_[at(i, j)] = kBlocked;
      });
    });
  }

  /// Places p, ascending, where the row at height q crosses the loop.
  std::vector<double> row_crossings(const std::vector<std::vector<int>>& bins, int bin, double q) const {
    std::vector<double> result;
    for (int k : bins[bin]) {
      const Vector2d &a = loop_[k], &b = loop_[next_[k]];
      if ((a.y() <= q) == (b.y() <= q)) continue;
      result.push_back(a.x() + (q - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
    std::sort(result.begin(), result.end());
    return result;
  }

  /// Segments by the rows [j, j + 1) that they touch.
  std::vector<std::vector<int>> segments_by_row() const {
    std::vector<std::vector<int>> bins(nj_);
    for (std::size_t k = 0; k < loop_.size(); ++k) {
      if (next_[k] < 0) continue;
      const Vector2d &a = loop_[k], &b = loop_[next_[k]];
      int ja = static_cast<int>(std::floor(std::min(a.y(), b.y()))) - j0_,
          jb = static_cast<int>(std::floor(std::max(a.y(), b.y()))) - j0_;
      for (int j = ja; j <= jb; ++j) bins[j].push_back(static_cast<int>(k));
    }
    return bins;
  }

  void place_interior(LoopMesh& mesh) {
    std::vector<std::vector<int>> bins = segments_by_row();
    for (int j = 0; j < nj_; ++j) {
      std::vector<double> nodes = row_crossings(bins, j, j + j0_),
                          cells = row_crossings(bins, j, j + j0_ + 0.5);
      std::size_t passed_nodes = 0, passed_cells = 0;
      for (int i = 0; i < ni_; ++i) {
        while (passed_nodes < nodes.size() && nodes[passed_nodes] < i + i0_) ++passed_nodes;
        while (passed_cells < cells.size() && cells[passed_cells] < i + i0_ + 0.5) ++passed_cells;
        if (passed_cells % 2 == 0) cut_[at(i, j)] = 1;
        int& node = node_[at(i, j)];
        if (node != kFree || passed_nodes % 2 == 0) continue;
        node = static_cast<int>(mesh.at.size());
        mesh.at.emplace_back((i + i0_) * hp_, (j + j0_) * hq_);
      }
    }
  }

  void place_on_border() {
    for (std::size_t k = 0; k < loop_.size(); ++k) {
      if (!used_[k]) continue;
      Vector2d r(std::floor(loop_[k].x() + 0.5), std::floor(loop_[k].y() + 0.5));
      if ((loop_[k] - r).cwiseAbs().maxCoeff() < kOnCrossing) {
        node_[at(static_cast<int>(r.x()) - i0_, static_cast<int>(r.y()) - j0_)] = static_cast<int>(k);
        continue;
      }
      for_each_near(loop_[k], loop_[k], 1, [&](int i, int j) {
        Vector2d d = loop_[k] - Vector2d(i + i0_ + 0.5, j + j0_ + 0.5);
        if (d.cwiseAbs().maxCoeff() < 0.5 + kBeside) cut_[at(i, j)] = 1;
      });
    }
  }

  void mark_cut_cells() {
    for_each_segment([&](const Vector2d& a, const Vector2d& b) {
      for_each_near(a, b, 1, [&](int i, int j) {
        Vector2d low(i + i0_ + kOnCrossing, j + j0_ + kOnCrossing),
            high(i + i0_ + 1 - kOnCrossing, j + j0_ + 1 - kOnCrossing);
        if (enters(a, b, low, high)) cut_[at(i, j)] = 1;
      });
    });
  }

  void collect_full_cells(LoopMesh& mesh) {
    int n = static_cast<int>(loop_.size());
    auto follows = [&](int u, int v) { return u >= 0 && u < n && v == next_[u]; };
    for (int j = 0; j + 1 < nj_; ++j) {
      for (int i = 0; i + 1 < ni_; ++i) {
        if (cut_[at(i, j)] != 0) continue;
        std::array<int, 4> c = corners(i, j);
        if (*std::min_element(c.begin(), c.end()) < 0) continue;
        cut_[at(i, j)] = 2;
        mesh.cells.push_back(c);
        int start =
            (i + i0_ + j + j0_) & 1;  // diagonals alternate; one through a corner of the outline goes first
        for (int k = 0; k < 4; ++k)
          if (follows(c[(k + 3) % 4], c[k]) && follows(c[k], c[(k + 1) % 4])) start = k & 1;
        mesh.cell_halves.push_back({c[start], c[start + 1], c[start + 2]});
        mesh.cell_halves.push_back({c[start + 2], c[(start + 3) % 4], c[start]});
      }
    }
  }
};

}  // namespace

LoopMesh mesh_loop(const LoopBorder& loop, double hp, double hq) {
  LoopMesh mesh;
  mesh.at = loop.at;
  Grid grid(loop, hp, hq);
  grid.build(mesh);
  std::vector<std::array<int, 2>> border = grid.ring_border();
  if (border.empty()) {
    mesh.ok = true;
    return mesh;
  }
  // points of the ring: on its border, or in no full cell
  std::vector<int> number(mesh.at.size(), -1);
  std::vector<char> in_cell(mesh.at.size(), 0), on_border(mesh.at.size(), 0);
  for (const auto& c : mesh.cells)
    for (int v : c) in_cell[v] = 1;
  for (const auto& s : border)
    for (int v : s) on_border[v] = 1;
  std::vector<int> vertex;
  std::vector<Vector2d> points;
  for (std::size_t v = 0; v < mesh.at.size(); ++v) {
    if (!on_border[v] && (in_cell[v] || v < loop.at.size())) continue;
    number[v] = static_cast<int>(points.size());
    vertex.push_back(static_cast<int>(v));
    points.push_back(mesh.at[v]);
  }
  std::vector<std::array<int, 2>> numbered = border;
  for (auto& s : numbered)
    for (int& v : s) v = number[v];
  geometry::Triangulation ring = geometry::triangulate(points, numbered);
  mesh.ok = ring.ok;
  for (int k = 0; k < 2; ++k) mesh.bad[k] = ring.bad[k] < 0 ? -1 : vertex[ring.bad[k]];
  for (const auto& t : ring.triangles) mesh.cut.push_back({vertex[t[0]], vertex[t[1]], vertex[t[2]]});
  if (mesh.ok) open_ears(mesh, loop);
  return mesh;
}

}  // namespace garment::modeller
