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

constexpr double kMoved = 1e-6;                       // m, of a line, from which it counts
constexpr double kOnSample = 1e-9;                    // m

const design::Edge* find_edge(const std::vector<design::Edge>& edges, const std::string& name) {
  for (const design::Edge& edge : edges)
    if (edge.name == name) return &edge;
  return nullptr;
}

int samples_of(double length) {
  return std::clamp(static_cast<int>(length / kSampleLength), kFewestCorners, kMostCorners);
}

}  // namespace

PatternWarp::PatternWarp(const design::Panel& before, const design::Panel& now) {
  bool moved = false;
  for (const design::Edge& edge : now.edges) {
    const design::Edge* old = find_edge(before.edges, edge.name);
    const double length = edge.curve.length();
    if (old == nullptr || !(length > 0) || !(old->curve.length() > 0)) {
      at_.clear();
      move_.clear();
      return;
    }
    const int n = samples_of(length);
    for (int k = 0; k < n; ++k) {
      const double share = static_cast<double>(k) / n;
      const Point2 p = edge.curve.point_at(share * length),
                   q = old->curve.point_at(share * old->curve.length());
      at_.push_back(p);
      move_.push_back(q - p);
      moved = moved || q != p;
    }
  }
  const std::vector<Point2> ways = move_;
  if (!moved) move_.clear();
  add_lines(before, now);
  if (!samples_.empty()) move_ = ways;
}

void PatternWarp::add_lines(const design::Panel& before, const design::Panel& now) {
  bool moved = false;
  for (const design::Edge& line : now.lines) {
    const design::Edge* old = find_edge(before.lines, line.name);
    const double length = line.curve.length();
    if (old == nullptr || !(length > 0) || !(old->curve.length() > 0)) continue;
    const int n = samples_of(length);
    for (int k = 0; k <= n; ++k) {
      const double share = static_cast<double>(k) / n;
      const Point2 p = line.curve.point_at(share * length), q = old->curve.point_at(share * old->curve.length());
      samples_.push_back({p, q - by_outline(p), length / n});
      moved = moved || samples_.back().off.norm() > kMoved;
    }
  }
  if (!moved) return samples_.clear();
  for (std::size_t i = 0; i < at_.size(); ++i) {  // the outline stays where its own way leads
    const double length = (at_[(i + 1) % at_.size()] - at_[i]).norm();
    if (length > 0) samples_.push_back({at_[i], Point2(0, 0), length});
  }
}

Point2 PatternWarp::operator()(const Point2& p) const {
  const Point2 there = by_outline(p);
  if (samples_.empty()) return there;
  Point2 sum(0, 0);
  double weights = 0;
  for (const Sample& sample : samples_) {
    const double d = (p - sample.at).norm();
    if (d < kOnSample) return there + sample.off;
    const double w = sample.length / (d * d * d);
    sum += w * sample.off;
    weights += w;
  }
  return there + sum / weights;
}

Point2 PatternWarp::by_outline(const Point2& p) const {
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
