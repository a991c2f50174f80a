#include "runtime/modeller/holds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "runtime/modeller/scene_loads.hpp"

namespace garment::modeller {
namespace {

using model::HoldKind;
using model::Index;
using model::Vector3d;

/// Holds by particle, so that no particle gets two.
class Holds {
 public:
  explicit Holds(std::size_t n_particles) : slot_(n_particles, -1) {}

  /// `motion`: what moves the hold, -1 for one that stays.
  void add(Index particle, HoldKind kind, const Vector3d& point, model::Model& model, Index motion = -1) {
    int& slot = slot_[particle];
    if (slot >= 0) {
      if (model.hold_kind[slot] == HoldKind::plane && kind == HoldKind::point) {
        model.hold_kind[slot] = kind;
        model.hold_point[slot] = point;
        motion_[slot] = motion;
      }
      return;
    }
    slot = static_cast<int>(model.hold_particle.size());
    model.hold_particle.push_back(particle);
    model.hold_kind.push_back(kind);
    model.hold_point.push_back(point);
    model.hold_normal.emplace_back(0, 1, 0);
    motion_.push_back(motion);
  }

  /// Who holds these particles: for its reaction.
  void tell(const std::string& name, OriginId origin, std::vector<Index> particles, model::Model& model) const {
    std::sort(particles.begin(), particles.end());
    particles.erase(std::unique(particles.begin(), particles.end()), particles.end());
    model.holders.push_back({name, origin, std::move(particles)});
  }

  void write_motions(model::Model& model) const {
    for (std::size_t h = 0; h < motion_.size(); ++h) {
      if (motion_[h] < 0) continue;
      model.moved_hold.push_back(static_cast<Index>(h));
      model.moved_by.push_back(motion_[h]);
    }
  }

 private:
  std::vector<int> slot_;
  std::vector<Index> motion_;  // of each hold
};

std::optional<double> level_height(const design::Attachment& a, const std::vector<body::Body>& bodies,
                                   Findings& findings) {
  for (const body::Body& body : bodies) {
    if (body.name != a.body) continue;
    auto level = body.levels.find(a.level);
    if (level != body.levels.end()) return level->second.height;
    std::string known;
    for (const auto& [name, unused] : body.levels) known += (known.empty() ? "" : ", ") + name;
    findings.push_back({"G0650",
                        Severity::error,
                        fmt::format("body `{}` has no level `{}`", a.body, a.level),
                        {{a.origin, ""}},
                        known.empty() ? "only bodies of people have levels" : "its levels are " + known});
    return std::nullopt;
  }
  findings.push_back({"G0650",
                      Severity::error,
                      fmt::format("there is no body `{}` to attach to", a.body),
                      {{a.origin, ""}},
                      "declare the body, or name one that is declared"});
  return std::nullopt;
}

void add_pin(const design::Pin& pin, const std::vector<MeshedPanel>& panels, Holds& holds,
             model::Model& model, Findings& findings) {
  if (pin.panel < 0 || pin.panel >= static_cast<int>(panels.size()) || !pin.point.allFinite()) {
    findings.push_back({"G0651",
                        Severity::error,
                        fmt::format("pin `{}` names no panel", pin.name),
                        {{pin.origin, ""}},
                        "name a declared panel and a point on it"});
    return;
  }
  const Index particle = particle_next_to(panels, model, pin.panel, pin.point);
  holds.add(particle, HoldKind::point, model.start[particle], model);
  holds.tell(pin.name, pin.origin, {particle}, model);
}

/// True where the region reaches: its border counts, whatever the last bits of a coordinate say.
bool reaches(const design::RegionTest& test, const design::Point2& p) {
  constexpr double kOnBorder = 1e-6;  // m
  for (const auto& [x, y] : {std::pair{0., 0.}, {kOnBorder, 0.}, {-kOnBorder, 0.}, {0., kOnBorder}, {0., -kOnBorder}})
    if (test.contains(p + design::Point2(x, y))) return true;
  return false;
}

/// Where the cloth leaves the jaws on the way from `inside` to `outside`, as a share of it.
double way_out(const design::RegionTest& test, const design::Point2& inside, const design::Point2& outside) {
  double in = 0, out = 1;
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (in + out);
    (reaches(test, inside + middle * (outside - inside)) ? in : out) = middle;
  }
  return in;
}

/// Jaws of one region on one panel: which of its particles they hold, and the bending where the cloth leaves them.
class Jaws {
 public:
  Jaws(const design::RegionTest& test, const MeshedPanel& panel, const model::Model& model)
      : test_(test), panel_(panel), vertex_(model.n_particles(), -1), held_(model.n_particles(), false) {
    for (std::size_t v = 0; v < panel.mesh.at.size(); ++v) {
      const Index particle = model.vertex_particle[panel.first_vertex + v];
      vertex_[particle] = static_cast<int>(v);
      held_[particle] = reaches(test, panel.mesh.at[v]);
    }
  }

