#include "runtime/modeller/placement_lay.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "runtime/base/portable_math.hpp"
#include "runtime/model/flat_index.hpp"

namespace garment::modeller {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using model::Index;

/// A rigid motion of the plane, which may turn it over.
struct Motion {
  Matrix2d turn = Matrix2d::Identity();
  Vector2d from{0, 0}, to{0, 0};
  double error = 0;  // sum of squared distances
  Vector2d operator()(const Vector2d& p) const { return to + turn * (p - from); }
};

/// The motion that brings the points `here` best onto `there`.
Motion best_motion(const std::vector<Vector2d>& here, const std::vector<Vector2d>& there, bool over) {
  Motion motion;
  const auto n = static_cast<double>(here.size());
  for (std::size_t k = 0; k < here.size(); ++k) {
    motion.from += here[k] / n;
    motion.to += there[k] / n;
  }
  Matrix2d together = Matrix2d::Zero();
  for (std::size_t k = 0; k < here.size(); ++k) together += (there[k] - motion.to) * (here[k] - motion.from).transpose();
  const Eigen::JacobiSVD<Matrix2d> svd(together, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sense = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  motion.turn = svd.matrixU() * Vector2d(1, over ? -sense : sense).asDiagonal() * svd.matrixV().transpose();
  for (std::size_t k = 0; k < here.size(); ++k) motion.error += (motion(here[k]) - there[k]).squaredNorm();
  return motion;
}

constexpr double kHalfOpen = 1.7453292519943295;  // rad, 100 degrees between a collar and the stand that it is turned over
constexpr double kLiesOn = 0.95;                  // of its vertices that a panel has on the other one, or it reaches over it
constexpr double kLean = 0.5;                     // at the ends of the seam
constexpr double kLeanReach = 0.15;               // m, along the seam, within which it dies away
constexpr int kEvenings = 12;                     // of directions along the seam

/// A place along the seam from which a turned panel starts, and the ways off it there.
struct Hinge {
  Index here;         ///< vertex of the turned panel
  Vector3d at;        ///< m
  Vector3d down, out;  ///< back over the other panel, and off its face
  Vector3d lean{0, 0, 0};  ///< away from the near end of the seam, per length off the seam
};

/// What a panel is hinged on: the places that it shares with `other`, in pairs of neighbours along its border.
struct Hinges {
  std::vector<Hinge> all;
  std::vector<std::array<std::size_t, 2>> spans;
};

/// The mean normal of `other`, and the mean way from the seam into it, at each of its particles.
std::map<Index, std::array<Vector3d, 2>> frames_of(const model::Model& model, std::size_t other, const std::vector<Vector3d>& place) {
  std::map<Index, std::array<Vector3d, 2>> frames;
  const model::PanelRange& range = model.panels[other];
  for (Index t = range.first_triangle; t < range.first_triangle + range.n_triangles; ++t) {
    const model::Indices<3>& c = model.triangle[t];
    const Vector3d normal = (place[c[1]] - place[c[0]]).cross(place[c[2]] - place[c[0]]);
    const Vector3d middle = (place[c[0]] + place[c[1]] + place[c[2]]) / 3;
    for (Index v : c) {
      auto& f = frames.try_emplace(model.vertex_particle[v], std::array<Vector3d, 2>{Vector3d::Zero(), Vector3d::Zero()}).first->second;
      f[0] += normal;
      f[1] += middle - place[v];
    }
  }
  return frames;
}

Hinges find_hinges(const model::Model& model, std::size_t panel, std::size_t other, const std::vector<Vector3d>& place) {
  const auto frames = frames_of(model, other, place);
  std::map<Index, Index> of_other;  // particle to vertex
  const model::PanelRange &range = model.panels[panel], &under = model.panels[other];
  for (Index v = under.first_vertex; v < under.first_vertex + under.n_vertices; ++v) of_other.emplace(model.vertex_particle[v], v);
  Hinges hinges;
  std::map<Index, std::size_t> number;
  for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v) {
    const auto there = of_other.find(model.vertex_particle[v]);
    if (there == of_other.end()) continue;
    const std::array<Vector3d, 2>& f = frames.at(there->first);
    number[v] = hinges.all.size();
    hinges.all.push_back({v, place[there->second], f[1].normalized(), f[0].normalized()});
  }
  std::map<std::array<Index, 2>, int> edges;
  for (Index t = range.first_triangle; t < range.first_triangle + range.n_triangles; ++t)
    for (int k = 0; k < 3; ++k) {
      const Index a = model.triangle[t][k], b = model.triangle[t][(k + 1) % 3];
      ++edges[{std::min(a, b), std::max(a, b)}];
    }
  for (const auto& [edge, n] : edges)
    if (n == 1 && number.contains(edge[0]) && number.contains(edge[1])) hinges.spans.push_back({number[edge[0]], number[edge[1]]});
  for (int k = 0; k < kEvenings; ++k) {
    std::vector<Hinge> next = hinges.all;
    for (const auto& [a, b] : hinges.spans)
      for (auto [i, j] : {std::pair{a, b}, std::pair{b, a}}) {
        next[i].down += 0.5 * hinges.all[j].down;
        next[i].out += 0.5 * hinges.all[j].out;
      }
    for (Hinge& h : next) h.down.normalize(), h.out = (h.out - h.out.dot(h.down) * h.down).normalized();
    hinges.all.swap(next);
  }
  return hinges;
}

/// Near the ends of the seam the panel leans away from them: its points would meet those of the other end.
void lean_from_ends(const std::vector<Vector3d>& flat_shape, Hinges& hinges) {
  std::vector<std::vector<std::size_t>> next(hinges.all.size());
  for (const auto& [a, b] : hinges.spans) next[a].push_back(b), next[b].push_back(a);
  for (std::size_t end = 0; end < next.size(); ++end) {
    if (next[end].size() != 1) continue;
    double gone = 0;  // m, in the flat pattern
    for (std::size_t last = end, at = end; gone < kLeanReach;) {
      const std::size_t further = next[at][0] != last ? next[at][0] : next[at].back();
      if (further == last || further == end) break;
      hinges.all[at].lean += kLean * (1 - gone / kLeanReach) * (hinges.all[further].at - hinges.all[at].at).normalized();
      gone += (flat_shape[hinges.all[further].here] - flat_shape[hinges.all[at].here]).norm();
      last = at;
      at = further;
    }
  }
}

/// Turned over the seam, but half open: each vertex goes as far off the seam as it does in the flat pattern.
void hang_half_open(const model::Model& model, std::size_t panel, const Hinges& hinges, const std::vector<Vector3d>& flat_shape,
                    std::vector<Vector3d>& place) {
  auto own = [&](Index v) -> Vector2d { return flat_shape[v].head<2>(); };
  const model::PanelRange& range = model.panels[panel];
  for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v) {
    double nearest = 1e300;
    Vector3d at = place[v];
    for (const auto& [a, b] : hinges.spans) {
      const Hinge &from = hinges.all[a], &to = hinges.all[b];
      const Vector2d span = own(to.here) - own(from.here);
      const double share = std::clamp(span.dot(own(v) - own(from.here)) / span.squaredNorm(), 0.0, 1.0);
      const Vector2d foot = own(from.here) + share * span;
      const double off = (own(v) - foot).norm();
      if (off >= nearest) continue;
      nearest = off;
      // Beyond the ends of the seam the way goes on along it.
      const double along = span.dot(own(v) - foot) / span.norm(), across = std::sqrt(std::max(0.0, off * off - along * along));
      const Vector3d down = ((1 - share) * from.down + share * to.down).normalized();
      const Vector3d out = ((1 - share) * from.out + share * to.out).normalized();
      at = (1 - share) * from.at + share * to.at + along * (to.at - from.at).normalized() +
           across * (portable::cos(kHalfOpen) * down + portable::sin(kHalfOpen) * out + (1 - share) * from.lean + share * to.lean);
    }
    place[v] = at;
  }
}

}  // namespace

