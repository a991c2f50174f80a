#include "runtime/simulator/prolong.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/base/parallel.hpp"

namespace garment::simulator {
namespace {

using model::Index;
using model::Model;
using model::Vector2d;
using model::Vector3d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Triangles of one panel in square bins over its flat pattern.
class FlatIndex {
 public:
  FlatIndex(const Model& m, Index panel) : model_(m) {
    const model::PanelRange& range = m.panels[panel];
    first_ = range.first_triangle;
    end_ = range.first_triangle + range.n_triangles;
    for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v) {
      low_ = low_.cwiseMin(m.vertex_uv[v]);
      high_ = high_.cwiseMax(m.vertex_uv[v]);
    }
    double area = std::max(1e-12, (high_ - low_).prod());
    bin_ = std::max(1e-6, std::sqrt(2 * area / std::max<Index>(1, range.n_triangles)));
    nx_ = static_cast<int>((high_.x() - low_.x()) / bin_) + 1;
    ny_ = static_cast<int>((high_.y() - low_.y()) / bin_) + 1;
    bins_.resize(static_cast<std::size_t>(nx_) * ny_);
    for (Index t = first_; t < end_; ++t) {
      Vector2d a(1e300, 1e300), b(-1e300, -1e300);
      for (Index v : m.triangle[t]) {
        a = a.cwiseMin(m.vertex_uv[v]);
        b = b.cwiseMax(m.vertex_uv[v]);
      }
      for (int j = row(a.y()); j <= row(b.y()); ++j)
        for (int i = column(a.x()); i <= column(b.x()); ++i) bins_[static_cast<std::size_t>(j) * nx_ + i].push_back(t);
    }
  }

  /// Triangle that holds p, or the one it is least outside of, with p's barycentric coordinates.
  Index locate(const Vector2d& p, std::array<double, 3>& weights) const {
    Index best = -1;
    double least = -1e300;
    auto consider = [&](Index t) {
      std::array<double, 3> w = barycentric(t, p);
      double inside = std::min({w[0], w[1], w[2]});
      if (inside > least) least = inside, best = t, weights = w;
    };
    for (Index t : bins_[static_cast<std::size_t>(row(p.y())) * nx_ + column(p.x())]) consider(t);
    if (least < -0.5)  // an empty bin, or nothing near: look at all
      for (Index t = first_; t < end_; ++t) consider(t);
    return best;
  }

 private:
  int column(double x) const { return std::clamp(static_cast<int>((x - low_.x()) / bin_), 0, nx_ - 1); }
  int row(double y) const { return std::clamp(static_cast<int>((y - low_.y()) / bin_), 0, ny_ - 1); }
  std::array<double, 3> barycentric(Index t, const Vector2d& p) const {
    const auto& v = model_.triangle[t];
    const Vector2d &a = model_.vertex_uv[v[0]], &b = model_.vertex_uv[v[1]], &c = model_.vertex_uv[v[2]];
    double area = cross(b - a, c - a);
    if (area == 0) return {-1e9, -1e9, -1e9};
    double wb = cross(p - a, c - a) / area, wc = cross(b - a, p - a) / area;
    return {1 - wb - wc, wb, wc};
  }

  const Model& model_;
  Index first_ = 0, end_ = 0;
  Vector2d low_{1e300, 1e300}, high_{-1e300, -1e300};
  double bin_ = 1;
  int nx_ = 1, ny_ = 1;
  std::vector<std::vector<Index>> bins_;
};

}  // namespace

std::vector<Vector3d> prolong(const Model& coarse, const std::vector<Vector3d>& positions, const Model& fine) {
  std::vector<Vector3d> place(fine.n_vertices(), Vector3d::Zero());
  for (std::size_t p = 0; p < fine.panels.size(); ++p) {
    FlatIndex index(coarse, static_cast<Index>(p));
    const model::PanelRange& range = fine.panels[p];
    parallel_for(static_cast<std::size_t>(range.n_vertices), 512, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        auto v = static_cast<std::size_t>(range.first_vertex) + k;
        std::array<double, 3> w{};
        Index t = index.locate(fine.vertex_uv[v], w);
        if (t < 0) continue;
        for (int c = 0; c < 3; ++c) place[v] += w[c] * positions[coarse.vertex_particle[coarse.triangle[t][c]]];
      }
    });
  }
  std::vector<Vector3d> out(fine.n_particles(), Vector3d::Zero());
  std::vector<int> count(fine.n_particles(), 0);
  for (std::size_t v = 0; v < fine.n_vertices(); ++v) {
    out[fine.vertex_particle[v]] += place[v];
    ++count[fine.vertex_particle[v]];
  }
  for (std::size_t i = 0; i < out.size(); ++i)
    if (count[i] > 1) out[i] /= count[i];
  return out;
}

}  // namespace garment::simulator
