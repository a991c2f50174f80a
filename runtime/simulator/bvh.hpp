#pragma once
// Flat tree of axis-aligned boxes in single precision, rounded outwards: made for moving parts, refitted in
// place.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace garment::simulator {

/// Box in single precision that surely contains what was put in.
struct FloatBox {
  std::array<float, 3> low{3e38f, 3e38f, 3e38f}, high{-3e38f, -3e38f, -3e38f};

  void grow(const Eigen::Vector3d& p) {
    for (int k = 0; k < 3; ++k) {
      const auto f = static_cast<float>(p[k]);
      const float pad = 1.3e-7f * std::fabs(f) + 1e-12f;  // more than the rounding of the conversion
      low[k] = std::min(low[k], f - pad);
      high[k] = std::max(high[k], f + pad);
    }
  }
  void grow(const FloatBox& b) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], b.low[k]);
      high[k] = std::max(high[k], b.high[k]);
    }
  }
  /// Larger by r on all sides.
  FloatBox inflated(double r) const {
    FloatBox out = *this;
    for (int k = 0; k < 3; ++k) {
      const float pad = static_cast<float>(r) * 1.000001f;
      out.low[k] -= pad + 1.3e-7f * (std::fabs(out.low[k]) + pad);
      out.high[k] += pad + 1.3e-7f * (std::fabs(out.high[k]) + pad);
    }
    return out;
  }
  /// Of a vector in this box from one in the other, at most; rounded up.
  float largest_difference(const FloatBox& b) const {
    float sum = 0;
    for (int k = 0; k < 3; ++k) {
      const float most = std::max(high[k] - b.low[k], b.high[k] - low[k]);
      sum += most * most;
    }
    return std::sqrt(sum) * 1.000001F;
  }
  bool meets(const FloatBox& b) const {
    return (low[0] <= b.high[0]) & (b.low[0] <= high[0]) & (low[1] <= b.high[1]) & (b.low[1] <= high[1]) &
           (low[2] <= b.high[2]) & (b.low[2] <= high[2]);
  }
};

/// Median-split tree over n boxes, stored depth first: the child of a node follows it, `skip` leads past its
/// subtree. The tree depends on nothing but the boxes (ties go by number).
class Bvh {
 public:
  static constexpr std::int32_t kLeafSize = 4;

  /// Builds the tree over items 0 .. n-1.
  void build(const std::vector<FloatBox>& boxes);
  /// Gives the same items new boxes; the tree keeps its shape.
  void refit(const std::vector<FloatBox>& boxes);

  bool empty() const { return nodes_.empty(); }
  std::size_t size() const { return order_.size(); }

  /// Calls found(item) for every item whose box meets `box`, in the order of the leaves.
  template <class Found>
  void query(const FloatBox& box, const Found& found) const {
    visit(box, 0, [&](std::int32_t begin, std::int32_t end) {
      for (std::int32_t k = begin; k < end; ++k)
        if (leaf_boxes_[k].meets(box)) found(order_[k]);
    });
  }

  std::size_t n_nodes() const { return nodes_.size(); }
  const FloatBox& box(std::size_t node) const { return nodes_[node].box; }
  /// Boxes of all nodes over other boxes of the same items.
  std::vector<FloatBox> node_boxes(const std::vector<FloatBox>& boxes) const;
  /// True where found(i, j) is true for two items i != j for whose nodes, and all nodes above those, apart(a, b) is not.
  template <class Apart, class Found>
  bool any_pair(const Apart& apart, const Found& found) const;

  /// Leaves hold at most kLeafSize items; leaf pairs below are numbered 0 .. n_leaves()-1.
  std::size_t n_leaves() const { return leaves_.size(); }
  /// Calls found(i, j) once for every two items that are nearer than `radius` along each axis, the first one
  /// in `leaf` and the second one in it or behind it.
  template <class Found>
  void query_pairs(std::size_t leaf, double radius, const Found& found) const {
    const Node& own = nodes_[leaves_[leaf]];
    std::array<FloatBox, kLeafSize> boxes;
    for (std::int32_t i = own.begin; i < own.end; ++i) boxes[i - own.begin] = leaf_boxes_[i].inflated(radius);
    visit(own.box.inflated(radius), own.begin, [&](std::int32_t begin, std::int32_t end) {
      for (std::int32_t i = own.begin; i < own.end; ++i)
        for (std::int32_t j = std::max(begin, i + 1); j < end; ++j)
          if (boxes[i - own.begin].meets(leaf_boxes_[j])) found(order_[i], order_[j]);
    });
  }

 private:
  struct Node {
    FloatBox box;
    std::int32_t begin = 0, end = 0;  // positions in order_
    std::int32_t skip = 0;            // the node after this subtree
  };
  void split(std::int32_t begin, std::int32_t end, const std::vector<FloatBox>& boxes);

  /// Calls found(begin, end) for the leaves from position `from` on whose boxes meet `box`.
  template <class Found>
  void visit(const FloatBox& box, std::int32_t from, const Found& found) const {
    const auto n = static_cast<std::int32_t>(nodes_.size());
    for (std::int32_t i = 0; i < n;) {
      const Node& node = nodes_[i];
      if (node.end <= from || !node.box.meets(box)) {
        i = node.skip;
        continue;
      }
      if (node.skip == i + 1) found(node.begin, node.end);
      ++i;
    }
  }

  bool is_leaf(std::int32_t node) const { return nodes_[node].skip == node + 1; }

  std::vector<Node> nodes_;
  std::vector<std::int32_t> order_;
  std::vector<std::int32_t> leaves_;  // their nodes
  std::vector<FloatBox> leaf_boxes_;  // of the items, in the order of the leaves
};

template <class Apart, class Found>
bool Bvh::any_pair(const Apart& apart, const Found& found) const {
  if (nodes_.empty()) return false;
  std::vector<std::pair<std::int32_t, std::int32_t>> open{{0, 0}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    if (apart(a, b)) continue;
    if (is_leaf(a) && is_leaf(b)) {
      for (std::int32_t i = nodes_[a].begin; i < nodes_[a].end; ++i)
        for (std::int32_t j = a == b ? i + 1 : nodes_[b].begin; j < nodes_[b].end; ++j)
          if (found(order_[i], order_[j])) return true;
      continue;
    }
    const bool split_a = !is_leaf(a) && (is_leaf(b) || nodes_[a].end - nodes_[a].begin >= nodes_[b].end - nodes_[b].begin);
    const std::int32_t split = split_a ? a : b, left = split + 1, right = nodes_[left].skip;
    if (a == b) {
      open.insert(open.end(), {{left, left}, {left, right}, {right, right}});
    } else if (split_a) {
      open.insert(open.end(), {{left, b}, {right, b}});
    } else {
      open.insert(open.end(), {{a, left}, {a, right}});
    }
  }
  return false;
}

}  // namespace garment::simulator
