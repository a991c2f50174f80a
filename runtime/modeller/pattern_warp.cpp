#include "runtime/modeller/pattern_warp.hpp"

#include <algorithm>
#include <cmath>

namespace garment::modeller {
namespace {

using design::Point2;
using geometry::cross;

constexpr double kSampleLength = 0.02;                // m between two corners of the polygon
constexpr int kFewestCorners = 2, kMostCorners = 24;  // of an edge
constexpr double kFlatArea = 1e-14;                   // m^2, area of a triangle that is a line

const design::Edge* find_edge(const design::Panel& panel, const std::string& name) {
  for (const design::Edge& edge : panel.edges)
    if (edge.name == name) return &edge;
  return nullptr;
}

}  // namespace

PatternWarp::PatternWarp(const design::Panel& before, const design::Panel& now) {
  bool moved = false;
  for (const design::Edge& edge : now.edges) {
    const design::Edge* old = find_edge(before, edge.name);
    const double length = edge.curve.length();
    if (old == nullptr || !(length > 0) || !(old->curve.length() > 0)) {
      at_.clear();
      move_.clear();
      return;
    }
    const int n = std::clamp(static_cast<int>(length / kSampleLength), kFewestCorners, kMostCorners);
    for (int k = 0; k < n; ++k) {
      const double share = static_cast<double>(k) / n;
      const Point2 p = edge.curve.point_at(share * length),
                   q = old->curve.point_at(share * old->curve.length());
      at_.push_back(p);
      move_.push_back(q - p);
      moved = moved || q != p;
    }
  }
  if (!moved) move_.clear();
}

Point2 PatternWarp::operator()(const Point2& p) const {
  const std::size_t n = move_.size();
  if (n == 0) return p;
  Point2 sum(0, 0);
  double weights = 0;
  Point2 last = at_[n - 1] - p, here = at_[0] - p;
  double last_r = last.norm(), r = here.norm(), last_area = cross(last, here), last_dot = last.dot(here);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = i + 1 < n ? i + 1 : 0;
    const Point2 next = at_[j] - p;
    const double next_r = next.norm(), area = cross(here, next), dot = here.dot(next);
    if (r == 0) return p + move_[i];
    if (std::abs(area) < kFlatArea && dot < 0) return p + (next_r * move_[i] + r * move_[j]) / (r + next_r);
    double w = 0;
    if (std::abs(last_area) >= kFlatArea) w += (last_r - last_dot / r) / last_area;
    if (std::abs(area) >= kFlatArea) w += (next_r - dot / r) / area;
    sum += w * move_[i];
    weights += w;
    here = next;
    last_r = r, r = next_r, last_area = area, last_dot = dot;
  }
  return weights != 0 ? Point2(p + sum / weights) : p;
}

}  // namespace garment::modeller
