#pragma once
// Axis-aligned boxes over triangles in a binary tree, for exact tests: closed boxes, no margin, so touching
// is found.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace garment::geometry {

struct ClosedBox {
  Eigen::Vector3d low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};

  void grow(const Eigen::Vector3d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  void grow(const ClosedBox& b) {
    low = low.cwiseMin(b.low);
    high = high.cwiseMax(b.high);
  }
  bool meets(const ClosedBox& b) const {
    return low[0] <= b.high[0] && b.low[0] <= high[0] && low[1] <= b.high[1] && b.low[1] <= high[1] &&
           low[2] <= b.high[2] && b.low[2] <= high[2];
  }
};

/// Built once over fixed boxes by median splits; ties are broken by index, so the tree is the same on every
/// machine.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<ClosedBox>& boxes);

  bool empty() const { return nodes_.empty(); }

  /// Calls `found(i)` for every box i for which `wanted(box)` holds for it and for all its ancestors.
  template <class Wanted, class Found>
  void visit(const Wanted& wanted, const Found& found) const {
    if (nodes_.empty()) return;
    std::array<std::int32_t, 64> stack;  // median splits: the depth is at most 32
    int n = 0;
    stack[n++] = 0;
    while (n > 0) {
      const Node& node = nodes_[stack[--n]];
      if (!wanted(node.box)) continue;
      if (node.count == 0) {
        stack[n++] = node.first + 1;
        stack[n++] = node.first;
        continue;
      }
      for (std::int32_t k = node.first; k < node.first + node.count; ++k)
        if (wanted(boxes_[k])) found(order_[k]);
    }
  }

 private:
  struct Node {
    ClosedBox box;
    std::int32_t first = 0;  ///< of the two children, or of the boxes of a leaf
    std::int32_t count = 0;  ///< boxes in a leaf, 0 inside the tree
  };

  void fill(std::int32_t node, std::int32_t begin, std::int32_t end, const std::vector<ClosedBox>& boxes);

  std::vector<Node> nodes_;
  std::vector<std::int32_t> order_;
  std::vector<ClosedBox> boxes_;  ///< in the order of the leaves
};

}  // namespace garment::geometry
