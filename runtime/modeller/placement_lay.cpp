#include "runtime/modeller/placement_lay.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <map>
#include <optional>

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

/// How one panel comes onto another one in their patterns.
struct Fit {
  Motion motion;
  bool turned = false;     ///< face down
  Index on = 0, beside = 0;  ///< vertices on the other one, and outside of it
};

/// Which way is up in the pattern of a panel that has a place, unit; up in the pattern where it lies level.
Vector2d up_in_pattern(const model::Model& model, std::size_t panel, const std::vector<Vector3d>& place) {
  constexpr double kLevel = 0.1;  // of the rise of an upright panel
  const model::PanelRange& range = model.panels[panel];
  Vector2d rise = Vector2d::Zero();
  double area = 0;
  for (Index t = range.first_triangle; t < range.first_triangle + range.n_triangles; ++t) {
    const model::Indices<3>& c = model.triangle[t];
    Matrix2d sides;
    sides << (model.vertex_uv[c[1]] - model.vertex_uv[c[0]]).transpose(), (model.vertex_uv[c[2]] - model.vertex_uv[c[0]]).transpose();
    const double twice = sides.determinant();
    if (twice <= 0) continue;
    rise += twice * sides.inverse() * Vector2d(place[c[1]].y() - place[c[0]].y(), place[c[2]].y() - place[c[0]].y());
    area += twice;
  }
  return rise.norm() > kLevel * area ? rise.normalized() : Vector2d(0, 1);
}

/// Of two ways in which a straight seam fits, whether the panel lies face down. It lies where there is clearly more cloth under it;
/// else as it is drawn, its upper end up (a flap hangs from its upper edge, a welt stands on its lower one); else face up.
bool lies_turned(const Motion& plain, const Motion& over, double on_plain, double on_over, const Vector2d& up) {
  constexpr double kClearlyMore = 0.05;  // of the vertices: fewer lie on cloth or beside it by chance
  constexpr double kHigher = 0.1;        // of the length
  if (std::abs(on_plain - on_over) > kClearlyMore) return on_over > on_plain;
  return up.dot(over.turn.col(1)) > up.dot(plain.turn.col(1)) + kHigher;
}

/// `up` is a direction in the pattern of `other`. None where they share fewer than two particles.
std::optional<Fit> fit(const model::Model& model, std::size_t panel, std::size_t other, const std::vector<Vector3d>& flat_shape,
                       const model::FlatIndex& flat, const Vector2d& up) {
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
  if (here.size() < 2) return std::nullopt;
  const Motion plain = best_motion(here, there, false), over = best_motion(here, there, true);
  auto lies_on = [&](const Motion& motion) {  // vertices
    Index n = 0;
    std::array<double, 3> weights{};
    for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v)
      n += flat.locate(motion(own(v)), weights) >= 0 && *std::min_element(weights.begin(), weights.end()) > -1e-6;
    return n;
  };
  // A straight seam fits both ways.
  const double same = 1e-8 * static_cast<double>(here.size());  // m^2, a tenth of a millimetre each
  Fit found;
  const double all = range.n_vertices;
  found.turned = std::abs(plain.error - over.error) < same ? lies_turned(plain, over, lies_on(plain) / all, lies_on(over) / all, up)
                                                           : over.error < plain.error;
  found.motion = found.turned ? over : plain;
  found.on = lies_on(found.motion);
  found.beside = range.n_vertices - found.on;
  return found;
}

}  // namespace

bool turns_beyond(const model::Model& model, std::size_t panel, std::size_t other, const std::vector<Vector3d>& flat_shape) {
  constexpr double kBeside = 0.05;  // of its vertices
  const Vector2d drawn(0, 1);  // the other one may have no place yet
  const std::optional<Fit> found = fit(model, panel, other, flat_shape, model::FlatIndex(model, static_cast<Index>(other)), drawn);
  return found && found->turned && found->beside > kBeside * (found->on + found->beside);
}

bool lay_panel(const model::Model& model, std::size_t panel, std::size_t other, const std::vector<Vector3d>& flat_shape, double gap,
               std::vector<Vector3d>& place) {
  auto own = [&](Index v) -> Vector2d { return flat_shape[v].head<2>(); };
  const model::PanelRange& range = model.panels[panel];
  const model::FlatIndex flat(model, static_cast<Index>(other));
  const std::optional<Fit> found = fit(model, panel, other, flat_shape, flat, up_in_pattern(model, other, place));
  if (!found) return false;
  const Motion& motion = found->motion;
  const bool turned = found->turned;
  // Normals that run on from triangle to triangle: steps would let the panel cut the other one where that is bent.
  const model::PanelRange& under = model.panels[other];
  std::vector<Vector3d> normals(static_cast<std::size_t>(under.n_vertices), Vector3d::Zero());
  for (Index t = under.first_triangle; t < under.first_triangle + under.n_triangles; ++t) {
    const model::Indices<3>& c = model.triangle[t];
    const Vector3d normal = (place[c[1]] - place[c[0]]).cross(place[c[2]] - place[c[0]]).normalized();
    for (Index v : c) normals[v - under.first_vertex] += normal;
  }
  for (Vector3d& n : normals) n.normalize();
  for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v) {
    std::array<double, 3> weights{};
    const Index t = flat.locate(motion(own(v)), weights);
    if (t < 0) return false;
    const model::Indices<3>& c = model.triangle[t];
    Vector3d at = Vector3d::Zero(), normal = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      at += weights[k] * place[c[k]];
      normal += std::clamp(weights[k], 0.0, 1.0) * normals[c[k] - under.first_vertex];
    }
    const double above = turned ? -flat_shape[v].z() : flat_shape[v].z();
    place[v] = at + (gap + above) * normal.normalized();
  }
  return true;
}

}  // namespace garment::modeller