  const std::vector<bool>& held() const { return held_; }

  /// A particle less than half a spacing outside is held too: the joint there is nearer to the jaws than that before it.
  void reach_on(const model::Model& model) {
    std::vector<Index> more;
    for (std::size_t k = 0; k < model.bend.size(); ++k)
      if (const auto way = leaving(model, k); way && way->outside > 0.5 - 1e-9) more.push_back(way->next);
    for (const Index particle : more) held_[particle] = true;
  }

  /// Between the jaws nothing bends: of the cloth that a joint stands for, from the middle of one segment to that of the next,
  /// only what is outside does. h- + h+ of the energy p B theta^2 / (h- + h+) is twice that. Without this a strip would be longer by
  /// up to a spacing, and its rigidity come out too small by three times as much of its length.
  void stiffen(model::Model& model) const {
    for (std::size_t k = 0; k < model.bend.size(); ++k) {
      const auto way = leaving(model, k);
      if (!way) continue;
      const Eigen::Vector2d& h = model.bend_lengths[k];
      const double before = way->forward ? h[0] : h[1], after = way->forward ? h[1] : h[0];
      // Outside the jaws of the half segment behind, and of the half segment ahead.
      const double free = std::min(0.5, 1 - way->behind) * before + std::max(0.0, 0.5 - way->outside) * after;
      model.bend_rigidity[k] *= h.sum() / (2 * std::max(free, 0.01 * h.sum()));
    }
  }

 private:
  struct Leaving {
    bool forward;     ///< the particle before is held, the one after is not
    Index next;       ///< the one that is not
    double outside;   ///< share of the way to it that lies in the jaws
    double behind;    ///< share of the way from the particle before to the joint that lies in the jaws; 1 where all of it does
  };

  /// The stencil, if it stands where the cloth leaves the jaws: two neighbours held, the third not.
  std::optional<Leaving> leaving(const model::Model& model, std::size_t k) const {
    const model::Indices<3>& at = model.bend[k];
    if (!held_[at[1]] || held_[at[0]] == held_[at[2]]) return std::nullopt;
    const bool forward = held_[at[0]];
    const Index before = forward ? at[0] : at[2], next = forward ? at[2] : at[0];
    if (vertex_[before] < 0 || vertex_[at[1]] < 0 || vertex_[next] < 0) return std::nullopt;  // across a seam
    const auto& flat = panel_.mesh.at;
    const design::Point2 &a = flat[vertex_[before]], &b = flat[vertex_[at[1]]], &c = flat[vertex_[next]];
    const bool joint_inside = reaches(test_, b);
    return Leaving{forward, next, joint_inside ? way_out(test_, b, c) : 0, joint_inside ? 1 : way_out(test_, a, b)};
  }

