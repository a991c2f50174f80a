#include "runtime/modeller/clearing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "runtime/base/parallel.hpp"
#include "runtime/modeller/dressing.hpp"

namespace garment::modeller {
namespace {

using Eigen::Vector3d;
using model::Index;

constexpr double kDeepest = 0.3;      // m, how deep in the body a point may lie
constexpr double kGap = 4e-3;         // m, to which what pierces is pushed out
constexpr double kSampleStep = 8e-3;  // m, between the points looked at on a triangle
constexpr int kMostSamples = 40;      // along an edge
constexpr double kSideGap = 1e-3;     // m, of one leg's cloth from the middle
constexpr int kMostPushes = 60;
constexpr int kFollowSweeps = 4;       // Jacobi sweeps by which neighbours follow, after each push
constexpr double kMostPerPush = 0.02;  // m

}  // namespace

Clearing::Clearing(const body::Body& body, model::Model& model)
    : body_(body),
      x_(model.start),
      neighbours_(x_.size()) {
  std::set<std::array<Index, 2>> edges;
  for (std::size_t t = 0; t < model.n_triangles(); ++t) {
    auto c = model.corners(t);
    triangles_.push_back(c);
    for (int k = 0; k < 3; ++k)
      if (c[k] != c[(k + 1) % 3])
        edges.insert({std::min(c[k], c[(k + 1) % 3]), std::max(c[k], c[(k + 1) % 3])});
  }
  middles_.resize(triangles_.size());
  samples_.resize(triangles_.size());
  for (auto [a, b] : edges) neighbours_[a].push_back(b), neighbours_[b].push_back(a);
  for (const char* name : {"leg.left", "leg.right"})
    if (auto leg = body.parts.find(name); leg != body.parts.end() && !leg->second.sections.empty())
      legs_.push_back(&leg->second);
  find_sides(model);
}

std::size_t Clearing::go() {
  moved_.assign(x_.size(), Vector3d::Zero());
  pushed_.assign(x_.size(), false);
  std::vector<Push> pushes = find(0.5 * kGap);
  for (int round = 0; round < kMostPushes && !pushes.empty(); ++round) {
    apply(pushes);
    pushes = find(0.5 * kGap);
  }
  return find(0).size();
}

/// Points closer to the body than `gap`, triangle by triangle.
std::vector<Clearing::Push> Clearing::find(double gap) {
  constexpr std::size_t kGrain = 64;
  std::vector<std::vector<Push>> found((triangles_.size() + kGrain - 1) / kGrain);
  parallel_for(triangles_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) look_at(t, gap, found[begin / kGrain]);
  });
  std::vector<Push> all;
  for (const auto& f : found) all.insert(all.end(), f.begin(), f.end());
  return all;
}

void Clearing::look_at(std::size_t t, double gap, std::vector<Push>& out) {
  const model::Indices<3>& c = triangles_[t];
  const Vector3d &a = x_[c[0]], &b = x_[c[1]], &d = x_[c[2]];
  const double longest = std::max({(b - a).norm(), (d - b).norm(), (a - d).norm()});
  const Vector3d middle = (a + b + d) / 3;
  if (middles_[t].least(middle) > longest + gap) return;
  sound(middle, middles_[t]);
  if (middles_[t].distance > longest + gap) return;
  const int n = std::clamp(static_cast<int>(longest / kSampleStep), 1, kMostSamples);
  std::vector<Sounding>& known = samples_[t];
  if (known.size() != static_cast<std::size_t>((n + 1) * (n + 2) / 2)) known.assign((n + 1) * (n + 2) / 2, {});
  std::size_t k = 0;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j, ++k) {
      const std::array<double, 3> w{double(n - i - j) / n, double(i) / n, double(j) / n};
      const Vector3d p = w[0] * a + w[1] * b + w[2] * d;
      if (std::max(middles_[t].least(p), known[k].least(p)) >= gap) continue;
      const auto hit = sound(p, known[k]);
      if (hit && hit->distance < gap) out.push_back({c, w, way_out(p, *hit)});
    }
}

std::optional<body::SurfacePoint> Clearing::sound(const Vector3d& p, Sounding& last) const {
  auto hit = body_.closest(p, kDeepest);
  last = {p, hit ? hit->distance : kDeepest};
  return hit;
}

Vector3d Clearing::way_out(const Vector3d& p, const body::SurfacePoint& hit) const {
  Vector3d way = (kGap - hit.distance) * hit.normal;
  if (hit.distance < -kGap)  // on the surface itself the normal says where to go
    if (std::optional<Vector3d> out = out_of_leg(p)) way = *out;
  double length = way.norm();
  return length > kMostPerPush ? Vector3d(way * (kMostPerPush / length)) : way;
}

