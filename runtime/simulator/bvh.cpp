#include "runtime/simulator/bvh.hpp"

namespace garment::simulator {
namespace {

float center(const FloatBox& b, int axis) { return b.low[axis] + b.high[axis]; }

int widest(const std::vector<FloatBox>& boxes, const std::int32_t* begin, const std::int32_t* end) {
  std::array<float, 3> low{3e38f, 3e38f, 3e38f}, high{-3e38f, -3e38f, -3e38f};
  for (const std::int32_t* i = begin; i != end; ++i)
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], center(boxes[*i], k));
      high[k] = std::max(high[k], center(boxes[*i], k));
    }
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  return axis;
}

}  // namespace

void Bvh::build(const std::vector<FloatBox>& boxes) {
  nodes_.clear();
  leaves_.clear();
  leaf_boxes_.clear();
  order_.resize(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) order_[i] = static_cast<std::int32_t>(i);
  if (boxes.empty()) return;
  nodes_.reserve(boxes.size());
  split(0, static_cast<std::int32_t>(boxes.size()), boxes);
  refit(boxes);
}

void Bvh::split(std::int32_t begin, std::int32_t end, const std::vector<FloatBox>& boxes) {
  const std::size_t node = nodes_.size();
  nodes_.emplace_back();
  nodes_[node].begin = begin;
  nodes_[node].end = end;
  if (end - begin > kLeafSize) {
    const int axis = widest(boxes, order_.data() + begin, order_.data() + end);
    const std::int32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::int32_t i, std::int32_t j) {
                       const float x = center(boxes[i], axis), y = center(boxes[j], axis);
                       return x != y ? x < y : i < j;
                     });
    split(begin, middle, boxes);
    split(middle, end, boxes);
  } else {
    leaves_.push_back(static_cast<std::int32_t>(node));
  }
  nodes_[node].skip = static_cast<std::int32_t>(nodes_.size());
}

std::vector<FloatBox> Bvh::node_boxes(const std::vector<FloatBox>& boxes) const {
  if (boxes.empty()) return {};
  std::vector<FloatBox> out(nodes_.size());
  for (auto i = static_cast<std::int32_t>(nodes_.size()) - 1; i >= 0; --i) {  // children stand behind parents
    const Node& node = nodes_[i];
    if (is_leaf(i)) {
      for (std::int32_t k = node.begin; k < node.end; ++k) out[i].grow(boxes[order_[k]]);
    } else {
      out[i].grow(out[i + 1]);
      out[i].grow(out[nodes_[i + 1].skip]);
    }
  }
  return out;
}

void Bvh::refit(const std::vector<FloatBox>& boxes) {
  leaf_boxes_.resize(order_.size());
  for (std::size_t k = 0; k < order_.size(); ++k) leaf_boxes_[k] = boxes[order_[k]];
  const std::vector<FloatBox> all = node_boxes(boxes);
  for (std::size_t i = 0; i < nodes_.size(); ++i) nodes_[i].box = all[i];
}

}  // namespace garment::simulator
