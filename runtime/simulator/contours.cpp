#include "runtime/simulator/contours.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>

namespace garment::simulator {
namespace {

constexpr int kDepth = 4;  // edges from the line up to which a region moves as a whole

/// Disjoint sets; the root is the smallest number of its set.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  Index root(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(Index i, Index j) {
    i = root(i);
    j = root(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<Index> parent_;
};

/// Joins all hits with the same key.
template <class Key>
void join_equal(std::vector<std::pair<Key, Index>>& keys, Sets& sets) {
  std::sort(keys.begin(), keys.end());
  for (std::size_t i = 1; i < keys.size(); ++i)
    if (keys[i].first == keys[i - 1].first) sets.join(keys[i].second, keys[i - 1].second);
}

struct Bank {
  Index contour = -1;
  std::vector<Index> particles;  // ends of cut edges
  std::size_t size = 0;          // of the region
};

class ContourSearch {
 public:
  ContourSearch(const ContactMesh& mesh, const std::vector<Vector3d>& x, const Tangle& tangle)
      : mesh_(mesh), x_(x), tangle_(tangle) {}

  Contours run() {
    const std::size_t n_hits = tangle_.hits.size();
    out_.contour.assign(n_hits, -1);
    out_.astray.assign(n_hits, -1);
    out_.region.assign(x_.size(), -1);
    find_lines();
    if (out_.n == 0) return out_;
    find_banks();
    fill_regions();
    choose();
    return out_;
  }

 private:
  bool in_cloth(const EdgeHit& hit) const {
    return hit.edge < mesh_.n_cloth_edges && hit.triangle < mesh_.n_cloth_triangles;
  }

  /// Hits of one pair of triangles lie on one contour; hits of a contour whose edges bound one triangle on
  /// one line.
  void find_lines() {
    Sets contours(tangle_.hits.size()), lines(tangle_.hits.size());
    std::vector<std::pair<std::array<Index, 2>, Index>> keys;
    for (std::size_t k = 0; k < tangle_.hits.size(); ++k) {
      const EdgeHit& hit = tangle_.hits[k];
      if (!in_cloth(hit)) continue;
      for (Index t : mesh_.edge_triangles[hit.edge])
        keys.push_back({{std::min(t, hit.triangle), std::max(t, hit.triangle)}, static_cast<Index>(k)});
    }
    join_equal(keys, contours);
    keys.clear();
    std::map<Index, Index> number;
    for (std::size_t k = 0; k < tangle_.hits.size(); ++k) {
      const EdgeHit& hit = tangle_.hits[k];
      if (!in_cloth(hit)) continue;
      const Index root = contours.root(static_cast<Index>(k));
      out_.contour[k] = number.emplace(root, static_cast<Index>(number.size())).first->second;
      for (Index t : mesh_.edge_triangles[hit.edge]) keys.push_back({{root, t}, static_cast<Index>(k)});
    }
    out_.n = static_cast<Index>(number.size());
    join_equal(keys, lines);
    line_.assign(tangle_.hits.size(), -1);
    for (std::size_t k = 0; k < tangle_.hits.size(); ++k)
      if (in_cloth(tangle_.hits[k])) line_[k] = lines.root(static_cast<Index>(k));
  }

  /// Ends of the edge of a hit: behind the triangle's face, in front of it.
  std::array<Index, 2> ends(const EdgeHit& hit) const {
    const Indices<3>& c = mesh_.triangle[hit.triangle];
    const Vector3d normal = (x_[c[1]] - x_[c[0]]).cross(x_[c[2]] - x_[c[0]]);
    const Indices<2>& e = mesh_.edge[hit.edge];
    if (normal.dot(x_[e[1]] - x_[e[0]]) >= 0) return {e[0], e[1]};
    return {e[1], e[0]};
  }

  void find_banks() {
    std::map<Index, Index> number;  // first of the two banks of a line
    for (std::size_t k = 0; k < tangle_.hits.size(); ++k) {
      if (line_[k] < 0) continue;
      const auto [place, fresh] = number.emplace(line_[k], static_cast<Index>(banks_.size()));
      if (fresh) banks_.resize(banks_.size() + 2);
      const std::array<Index, 2> e = ends(tangle_.hits[k]);
      for (Index side : {0, 1}) {
        banks_[place->second + side].contour = out_.contour[k];
        banks_[place->second + side].particles.push_back(e[side]);
      }
      line_[k] = place->second;
    }
  }

  /// Breadth first from all banks at once, over edges that are not cut.
  void fill_regions() {
    std::vector<std::uint8_t> cut(mesh_.n_cloth_edges, 0);
    for (std::size_t k = 0; k < tangle_.hits.size(); ++k)
      if (line_[k] >= 0) cut[tangle_.hits[k].edge] = 1;
    bank_of_.assign(x_.size(), -1);
    depth_.assign(x_.size(), 0);
    std::vector<Index> front;
    for (std::size_t b = 0; b < banks_.size(); ++b)
      for (Index i : banks_[b].particles) {
        if (bank_of_[i] >= 0) continue;
        bank_of_[i] = static_cast<Index>(b);
        front.push_back(i);
      }
    for (std::size_t k = 0; k < front.size(); ++k) {
      const Index i = front[k];
      ++banks_[bank_of_[i]].size;
      for (Index e : mesh_.point_edges[i]) {
        const Index j = mesh_.edge[e][0] == i ? mesh_.edge[e][1] : mesh_.edge[e][0];
        if (cut[e] || bank_of_[j] >= 0) continue;
        bank_of_[j] = bank_of_[i];
        depth_[j] = depth_[i] + 1;
        front.push_back(j);
      }
    }
  }

  void choose() {
    std::vector<Index> smallest(out_.n, -1);  // bank of each contour
    for (std::size_t b = 0; b < banks_.size(); ++b) {
      Index& best = smallest[banks_[b].contour];
      if (best < 0 || banks_[b].size < banks_[best].size) best = static_cast<Index>(b);
    }
    for (std::size_t k = 0; k < tangle_.hits.size(); ++k) {
      if (line_[k] < 0) continue;
      const Index side = smallest[out_.contour[k]] - line_[k];
      if (side == 0 || side == 1) out_.astray[k] = ends(tangle_.hits[k])[side];
    }
    for (std::size_t i = 0; i < x_.size(); ++i)
      if (bank_of_[i] >= 0 && depth_[i] <= kDepth && smallest[banks_[bank_of_[i]].contour] == bank_of_[i])
        out_.region[i] = banks_[bank_of_[i]].contour;
  }

  const ContactMesh& mesh_;
  const std::vector<Vector3d>& x_;
  const Tangle& tangle_;
  Contours out_;
  std::vector<Index> line_;  // per hit: first bank of its line, -1 where a body takes part
  std::vector<Bank> banks_;
  std::vector<Index> bank_of_, depth_;  // per particle
};

}  // namespace

Contours find_contours(const ContactMesh& mesh, const std::vector<Vector3d>& x, const Tangle& tangle) {
  return ContourSearch(mesh, x, tangle).run();
}

}  // namespace garment::simulator
