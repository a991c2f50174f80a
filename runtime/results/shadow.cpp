#include "runtime/results/shadow.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "runtime/base/portable_math.hpp"

namespace garment::results {
namespace {

using model::Index;
using model::Vector3d;

constexpr double kRow = 2e-4;       // m
constexpr double kLevel = 2e-3;     // m, a rim this level has no folds
constexpr double kRipple = 0.1;     // of the rim's range
constexpr double kDiscEdge = 6e-3;  // m below the disc's top that still belong to it: its edge is rounded by 5 mm

/// Where the triangle (x, z) meets the line z = row; nothing where it does not.
std::optional<std::pair<double, double>> span_at(const std::array<Vector3d, 3>& t, double row) {
  double low = 1e300, high = -1e300;
  for (int k = 0; k < 3; ++k) {
    const Vector3d &a = t[static_cast<std::size_t>(k)], &b = t[static_cast<std::size_t>((k + 1) % 3)];
    if ((a.z() < row) == (b.z() < row)) continue;
    const double x = a.x() + (row - a.z()) / (b.z() - a.z()) * (b.x() - a.x());
    low = std::min(low, x);
    high = std::max(high, x);
  }
  if (low > high) return std::nullopt;
  return std::pair(low, high);
}

double length_of_union(std::vector<std::pair<double, double>>& spans) {
  std::sort(spans.begin(), spans.end());
  double sum = 0, reached = -1e300;
  for (const auto& [low, high] : spans) {
    sum += std::max(0.0, high - std::max(low, reached));
    reached = std::max(reached, high);
  }
  return sum;
}

double shadow_of(const std::vector<std::array<Vector3d, 3>>& triangles) {
  if (triangles.empty()) return 0;
  double low = 1e300, high = -1e300;
  for (const auto& t : triangles)
    for (const Vector3d& p : t) low = std::min(low, p.z()), high = std::max(high, p.z());
  const auto rows = static_cast<std::size_t>(std::min((high - low) / kRow, 1e5)) + 1;
  const double step = (high - low) / static_cast<double>(rows);
  if (!(step > 0)) return 0;
  std::vector<std::vector<std::pair<double, double>>> spans(rows);
  for (const auto& t : triangles) {
    double a = std::min({t[0].z(), t[1].z(), t[2].z()}), b = std::max({t[0].z(), t[1].z(), t[2].z()});
    const auto first = static_cast<std::size_t>(std::max(0.0, std::floor((a - low) / step - 0.5)));
    const auto last = static_cast<std::size_t>(std::max(0.0, std::ceil((b - low) / step)));
    for (std::size_t r = first; r <= std::min(last, rows - 1); ++r)
      if (const auto span = span_at(t, low + (static_cast<double>(r) + 0.5) * step))
        spans[r].push_back(*span);
  }
  double sum = 0;
  for (auto& row : spans) sum += length_of_union(row) * step;
  return sum;
}

std::vector<std::array<Vector3d, 3>> triangles_of(const model::Model& model, const model::State& state,
                                                  Index panel) {
  const model::PanelRange& range = model.panels[static_cast<std::size_t>(panel)];
  std::vector<std::array<Vector3d, 3>> triangles;
  for (Index t = range.first_triangle; t < range.first_triangle + range.n_triangles; ++t) {
    const model::Indices<3> c = model.corners(static_cast<std::size_t>(t));
    triangles.push_back({state.position[static_cast<std::size_t>(c[0])],
                         state.position[static_cast<std::size_t>(c[1])],
                         state.position[static_cast<std::size_t>(c[2])]});
  }
  return triangles;
}

/// Area of the top of a body, seen from above, m^2.
double disc_area(const body::Body& body) {
  double top = -1e300;
  for (const Vector3d& p : body.mesh.vertices) top = std::max(top, p.y());
  std::vector<std::array<Vector3d, 3>> triangles;
  for (const auto& t : body.mesh.triangles) {
    std::array<Vector3d, 3> corners;
    bool flat = true;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = body.mesh.vertices[static_cast<std::size_t>(t[k])];
      flat = flat && corners[k].y() > top - kDiscEdge;
    }
    if (flat) triangles.push_back(corners);
  }
  return shadow_of(triangles);
}

bool lies_under(const body::Body& body, const Vector3d& middle) {
  Vector3d low = Vector3d::Constant(1e300), high = -low;
  for (const Vector3d& p : body.mesh.vertices) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return low.x() < middle.x() && middle.x() < high.x() && low.z() < middle.z() && middle.z() < high.z() &&
         high.y() < middle.y() + 0.02;
}

/// Vertices of the panel's border, in order: the longest loop.
std::vector<Index> rim_of(const model::Model& model, Index panel) {
  const model::PanelRange& range = model.panels[static_cast<std::size_t>(panel)];
  std::map<std::pair<Index, Index>, int> edges;
  for (Index t = range.first_triangle; t < range.first_triangle + range.n_triangles; ++t) {
    const model::Indices<3>& c = model.triangle[static_cast<std::size_t>(t)];
    for (std::size_t k = 0; k < 3; ++k) ++edges[{c[k], c[(k + 1) % 3]}];
  }
  std::map<Index, Index> next;
  for (const auto& [edge, count] : edges)
    if (!edges.contains({edge.second, edge.first})) next[edge.first] = edge.second;
  std::vector<Index> longest;
  std::map<Index, bool> seen;
  for (const auto& [start, unused] : next) {
    std::vector<Index> loop;
    for (Index at = start; !seen[at] && next.contains(at); at = next[at]) {
      seen[at] = true;
      loop.push_back(at);
    }
    if (loop.size() > longest.size()) longest = std::move(loop);
  }
  return longest;
}

}  // namespace

