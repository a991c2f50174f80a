// Faces that lie inside another part of the same body. Whether a face is covered changes only where the
// surface passes through itself, so one winding number serves a whole patch between such places.
#include <algorithm>
#include <numeric>

#include "runtime/base/parallel.hpp"
#include "runtime/body/index.hpp"
#include "runtime/geometry/triangle_hit.hpp"

namespace garment::body {
namespace {

using Leaf = Body::Index::Leaf;

std::array<double, 6> box_of(const Leaf& leaf) {
  Vector3d low = leaf.corner[0].cwiseMin(leaf.corner[1]).cwiseMin(leaf.corner[2]);
  Vector3d high = leaf.corner[0].cwiseMax(leaf.corner[1]).cwiseMax(leaf.corner[2]);
  return {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()};
}

/// Boxes that only touch do not count: next-but-one triangles of a flat face do that.
bool overlap(const std::array<double, 6>& a, const std::array<double, 6>& b) {
  for (int k = 0; k < 3; ++k)
    if (a[k] >= b[k + 3] || b[k] >= a[k + 3]) return false;
  return true;
}

/// True where the plane of one triangle has the other wholly on one side.
bool plane_separates(const Leaf& a, const Leaf& b) {
  Vector3d normal = (a.corner[1] - a.corner[0]).cross(a.corner[2] - a.corner[0]);
  double low = 0, high = 0;
  for (int k = 0; k < 3; ++k) {
    double height = normal.dot(b.corner[k] - a.corner[0]);
    low = k == 0 ? height : std::min(low, height);
    high = k == 0 ? height : std::max(high, height);
  }
  return low > 0 || high < 0;
}

bool share_corner(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  for (int i : a)
    for (int j : b)
      if (i == j) return true;
  return false;
}

/// Triangles that meet one they share no corner with.
std::vector<char> find_crossing(const Body& body, const Body::Index& index) {
  std::vector<char> crossing(index.leaves.size(), 0);
  parallel_for(index.leaves.size(), 512, [&](std::size_t begin, std::size_t end) {
    std::vector<int> stack;
    for (std::size_t i = begin; i < end; ++i) {
      const Leaf& leaf = index.leaves[i];
      std::array<double, 6> box = box_of(leaf);
      stack.assign(1, 0);
      while (!stack.empty() && !crossing[i]) {
        const Body::Index::Node& node = index.nodes[stack.back()];
        stack.pop_back();
        for (int side = 0; side < 2; ++side) {
          if (!overlap(box, node.box[side])) continue;
          if (node.count[side] == 0 && node.child[side] >= 0) stack.push_back(node.child[side]);
          for (int k = 0; k < node.count[side]; ++k) {
            const Leaf& other = index.leaves[~node.child[side] + k];
            if (share_corner(body.mesh.triangles[leaf.triangle], body.mesh.triangles[other.triangle]))
              continue;
            if (!plane_separates(leaf, other) && !plane_separates(other, leaf) &&
                geometry::triangles_hit(leaf.corner, other.corner))
              crossing[i] = 1;
          }
        }
      }
    }
  });
  return crossing;
}

/// Patches of triangles that hang together by edges without a crossing triangle between.
class Patches {
 public:
  explicit Patches(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

}  // namespace

void mark_covered(const Body& body, Body::Index& index) {
  std::vector<char> crossing = find_crossing(body, index);
  std::vector<int> leaf_of(body.mesh.triangles.size());
  for (std::size_t i = 0; i < index.leaves.size(); ++i)
    leaf_of[index.leaves[i].triangle] = static_cast<int>(i);
  std::vector<std::array<int, 3>> edges;  // low vertex, high vertex, leaf
  edges.reserve(3 * body.mesh.triangles.size());
  for (std::size_t t = 0; t < body.mesh.triangles.size(); ++t) {
    if (crossing[leaf_of[t]]) continue;
    for (int k = 0; k < 3; ++k) {
      int a = body.mesh.triangles[t][k], b = body.mesh.triangles[t][(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), leaf_of[t]});
    }
  }
  std::sort(edges.begin(), edges.end());
  Patches patches(index.leaves.size());
  for (std::size_t i = 1; i < edges.size(); ++i)
    if (edges[i][0] == edges[i - 1][0] && edges[i][1] == edges[i - 1][1])
      patches.join(edges[i - 1][2], edges[i][2]);
  for (std::size_t i = 0; i < index.leaves.size(); ++i) {
    Leaf& leaf = index.leaves[i];
    int first = patches.find(static_cast<int>(i));
    if (first != static_cast<int>(i)) {  // its patch was asked before: `first` is the least of it
      leaf.covered = index.leaves[first].covered;
      continue;
    }
    const Vector3d& normal = index.normals[leaf.triangle][static_cast<int>(Feature::face)];
    Vector3d p = (leaf.corner[0] + leaf.corner[1] + leaf.corner[2]) / 3 + 1e-6 * index.length * normal;
    leaf.covered = body.winding(p) >= 0.5;
  }
}

}  // namespace garment::body
