#include "runtime/simulator/mirror.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "runtime/simulator/elastic.hpp"
#include "runtime/simulator/loads.hpp"

namespace garment::simulator {
namespace {

using model::Index;
using model::Model;
using model::Vector2d;
using model::Vector3d;
using Vectors = std::vector<Vector3d>;

constexpr double kNear = 1e-4;       // m, between a place and the image of another
constexpr double kAlike = 1e-3;      // relative difference of what both sides have
constexpr double kShaken = 1e-3;     // m, by which the garment is shaken to compare its forces

Vector3d reflected(const Vector3d& p) { return {-p.x(), p.y(), p.z()}; }

/// Points by cells of a grid, for what lies within `kNear`. Looked up only: the order of the cells does not count.
template <int N>
class Places {
 public:
  using Point = Eigen::Matrix<double, N, 1>;
  explicit Places(std::vector<Point> points) : points_(std::move(points)) {
    for (std::size_t i = 0; i < points_.size(); ++i) cells_[key(cell(points_[i]))].push_back(static_cast<Index>(i));
  }
  /// The nearest within kNear; -1: none.
  Index nearest(const Point& p) const {
    Index best = -1;
    double least = kNear * kNear;
    const Cell at = cell(p);
    for (int k = 0; k < kAround; ++k) {
      Cell c = at;
      for (int a = 0, rest = k; a < N; ++a, rest /= 3) c[a] += rest % 3 - 1;
      const auto found = cells_.find(key(c));
      if (found == cells_.end()) continue;
      for (Index q : found->second)
        if (const double d = (points_[static_cast<std::size_t>(q)] - p).squaredNorm(); d < least) least = d, best = q;
    }
    return best;
  }

 private:
  using Cell = Eigen::Matrix<std::int64_t, N, 1>;
  static constexpr int kAround = N == 2 ? 9 : 27;
  static Cell cell(const Point& p) {
    Cell c;
    for (int a = 0; a < N; ++a) c[a] = static_cast<std::int64_t>(std::floor(std::clamp(p[a], -1e4, 1e4) / (2 * kNear)));
    return c;
  }
  static std::uint64_t key(const Cell& c) {
    std::uint64_t h = 0;
    for (int a = 0; a < N; ++a) h = h * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(c[a]);
    return h;
  }
  std::vector<Point> points_;
  std::unordered_map<std::uint64_t, std::vector<Index>> cells_;
};

/// Is each point's image a point too?
bool own_image(const Vectors& points) {
  const Places<3> places(points);
  return std::all_of(points.begin(), points.end(), [&](const Vector3d& p) { return places.nearest(reflected(p)) >= 0; });
}

/// A panel in the flat and in space.
struct Laid {
  std::vector<Vector2d> flat;                          ///< m, x counted from the middle of its width
  Vector3d centre = Vector3d::Zero();                  ///< of its start, m
};
std::vector<Laid> laid(const Model& m) {
  std::vector<Laid> out;
  for (const model::PanelRange& panel : m.panels) {
    Laid p;
    double low = 1e300, high = -1e300;
    for (Index v = panel.first_vertex; v < panel.first_vertex + panel.n_vertices; ++v) {
      const auto u = static_cast<std::size_t>(v);
      p.flat.push_back(m.vertex_uv[u]);
      p.centre += m.start[static_cast<std::size_t>(m.vertex_particle[u])] / std::max<Index>(1, panel.n_vertices);
      low = std::min(low, m.vertex_uv[u].x()), high = std::max(high, m.vertex_uv[u].x());
    }
    for (Vector2d& uv : p.flat) uv.x() -= 0.5 * (low + high);
    out.push_back(std::move(p));
  }
  return out;
}

/// The panel that is cut as the image of panel p and lies nearest to where that would lie, and its vertices in the order of p's
/// (counted from its first); empty where there is none.
std::pair<std::size_t, std::vector<Index>> image_of_panel(const std::vector<Laid>& panels, std::size_t p) {
  std::vector<std::size_t> order;
  for (std::size_t q = 0; q < panels.size(); ++q)
    if (panels[q].flat.size() == panels[p].flat.size()) order.push_back(q);
  auto far = [&](std::size_t q) { return (panels[q].centre - reflected(panels[p].centre)).squaredNorm(); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return far(a) < far(b); });
  for (std::size_t q : order) {
    const Places<2> places(panels[q].flat);
    std::vector<Index> vertices;
    for (const Vector2d& uv : panels[p].flat) {
      const Index found = places.nearest({-uv.x(), uv.y()});
      if (found < 0) break;
      vertices.push_back(found);
    }
    if (vertices.size() == panels[p].flat.size()) return {q, std::move(vertices)};
  }
  return {0, {}};
}

/// Of each particle its image by the cut of the panels, both ways; empty where one has none.
std::vector<Index> images(const Model& m) {
  const std::vector<Laid> panels = laid(m);
  std::vector<Index> image(m.n_particles(), -1);
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const auto [q, vertices] = image_of_panel(panels, p);
    if (vertices.empty()) return {};
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const Index i = m.vertex_particle[static_cast<std::size_t>(m.panels[p].first_vertex) + k];
      const Index j = m.vertex_particle[static_cast<std::size_t>(m.panels[q].first_vertex + vertices[k])];
      if (image[static_cast<std::size_t>(i)] >= 0 && image[static_cast<std::size_t>(i)] != j) return {};
      image[static_cast<std::size_t>(i)] = j;
    }
  }
  for (std::size_t i = 0; i < image.size(); ++i)
    if (image[i] < 0 || image[static_cast<std::size_t>(image[i])] != static_cast<Index>(i)) return {};
  return image;
}

