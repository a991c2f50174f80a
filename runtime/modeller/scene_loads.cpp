#include "runtime/modeller/scene_loads.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "runtime/model/flat_index.hpp"

namespace garment::modeller {
namespace {

using model::Index;
using model::Vector3d;

constexpr double kRodStiffness = 5e4;  // N/m: 10 N draw it out by 0.2 mm
constexpr double kSheetDrag = 1.2;     // of a sheet square to the flow, where wind is stated alone (Hoerner 1965, 3-16)

/// A point of the cloth: corners of a triangle and their weights.
struct ClothPoint {
  model::Indices<3> particle{};
  std::array<double, 3> weight{};
};

class Loads {
 public:
  Loads(const std::vector<MeshedPanel>& panels, model::Model& model, Findings& findings)
      : panels_(panels), model_(model), findings_(findings) {}

  void force(const design::Force& f) {
    const std::optional<ClothPoint> place = place_of(f.panel, f.point);
    if (!place) return lost("force `" + f.name + "`", f.origin);
    for (int k = 0; k < 3; ++k) {
      if (place->weight[k] == 0) continue;
      model_.load_particle.push_back(place->particle[k]);
      model_.load_force.push_back(place->weight[k] * f.newtons);
    }
  }

  void constraint(const design::Constraint& c) {
    using Kind = design::Constraint::Kind;
    if (c.kind == Kind::distance || c.kind == Kind::equal) return rod(c);
    const Index particle = particle_next_to(panels_, model_, c.a.panel, c.a.point);
    if (particle < 0) return lost("`constrain`", c.origin);
    if (c.kind == Kind::on_plane) return hold(particle, c.through, c.along);
    const Vector3d across = c.along.unitOrthogonal();
    hold(particle, c.through, across);
    hold(particle, c.through, c.along.cross(across));
  }

 private:
  std::optional<ClothPoint> place_of(int panel, const design::Point2& point) const {
    if (panel < 0 || panel >= static_cast<int>(model_.panels.size()) || !point.allFinite()) return std::nullopt;
    ClothPoint place;
    const Index t = model::FlatIndex(model_, panel).locate(point, place.weight);
    if (t < 0) return std::nullopt;
    place.particle = model_.corners(static_cast<std::size_t>(t));
    double sum = 0;
    for (double& w : place.weight) sum += w = std::max(w, 0.0);  // beyond the border: on it
    for (double& w : place.weight) w /= sum;
    return place;
  }

  void rod(const design::Constraint& c) {
    const std::optional<ClothPoint> a = place_of(c.a.panel, c.a.point), b = place_of(c.b.panel, c.b.point);
    if (!a || !b) return lost("`constrain`", c.origin);
    const bool equal = c.kind == design::Constraint::Kind::equal;
    model_.closures.push_back({equal ? "constrain equal" : "constrain distance", c.origin, 0});
    model_.rod_tie.push_back(static_cast<Index>(model_.tie.size()));
    model_.tie.push_back({a->particle[0], a->particle[1], a->particle[2], b->particle[0], b->particle[1], b->particle[2]});
    model_.tie_weights.push_back({a->weight[0], a->weight[1], a->weight[2], b->weight[0], b->weight[1], b->weight[2]});
    model_.tie_length.push_back(equal ? 0 : c.length);
    model_.tie_stiffness.push_back(kRodStiffness);
    model_.tie_closure.push_back(static_cast<Index>(model_.closures.size() - 1));
  }

  void hold(Index particle, const Vector3d& point, const Vector3d& normal) {
    model_.hold_particle.push_back(particle);
    model_.hold_kind.push_back(model::HoldKind::plane);
    model_.hold_point.push_back(point);
    model_.hold_normal.push_back(normal.normalized());
  }

  void lost(const std::string& what, OriginId origin) {
    findings_.push_back({"G0652",
                         Severity::error,
                         what + " is not on the cloth of declared panels",
                         {{origin, ""}},
                         "name declared panels, and places or lines on them"});
  }