/// Away from the middle of the leg at this height: the seam inside the leg must end between the legs even
/// where the front of the thigh is nearer.
std::optional<Vector3d> Clearing::out_of_leg(const Vector3d& p) const {
  const body::Section* best = nullptr;
  for (const body::Part* leg : legs_) {
    const body::Section* level = nullptr;
    for (const body::Section& s : leg->sections)
      if (!level || std::abs(p.y() - s.center.y()) < std::abs(p.y() - level->center.y())) level = &s;
    if (!level || std::abs(p.y() - level->center.y()) > 0.02) continue;
    if (!best || std::abs(p.x() - level->center.x()) < std::abs(p.x() - best->center.x())) best = level;
  }
  if (!best) return std::nullopt;
  Vector3d d(p.x() - best->center.x(), 0, p.z() - best->center.z());
  if (d.norm() < 1e-3) return std::nullopt;
  d.normalize();
  for (double s = 0; s < 0.15; s += 2e-3)
    if (auto hit = body_.closest(p + s * d, kDeepest); !hit || hit->distance > 0)
      return Vector3d((s + kGap / 2) * d);
  return std::nullopt;
}

/// Corners take what the points of their triangles need (the least motion that does it), the mean over all
/// points.
void Clearing::apply(const std::vector<Push>& pushes) {
  std::vector<Vector3d> sum(x_.size(), Vector3d::Zero());
  std::vector<double> weight(x_.size(), 0);
  for (const Push& p : pushes) {
    double scale = 0;
    for (double w : p.weight) scale += w * w;
    for (int k = 0; k < 3; ++k) {
      sum[p.corner[k]] += p.weight[k] * p.weight[k] / scale * p.way;
      weight[p.corner[k]] += p.weight[k];
    }
  }
  std::vector<Vector3d> step(x_.size(), Vector3d::Zero());
  for (std::size_t i = 0; i < x_.size(); ++i)
    if (weight[i] > 0) step[i] = sum[i] / weight[i], pushed_[i] = true;
  std::vector<Vector3d> before = moved_;
  for (std::size_t i = 0; i < x_.size(); ++i) moved_[i] += step[i];
  for (int sweep = 0; sweep < kFollowSweeps; ++sweep) {
    std::vector<Vector3d> next = moved_;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      if (pushed_[i] || neighbours_[i].empty()) continue;
      Vector3d mean = Vector3d::Zero();
      for (Index j : neighbours_[i]) mean += moved_[j];
      next[i] += 0.5 * (mean / static_cast<double>(neighbours_[i].size()) - moved_[i]);
    }
    moved_.swap(next);
  }
  for (std::size_t i = 0; i < x_.size(); ++i) {
    x_[i] += moved_[i] - before[i];
    if (weight[i] > 0) keep_side(i);
    if (moved_[i] != before[i]) drop_last_bits(x_[i]);
  }
}

/// A particle is one leg's cloth where all its panels lie left, or right, of the middle.
void Clearing::find_sides(const model::Model& model) {
  side_.assign(x_.size(), 0);
  if (legs_.size() < 2) return;
  const Vector3d a = legs_[0]->sections.front().center, b = legs_[1]->sections.front().center;
  middle_ = (a.x() + b.x()) / 2;
  top_ = std::min(a.y(), b.y());
  std::vector<double> mean(model.panels.size(), 0);
  for (std::size_t v = 0; v < model.n_vertices(); ++v)
    mean[model.vertex_panel[v]] += x_[model.vertex_particle[v]].x() - middle_;
  std::vector<std::array<bool, 2>> held(x_.size(), {false, false});
  for (std::size_t v = 0; v < model.n_vertices(); ++v)
    held[model.vertex_particle[v]][mean[model.vertex_panel[v]] > 0 ? 1 : 0] = true;
  for (std::size_t i = 0; i < x_.size(); ++i)
    if (held[i][0] != held[i][1]) side_[i] = held[i][1] ? 1 : -1;
}

/// Cloth of one leg that is pushed between the legs stays on its side of the middle.
void Clearing::keep_side(std::size_t i) {
  double over = kSideGap - side_[i] * (x_[i].x() - middle_);
  if (side_[i] == 0 || over <= 0 || x_[i].y() > top_) return;
  x_[i].x() += side_[i] * over;
  moved_[i].x() += side_[i] * over;
}

bool starts_inside(const body::Body& body, model::Model& model) {
  return !body.parts.empty() && !body.mesh.triangles.empty() && Clearing(body, model).pierced() > 0;
}

std::size_t clear_start(const body::Body& body, model::Model& model) {
  if (body.parts.empty() || body.mesh.triangles.empty()) return 0;
  return Clearing(body, model).go();
}

}  // namespace garment::modeller