bool alike(double a, double b) { return std::abs(a - b) <= kAlike * std::max(std::abs(a), std::abs(b)); }
bool alike(const Vector3d& a, const Vector3d& b, double least) { return (a - b).norm() <= kAlike * std::max(a.norm(), b.norm()) + least; }

/// Numbers by particle, as the arrays of a model list them; what is not listed has 0.
std::vector<double> spread_out(std::size_t n, const std::vector<Index>& particle, const std::vector<double>& value) {
  std::vector<double> out(n, 0);
  for (std::size_t k = 0; k < particle.size(); ++k) out[static_cast<std::size_t>(particle[k])] += value[k];
  return out;
}

/// What holds each particle: sums that tell unlike ones apart.
struct Held {
  int points = 0, planes = 0;
  Vector3d point = Vector3d::Zero();
  double off = 0;  // of planes from the origin, both sides of them alike
};
std::vector<Held> held(const Model& m) {
  std::vector<Held> out(m.n_particles());
  for (std::size_t h = 0; h < m.hold_particle.size(); ++h) {
    Held& at = out[static_cast<std::size_t>(m.hold_particle[h])];
    if (m.hold_kind[h] == model::HoldKind::point) {
      ++at.points;
      at.point += m.hold_point[h];
    } else {
      ++at.planes;
      at.off += std::abs(m.hold_normal[h].normalized().dot(m.hold_point[h]));
    }
  }
  return out;
}

bool same_particles(const Model& m, const std::vector<Index>& image) {
  const std::vector<double> pad = spread_out(m.n_particles(), m.pad_particle, m.pad_thickness);
  const std::vector<double> rub = spread_out(m.n_particles(), m.rub_particle, m.rub_factor);
  const std::vector<Held> hold = held(m);
  for (std::size_t i = 0; i < image.size(); ++i) {
    const auto j = static_cast<std::size_t>(image[i]);
    for (const std::vector<double>* of : {&m.mass, &m.thickness, &m.friction, &pad, &rub})
      if (!alike((*of)[i], (*of)[j])) return false;
    const Held &a = hold[i], &b = hold[j];
    if (a.points != b.points || a.planes != b.planes || !alike(a.point, reflected(b.point), kNear) || std::abs(a.off - b.off) > kNear) return false;
  }
  return true;
}