  const design::RegionTest& test_;
  const MeshedPanel& panel_;
  std::vector<int> vertex_;  // of each particle on this panel
  std::vector<bool> held_;
};

/// The particles between the jaws of a clamp; where they hold a region they stiffen the cloth at its border.
std::vector<Index> between_jaws(const design::Clamp& clamp, const design::Garment& garment,
                                const std::vector<BorderPanel>& outlines, const Borders& borders,
                                const std::vector<MeshedPanel>& panels, model::Model& model) {
  std::vector<Index> held;
  for (const design::EdgePart& part : clamp.parts)
    for (int v : vertices_on(part, outlines[part.panel], borders.panels[part.panel]))
      held.push_back(model.vertex_particle[panels[part.panel].first_vertex + v]);
  if (clamp.region < 0) return held;
  for (const design::RegionPart& part : garment.regions[clamp.region].parts) {
    const design::RegionTest test(garment.panels[part.panel], part.shape);
    Jaws jaws(test, panels[part.panel], model);
    jaws.reach_on(model);
    jaws.stiffen(model);
    for (std::size_t i = 0; i < model.n_particles(); ++i)
      if (jaws.held()[i]) held.push_back(static_cast<Index>(i));
  }
  return held;
}

/// The motion of a clamp turns about the middle of the box round what it holds: the same place on any grid.
Index add_motion(const design::Path& path, const std::vector<Index>& held, model::Model& model) {
  Vector3d low = Vector3d::Constant(1e300), high = -low;
  for (const Index i : held) {
    low = low.cwiseMin(model.start[i]);
    high = high.cwiseMax(model.start[i]);
  }
  model::Motion motion{path.name, path.origin, -1, 0.5 * (low + high), {}};
  for (const design::Pose& p : path.poses) motion.poses.push_back({p.time, p.move, p.turn});
  model.motions.push_back(std::move(motion));
  return static_cast<Index>(model.motions.size() - 1);
}

/// What lies between the jaws stays where it starts, or moves with them.
void add_clamp(const design::Clamp& clamp, const design::Garment& garment,
               const std::vector<BorderPanel>& outlines, const Borders& borders,
               const std::vector<MeshedPanel>& panels, Holds& holds, model::Model& model) {
  std::vector<Index> held = between_jaws(clamp, garment, outlines, borders, panels, model);
  const bool moves = clamp.path >= 0 && !held.empty();
  const Index motion = moves ? add_motion(garment.scene.paths[clamp.path], held, model) : -1;
  for (const Index particle : held) holds.add(particle, HoldKind::point, model.start[particle], model, motion);
  holds.tell(clamp.name, clamp.origin, std::move(held), model);
}

void add_body_motions(const design::Garment& garment, model::Model& model) {
  for (const design::Path& path : garment.scene.paths) {
    if (path.body < 0) continue;
    model::Motion motion{path.name, path.origin, path.body, garment.bodies[path.body].position, {}};
    for (const design::Pose& p : path.poses) motion.poses.push_back({p.time, p.move, p.turn});
    model.motions.push_back(std::move(motion));
  }
}

/// The motion of a body; -1 where it stands.
Index motion_of(const std::string& body, const design::Garment& garment, const model::Model& model) {
  for (std::size_t m = 0; m < model.motions.size(); ++m)
    if (model.motions[m].body >= 0 && garment.bodies[model.motions[m].body].name == body) return static_cast<Index>(m);
  return -1;
}

}  // namespace

void add_holds(const design::Garment& garment, const std::vector<body::Body>& bodies,
               const std::vector<BorderPanel>& outlines, const Borders& borders,
               const std::vector<MeshedPanel>& panels, model::Model& model, Findings& findings) {
  Holds holds(model.n_particles());
  add_body_motions(garment, model);
  for (const design::Attachment& a : garment.attachments) {
    std::optional<double> height;
    if (a.slide) {
      height = level_height(a, bodies, findings);
      if (!height) continue;
    }
    for (const design::EdgePart& part : a.parts) {
      if (part.panel < 0 || part.panel >= static_cast<int>(panels.size()) || part.edge < 0 ||
          part.edge >= static_cast<int>(panels[part.panel].panel->edges.size())) {
        findings.push_back({"G0650",
                            Severity::error,
                            fmt::format("attachment `{}` names an edge that does not exist", a.name),
                            {{a.origin, ""}},
                            "name edges of declared panels"});
        continue;
      }
      for (int v : vertices_on(part, outlines[part.panel], borders.panels[part.panel])) {
        Index particle = model.vertex_particle[panels[part.panel].first_vertex + v];
        Vector3d point = model.start[particle];
        if (height) point.y() = *height;
        holds.add(particle, a.slide ? HoldKind::plane : HoldKind::point, point, model, motion_of(a.body, garment, model));
      }
    }
  }
  for (const design::Clamp& clamp : garment.scene.clamps)
    if (!clamp.released) add_clamp(clamp, garment, outlines, borders, panels, holds, model);
  for (const design::Pin& pin : garment.pins) add_pin(pin, panels, holds, model, findings);
  holds.write_motions(model);
}

void take_holds(const model::Model& from, model::Model& model) {
  model.hold_particle = from.hold_particle;
  model.hold_kind = from.hold_kind;
  model.hold_point = from.hold_point;
  model.hold_normal = from.hold_normal;
  model.bend_rigidity = from.bend_rigidity;  // jaws stiffen the cloth where it leaves them
  model.moved_hold = from.moved_hold;
  model.moved_by = from.moved_by;
  model.motions = from.motions;
  model.holders = from.holders;
}

}  // namespace garment::modeller