  const std::vector<MeshedPanel>& panels_;
  model::Model& model_;
  Findings& findings_;
};

void add_pressures(const design::Garment& garment, model::Model& model) {
  std::vector<double> pascals(model.panels.size(), 0);
  for (const design::Pressure& p : garment.scene.pressures)
    if (p.panel >= 0 && p.panel < static_cast<int>(pascals.size())) pascals[p.panel] += p.pascals;
  for (std::size_t t = 0; t < model.n_triangles(); ++t) {
    const double p = pascals[model.triangle_panel[t]];
    if (p == 0) continue;
    model.pressed_triangle.push_back(static_cast<Index>(t));
    model.pressed_pascals.push_back(p);
  }
}

/// Friction of one fabric with one body. Where a seam has made one particle of several cloths it is the mean of theirs. A region's
/// factor counts by its root, as it does in the geometric mean of cloth and body.
void add_body_pair(const design::FrictionPair& pair, const design::Garment& garment, const body::Body& body,
                   const std::vector<MeshedPanel>& panels, model::Model& model) {
  std::vector<double> sum(model.n_particles(), 0), own(model.n_particles(), 0);
  std::vector<int> n(model.n_particles(), 0);
  std::vector<bool> stated(model.n_particles(), false);
  for (std::size_t v = 0; v < model.n_vertices(); ++v) {
    const Index i = model.vertex_particle[v];
    const int fabric = panels[model.vertex_panel[v]].panel->fabric;
    const double friction = garment.fabrics[fabric].friction;
    stated[i] = stated[i] || fabric == pair.fabric;
    sum[i] += fabric == pair.fabric ? pair.factor : std::sqrt(body.friction * friction);
    own[i] += friction;
    ++n[i];
  }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (!stated[i]) continue;
    const double region = own[i] > 0 ? model.friction[i] * n[i] / own[i] : 1;
    model.rub_particle.push_back(static_cast<Index>(i));
    model.rub_body.push_back(pair.body);
    model.rub_factor.push_back(sum[i] / n[i] * std::sqrt(region));
  }
}

void add_cloth_pair(const design::FrictionPair& pair, const std::vector<MeshedPanel>& panels, model::Model& model) {
  for (std::size_t a = 0; a < panels.size(); ++a)
    for (std::size_t b = a; b < panels.size(); ++b) {
      const int fa = panels[a].panel->fabric, fb = panels[b].panel->fabric;
      if (!((fa == pair.fabric && fb == pair.other_fabric) || (fb == pair.fabric && fa == pair.other_fabric))) continue;
      model.rub_panels.push_back({static_cast<Index>(a), static_cast<Index>(b)});
      model.rub_panels_factor.push_back(pair.factor);
    }
}

}  // namespace

model::Index particle_next_to(const std::vector<MeshedPanel>& panels, const model::Model& model, int panel,
                              const design::Point2& point) {
  if (panel < 0 || panel >= static_cast<int>(panels.size()) || !point.allFinite()) return -1;
  const MeshedPanel& p = panels[panel];
  std::size_t nearest = 0;
  for (std::size_t v = 1; v < p.mesh.at.size(); ++v)
    if ((p.mesh.at[v] - point).squaredNorm() < (p.mesh.at[nearest] - point).squaredNorm()) nearest = v;
  return model.vertex_particle[p.first_vertex + nearest];
}

void add_scene_loads(const design::Garment& garment, const std::vector<body::Body>& bodies,
                     const std::vector<MeshedPanel>& panels, model::Model& model, Findings& findings) {
  const design::Scene& scene = garment.scene;
  Loads loads(panels, model, findings);
  for (const design::Force& f : scene.forces) loads.force(f);
  for (const design::Constraint& c : scene.constraints) loads.constraint(c);
  add_pressures(garment, model);
  for (const design::FrictionPair& pair : scene.frictions) {
    if (pair.body >= 0 && pair.body < static_cast<int>(bodies.size()))
      add_body_pair(pair, garment, bodies[pair.body], panels, model);
    else if (pair.body < 0)
      add_cloth_pair(pair, panels, model);
  }
  if (scene.wind) model.air = {scene.wind->velocity, scene.wind->gust, scene.drag.value_or(kSheetDrag)};
  if (scene.drag) model.air.drag = *scene.drag;
}

}  // namespace garment::modeller