/// A garment that lies evenly, but bent and stretched everywhere: do its forces lie evenly too?
bool same_forces(const Model& m, const std::vector<Index>& image) {
  Vectors x(m.n_particles());
  std::uint32_t seed = 1;
  auto next = [&] { return kShaken * ((seed = seed * 1664525U + 1013904223U) / 2147483648.0 - 1); };
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto j = static_cast<std::size_t>(image[i]);
    if (j < i) continue;
    x[i] = 0.5 * (m.start[i] + reflected(m.start[j]));
    const double right = next(), up = next(), ahead = next();
    x[i] += Vector3d(right, up, ahead);
    if (j == i) x[i].x() = 0;
    x[j] = i == j ? x[i] : reflected(x[i]);
  }
  ElasticModel elastic(m);
  Loads loads(m);
  Vectors force;
  elastic.follow(x);
  elastic.energy_and_force(x, force);
  loads.follow(x);
  loads.add(force);
  double sum = 0;
  for (const Vector3d& f : force) sum += f.squaredNorm();
  const double usual = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, force.size())));
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!alike(force[i], reflected(force[static_cast<std::size_t>(image[i])]), kAlike * usual)) return false;
  return true;
}

bool same_scene(const Model& m, const std::vector<body::Body>& bodies) {
  if (m.gravity.x() != 0 || !m.motions.empty() || !m.rub_panels.empty() || (!m.air.still() && m.air.wind.x() != 0)) return false;
  return std::all_of(bodies.begin(), bodies.end(), [](const body::Body& b) { return own_image(b.mesh.vertices); });
}

}  // namespace

Mirror::Mirror(const Model& model, const std::vector<body::Body>& bodies) {
  if (!same_scene(model, bodies)) return;
  std::vector<Index> image = images(model);
  if (image.empty() || !same_particles(model, image) || !same_forces(model, image)) return;
  image_ = std::move(image);
}

Mirror Mirror::of_part(const std::vector<Index>& particle, const std::vector<char>& free) const {
  Mirror part;
  if (empty()) return part;
  part.image_.assign(particle.size(), -1);
  for (std::size_t k = 0; k < particle.size(); ++k) {
    const Index image = image_[static_cast<std::size_t>(particle[k])];
    const auto at = std::lower_bound(particle.begin(), particle.end(), image);
    if (at == particle.end() || *at != image) continue;
    const auto other = static_cast<std::size_t>(at - particle.begin());
    if (free[k] != 0 && free[other] != 0) part.image_[k] = static_cast<Index>(other);
  }
  return part;
}

void Mirror::spread(std::vector<char>& marks) const {
  for (std::size_t i = 0; i < image_.size(); ++i)
    if (marks[i] != 0) marks[static_cast<std::size_t>(image_[i])] = 1;
}

void Mirror::even(Vectors& force) const {
  for (std::size_t i = 0; i < image_.size(); ++i) {
    if (image_[i] < static_cast<Index>(i)) continue;
    const auto j = static_cast<std::size_t>(image_[i]);
    const Vector3d middle = 0.5 * (force[i] + reflected(force[j]));
    force[i] = middle;
    force[j] = reflected(middle);
  }
}

double Mirror::unevenness(const Vectors& x) const {
  double most = 0;
  for (std::size_t i = 0; i < image_.size(); ++i)
    if (image_[i] >= static_cast<Index>(i)) most = std::max(most, (x[i] - reflected(x[static_cast<std::size_t>(image_[i])])).squaredNorm());
  return std::sqrt(most);
}

void Mirror::even(const Vectors& x, Vectors& dx) const {
  for (std::size_t i = 0; i < image_.size(); ++i) {
    if (image_[i] < static_cast<Index>(i)) continue;
    const auto j = static_cast<std::size_t>(image_[i]);
    const Vector3d middle = 0.5 * (x[i] + dx[i] + reflected(x[j] + dx[j]));
    dx[i] = middle - x[i];
    dx[j] = reflected(middle) - x[j];
  }
}

}  // namespace garment::simulator
