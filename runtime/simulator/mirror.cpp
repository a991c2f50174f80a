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
constexpr double kUnlike = 0.02;     // relative difference of what the elements about two particles come to
constexpr double kUnlikeShare = 0.1; // of the particles that may be unlike
constexpr double kButton = 3;        // times as heavy as its image is a particle that carries a button
constexpr double kUneven = 3e-3;     // share by which a panel may have more on one side
constexpr double kUnevenFits = 0.02; // the same of fits and folds, of the garment
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

/// What the elements about each particle come to, [n_particles]: mass, kg; tensile and shear stiffness, N/m; rigidity of bends and
/// of twist, N m; of fits times their area, N m^3; folds and creases, rad.
enum Trait { kMass, kTensile, kShear, kBend, kFit, kTwist, kFold, kTraits };
using Traits = std::array<double, kTraits>;

std::vector<Traits> traits(const Model& m) {
  std::vector<Traits> out(m.n_particles(), Traits{});
  auto add = [&](Trait trait, const auto& particles, double value) {
    for (Index i : particles) out[static_cast<std::size_t>(i)][trait] += value;
  };
  std::vector<double> slope;  // dN/dstrain of each law at rest
  for (const model::TensileLaw& law : m.laws) {
    const auto at = std::find(law.strain.begin(), law.strain.end(), 0.0);
    slope.push_back(at == law.strain.end() ? law.slope.front() : law.slope[static_cast<std::size_t>(at - law.strain.begin())]);
  }
  auto of_law = [&](Index law) { return slope[static_cast<std::size_t>(law)]; };
  for (std::size_t i = 0; i < m.n_particles(); ++i) out[i][kMass] = m.mass[i];
  for (std::size_t k = 0; k < m.spring.size(); ++k) add(kTensile, m.spring[k], of_law(m.spring_law[k]) * m.spring_width[k] / m.spring_rest[k]);
  for (std::size_t k = 0; k < m.cell.size(); ++k) {
    add(kShear, m.cell[k], m.cell_shear[k]);
    add(kTwist, m.cell[k], m.cell_twist[k]);
  }
  for (std::size_t k = 0; k < m.membrane.size(); ++k) {
    add(kTensile, m.membrane[k], of_law(m.membrane_law[k][0]) + of_law(m.membrane_law[k][1]));
    add(kShear, m.membrane[k], m.membrane_shear[k]);
  }
  for (std::size_t k = 0; k < m.bend.size(); ++k) add(kBend, m.bend[k], m.bend_rigidity[k] * m.bend_width[k] / m.bend_lengths[k].sum());
  for (std::size_t k = 0; k + 1 < m.fit_begin.size(); ++k) {
    const double rigidity = m.fit_area[k] * (m.fit_rigidity[k][0] + m.fit_rigidity[k][1] + m.fit_rigidity[k][2]);
    for (Index j = m.fit_begin[k]; j < m.fit_begin[k + 1]; ++j)
      add(kFit, std::array<Index, 1>{m.fit_particle[static_cast<std::size_t>(j)]}, rigidity / (m.fit_begin[k + 1] - m.fit_begin[k]));
  }
  for (std::size_t k = 0; k < m.crease_bend.size(); ++k)
    add(kFold, m.bend[static_cast<std::size_t>(m.crease_bend[k])], std::abs(m.crease_angle[k]));
  for (Index fit : m.fold_fit)
    for (Index j = m.fit_begin[static_cast<std::size_t>(fit)]; j < m.fit_begin[static_cast<std::size_t>(fit) + 1]; ++j)
      add(kFold, std::array<Index, 1>{m.fit_particle[static_cast<std::size_t>(j)]}, 1);
  return out;
}

