#include "runtime/results/measures.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "runtime/base/parallel.hpp"

namespace garment::results {
namespace {

using model::Index;
using model::Model;
using model::State;
using model::Vector3d;

constexpr double kOnCurve = 1e-6;  // m

/// Distance of every particle to the nearest body, NaN where none is within reach; inside counts negative.
std::vector<double> distances(const Model& m, const State& state, const std::vector<body::Body>& bodies) {
  std::vector<std::optional<double>> found(m.n_particles());
  for (const body::Body& b : bodies) {
    if (!found.empty())
      (void)b.closest(state.position[0], kClearanceReach);  // collision trees want one warm-up query
    parallel_for(found.size(), 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        if (auto hit = b.closest(state.position[i], kClearanceReach))
          found[i] = found[i] ? std::min(*found[i], hit->distance) : hit->distance;
    });
  }
  std::vector<double> out(found.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = found[i].value_or(std::nan(""));
  return out;
}

std::optional<Clearance> clearance(const Model& m, const std::vector<double>& distance, Index first,
                                   Index n) {
  Clearance out{1e300, 0};
  double count = 0;
  for (Index v = first; v < first + n; ++v) {
    const double d = distance[m.vertex_particle[v]];
    if (std::isnan(d)) continue;
    out.least = std::min(out.least, d);
    out.mean += d;
    count += 1;
  }
  if (count == 0) return std::nullopt;
  out.mean /= count;
  return out;
}

double triangle_area(const Model& m, const State& state, std::size_t t) {
  const auto [a, b, c] = m.corners(t);
  const std::vector<Vector3d>& x = state.position;
  return 0.5 * (x[b] - x[a]).cross(x[c] - x[a]).norm();
}

}  // namespace

Measures measure(const Model& m, const State& state, const std::vector<body::Body>& bodies) {
  const std::vector<double> distance = distances(m, state, bodies);
  Measures out;
  out.all.panel = "all";
  for (const model::PanelRange& p : m.panels) {
    PanelMeasure panel{p.name, p.mass, p.area, 0, clearance(m, distance, p.first_vertex, p.n_vertices)};
    for (Index t = p.first_triangle; t < p.first_triangle + p.n_triangles; ++t)
      panel.draped_area += triangle_area(m, state, t);
    out.all.mass += panel.mass;
    out.all.flat_area += panel.flat_area;
    out.all.draped_area += panel.draped_area;
    out.panels.push_back(std::move(panel));
  }
  out.all.clearance = clearance(m, distance, 0, static_cast<Index>(m.n_vertices()));
  for (const model::SeamChain& s : m.seams) {
    SeamMeasure seam{s.name, s.length, 0, 0};
    for (std::size_t k = 1; k < s.particles.size(); ++k)
      seam.draped_length += (state.position[s.particles[k]] - state.position[s.particles[k - 1]]).norm();
    out.seams.push_back(std::move(seam));
  }
  for (const model::Closure& c : m.closures) {
    out.all.mass += c.mass;
    out.ties.push_back({c.name, 0});
  }
  for (std::size_t t = 0; t < m.tie.size(); ++t) {
    double& gap = out.ties[static_cast<std::size_t>(m.tie_closure[t])].gap;
    gap = std::max(gap, m.tie_span(t, state.position).norm() - m.tie_length[t]);
  }
  return out;
}

std::optional<double> draped_length(const Model& m, const State& state, Index panel,
                                    const geometry::Curve& curve, double from, double to) {
  const double low = std::min(from, to) - kOnCurve, high = std::max(from, to) + kOnCurve;
  struct Place {
    double at;
    Index particle;
  };
  std::vector<Place> places;
  const model::PanelRange& p = m.panels[panel];
  for (Index v = p.first_vertex; v < p.first_vertex + p.n_vertices; ++v) {
    const double at = curve.nearest(m.vertex_uv[v]);
    if (at < low || at > high || (curve.point_at(at) - m.vertex_uv[v]).norm() > kOnCurve) continue;
    places.push_back({at, m.vertex_particle[v]});
  }
  if (places.size() < 2) return std::nullopt;
  std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.at < b.at; });
  double length = 0;
  for (std::size_t k = 1; k < places.size(); ++k)
    length += (state.position[places[k].particle] - state.position[places[k - 1].particle]).norm();
  return length;
}

}  // namespace garment::results
