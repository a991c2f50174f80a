#include "runtime/model/flat_index.hpp"

#include <algorithm>
#include <cmath>

namespace garment::model {
namespace {

constexpr double kNothingNear = -0.5;  // least barycentric coordinate from which all triangles are looked at

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

FlatIndex::FlatIndex(const Model& m, Index panel) : model_(m) {
  const PanelRange& range = m.panels[panel];
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
      for (int i = column(a.x()); i <= column(b.x()); ++i)
        bins_[static_cast<std::size_t>(j) * nx_ + i].push_back(t);
  }
}

Index FlatIndex::locate(const Vector2d& p, std::array<double, 3>& weights) const {
  Index best = -1;
  double least = -1e300;
  auto consider = [&](Index t) {
    std::array<double, 3> w = barycentric(t, p);
    double inside = std::min({w[0], w[1], w[2]});
    if (inside > least) least = inside, best = t, weights = w;
  };
  for (Index t : bins_[static_cast<std::size_t>(row(p.y())) * nx_ + column(p.x())]) consider(t);
  if (least < kNothingNear)  // an empty bin, or nothing near: look at all
    for (Index t = first_; t < end_; ++t) consider(t);
  return best;
}

int FlatIndex::column(double x) const {
  return std::clamp(static_cast<int>((x - low_.x()) / bin_), 0, nx_ - 1);
}
int FlatIndex::row(double y) const { return std::clamp(static_cast<int>((y - low_.y()) / bin_), 0, ny_ - 1); }

std::array<double, 3> FlatIndex::barycentric(Index t, const Vector2d& p) const {
  const auto& v = model_.triangle[t];
  const Vector2d &a = model_.vertex_uv[v[0]], &b = model_.vertex_uv[v[1]], &c = model_.vertex_uv[v[2]];
  double area = cross(b - a, c - a);
  if (area == 0) return {-1e9, -1e9, -1e9};
  double wb = cross(p - a, c - a) / area, wc = cross(b - a, p - a) / area;
  return {1 - wb - wc, wb, wc};
}

}  // namespace garment::model