bool lay_panel(const model::Model& model, std::size_t panel, std::size_t other, const std::vector<Vector3d>& flat_shape, double gap,
               std::vector<Vector3d>& place) {
  auto own = [&](Index v) -> Vector2d { return flat_shape[v].head<2>(); };
  std::map<Index, Index> of_other;  // particle to vertex
  const model::PanelRange &range = model.panels[panel], &under = model.panels[other];
  for (Index v = under.first_vertex; v < under.first_vertex + under.n_vertices; ++v) of_other.emplace(model.vertex_particle[v], v);
  std::vector<Vector2d> here, there;
  for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v)
    if (const auto shared = of_other.find(model.vertex_particle[v]); shared != of_other.end()) {
      here.push_back(own(v));
      there.push_back(model.vertex_uv[shared->second]);
    }
  if (here.size() < 2) return false;
  const Motion plain = best_motion(here, there, false), over = best_motion(here, there, true);
  const model::FlatIndex flat(model, static_cast<Index>(other));
  auto lies_on = [&](const Motion& motion) {  // vertices
    int n = 0;
    std::array<double, 3> weights{};
    for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v)
      n += flat.locate(motion(own(v)), weights) >= 0 && *std::min_element(weights.begin(), weights.end()) > -1e-6;
    return n;
  };
  // A straight seam fits both ways: then the panel lies where there is more cloth under it.
  const double same = 1e-8 * static_cast<double>(here.size());  // m^2, a tenth of a millimetre each
  const bool turned = std::abs(plain.error - over.error) < same ? lies_on(over) > lies_on(plain) : over.error < plain.error;
  const Motion& motion = turned ? over : plain;
  if (turned && gap > 0 && lies_on(motion) < kLiesOn * range.n_vertices) {
    Hinges hinges = find_hinges(model, panel, other, place);
    if (!hinges.spans.empty()) {
      lean_from_ends(flat_shape, hinges);
      hang_half_open(model, panel, hinges, flat_shape, place);
      return true;
    }
  }
  // Normals that run on from triangle to triangle: steps would let the panel cut the other one where that is bent.
  std::vector<Vector3d> normals(static_cast<std::size_t>(under.n_vertices), Vector3d::Zero());
  for (Index t = under.first_triangle; t < under.first_triangle + under.n_triangles; ++t) {
    const model::Indices<3>& c = model.triangle[t];
    const Vector3d normal = (place[c[1]] - place[c[0]]).cross(place[c[2]] - place[c[0]]);
    for (Index v : c) normals[v - under.first_vertex] += normal.normalized();
  }
  for (Vector3d& n : normals) n.normalize();
  for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v) {
    std::array<double, 3> weights{};
    const Index t = flat.locate(motion(own(v)), weights);
    if (t < 0) return false;
    const model::Indices<3>& c = model.triangle[t];
    Vector3d normal = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) normal += std::clamp(weights[k], 0.0, 1.0) * normals[c[k] - under.first_vertex];
    place[v] = weights[0] * place[c[0]] + weights[1] * place[c[1]] + weights[2] * place[c[2]];
    const double above = turned ? -flat_shape[v].z() : flat_shape[v].z();
    if (normal.norm() > 0) place[v] += (gap + above) * normal.normalized();
  }
  return true;
}

}  // namespace garment::modeller