/// Grids of two sides may divide alike cloth otherwise between neighbours, beside pleats and seams; all in all each panel must have
/// as much of all on the one side as on the other.
bool same_cloth(const Model& m, const std::vector<Index>& image) {
  const std::vector<Traits> trait = traits(m);
  std::vector<Index> panel(m.n_particles(), 0);
  for (std::size_t v = m.n_vertices(); v-- > 0;) panel[static_cast<std::size_t>(m.vertex_particle[v])] = m.vertex_panel[v];
  for (std::size_t k = 0; k < kTraits; ++k) {
    // The particles of a fit are chosen among neighbours that are as near, on both sides of seams: only the sum tells.
    const bool scattered = k == kFit || k == kFold;
    std::vector<double> more(m.panels.size(), 0), all(m.panels.size(), 0);  // on the wearer's left, by panel
    std::size_t unlike = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
      const auto j = static_cast<std::size_t>(image[i]);
      const double here = trait[i][k], there = trait[j][k];
      if (!scattered && std::abs(here - there) > kUnlike * std::max(here, there)) ++unlike;
      if (k == kMass && here > kButton * there) return false;
      if (m.start[i].x() <= m.start[j].x()) continue;
      const std::size_t of = scattered ? 0 : static_cast<std::size_t>(panel[i]);
      more[of] += here - there;
      all[of] += here + there;
    }
    if (static_cast<double>(unlike) > kUnlikeShare * static_cast<double>(image.size())) return false;
    for (std::size_t p = 0; p < more.size(); ++p)
      if (std::abs(more[p]) > (scattered ? kUnevenFits : kUneven) * all[p]) return false;
  }
  return true;
}

bool same_particles(const Model& m, const std::vector<Index>& image) {
  const std::vector<double> pad = spread_out(m.n_particles(), m.pad_particle, m.pad_thickness);
  const std::vector<double> rub = spread_out(m.n_particles(), m.rub_particle, m.rub_factor);
  const std::vector<Held> hold = held(m);
  for (std::size_t i = 0; i < image.size(); ++i) {
    const auto j = static_cast<std::size_t>(image[i]);
    for (const std::vector<double>* of : {&m.thickness, &m.friction, &pad, &rub})
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
  Vectors force;
  elastic.follow(x);
  elastic.energy_and_force(x, force);
  double sum = 0;
  for (const Vector3d& f : force) sum += f.squaredNorm();
  const double usual = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, force.size())));
  std::size_t unlike = 0;
  for (std::size_t i = 0; i < image.size(); ++i)
    if (!alike(force[i], reflected(force[static_cast<std::size_t>(image[i])]), kAlike * usual)) ++unlike;
  if (static_cast<double>(unlike) > 2 * kUnlikeShare * static_cast<double>(image.size())) return false;
  // What pushes from outside has no grid to differ by.
  Loads loads(m);
  loads.follow(x);
  force.assign(x.size(), Vector3d::Zero());
  loads.add(force);
  double most = 0;
  for (const Vector3d& f : force) most = std::max(most, f.norm());
  for (std::size_t i = 0; i < image.size(); ++i)
    if (!alike(force[i], reflected(force[static_cast<std::size_t>(image[i])]), kAlike * most)) return false;
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
  if (image.empty() || !same_particles(model, image) || !same_cloth(model, image) || !same_forces(model, image)) return;
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

Mirror Mirror::where_even(const Vectors& x, double most) const {
  Mirror out = *this;
  for (std::size_t i = 0; i < image_.size(); ++i)
    if (image_[i] >= 0 && (x[i] - reflected(x[static_cast<std::size_t>(image_[i])])).norm() > most) out.image_[i] = -1;
  return out;
}

std::size_t Mirror::n_paired() const {
  return static_cast<std::size_t>(std::count_if(image_.begin(), image_.end(), [](Index i) { return i >= 0; }));
}

void Mirror::keep(Archive& a, std::size_t n_particles) {
  a.keep(image_);
  if (!a.reading() || !a.ok()) return;
  a.demand(image_.empty() || image_.size() == n_particles);
  for (std::size_t i = 0; a.ok() && i < image_.size(); ++i)
    a.demand(image_[i] >= -1 && image_[i] < static_cast<Index>(n_particles) &&
             (image_[i] < 0 || image_[static_cast<std::size_t>(image_[i])] == static_cast<Index>(i)));
  if (!a.ok()) image_.clear();
}

void Mirror::spread(std::vector<char>& marks) const {
  for (std::size_t i = 0; i < image_.size(); ++i)
    if (marks[i] != 0 && image_[i] >= 0) marks[static_cast<std::size_t>(image_[i])] = 1;
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