double shadow_area(const model::Model& model, const model::State& state, Index panel) {
  return shadow_of(triangles_of(model, state, panel));
}

std::optional<double> drape_coefficient(const model::Model& model, const model::State& state,
                                        const std::vector<body::Body>& bodies, Index panel) {
  const model::PanelRange& range = model.panels[static_cast<std::size_t>(panel)];
  Vector3d top(0, -1e300, 0), middle = Vector3d::Zero();
  for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v) {
    const Vector3d& p =
        state.position[static_cast<std::size_t>(model.vertex_particle[static_cast<std::size_t>(v)])];
    middle += p / range.n_vertices;
    if (p.y() > top.y()) top = p;
  }
  middle.y() = top.y();
  const body::Body* carrier = nullptr;
  for (const body::Body& body : bodies)
    if (!body.mesh.vertices.empty() && lies_under(body, middle)) carrier = &body;
  if (carrier == nullptr) return std::nullopt;
  const double disc = disc_area(*carrier);
  if (!(range.area > disc)) return std::nullopt;
  return (shadow_area(model, state, panel) - disc) / (range.area - disc);
}

std::optional<int> count_nodes(const model::Model& model, const model::State& state, Index panel) {
  const std::vector<Index> rim = rim_of(model, panel);
  if (rim.size() < 8) return std::nullopt;
  std::vector<double> height;
  for (Index v : rim)
    height.push_back(
        state.position[static_cast<std::size_t>(model.vertex_particle[static_cast<std::size_t>(v)])].y());
  const auto [low, high] = std::minmax_element(height.begin(), height.end());
  const double range = *high - *low;
  if (range < kLevel) return 0;
  double mean = 0;
  for (double h : height) mean += h / static_cast<double>(height.size());
  // A fold is counted where the height has gone below the mean by the ripple and then above it by as much.
  int folds = 0;
  bool below = false;
  for (std::size_t k = 0; k < 2 * height.size(); ++k) {
    const double h = height[k % height.size()];
    if (h < mean - kRipple * range) below = true;
    if (below && h > mean + kRipple * range) {
      below = false;
      if (k >= height.size()) ++folds;
    }
  }
  return folds;
}

}  // namespace garment::results
