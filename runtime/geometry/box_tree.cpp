#include "runtime/geometry/box_tree.hpp"

#include <algorithm>

namespace garment::geometry {
namespace {
constexpr std::int32_t kLeafSize = 4;
}

BoxTree::BoxTree(const std::vector<ClosedBox>& boxes) {
  if (boxes.empty()) return;
  order_.resize(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) order_[i] = static_cast<std::int32_t>(i);
  nodes_.reserve(boxes.size());
  nodes_.emplace_back();
  fill(0, 0, static_cast<std::int32_t>(boxes.size()), boxes);
  boxes_.reserve(boxes.size());
  for (std::int32_t i : order_) boxes_.push_back(boxes[i]);
}

void BoxTree::fill(std::int32_t node, std::int32_t begin, std::int32_t end,
                   const std::vector<ClosedBox>& boxes) {
  ClosedBox all, centers;
  for (std::int32_t k = begin; k < end; ++k) {
    const ClosedBox& b = boxes[order_[k]];
    all.grow(b);
    centers.grow(Eigen::Vector3d(b.low + b.high));
  }
  nodes_[node].box = all;
  if (end - begin <= kLeafSize) {
    nodes_[node].first = begin;
    nodes_[node].count = end - begin;
    return;
  }
  Eigen::Index axis = 0;
  (centers.high - centers.low).maxCoeff(&axis);
  const std::int32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::int32_t i, std::int32_t j) {
                     const double x = boxes[i].low[axis] + boxes[i].high[axis];
                     const double y = boxes[j].low[axis] + boxes[j].high[axis];
                     return x != y ? x < y : i < j;
                   });
  const auto child = static_cast<std::int32_t>(nodes_.size());
  nodes_[node].first = child;
  nodes_.emplace_back();
  nodes_.emplace_back();
  fill(child, begin, middle, boxes);
  fill(child + 1, middle, end, boxes);
}

}  // namespace garment::geometry
