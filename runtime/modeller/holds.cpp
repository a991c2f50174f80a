#include "runtime/modeller/holds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace garment::modeller {
namespace {

using model::HoldKind;
using model::Index;
using model::Vector3d;

/// Holds by particle, so that no particle gets two.
class Holds {
 public:
  explicit Holds(std::size_t n_particles) : slot_(n_particles, -1) {}

  void add(Index particle, HoldKind kind, const Vector3d& point, model::Model& model) {
    int& slot = slot_[particle];
    if (slot >= 0) {
      if (model.hold_kind[slot] == HoldKind::plane && kind == HoldKind::point) {
        model.hold_kind[slot] = kind;
        model.hold_point[slot] = point;
      }
      return;
    }
    slot = static_cast<int>(model.hold_particle.size());
    model.hold_particle.push_back(particle);
    model.hold_kind.push_back(kind);
    model.hold_point.push_back(point);
    model.hold_normal.emplace_back(0, 1, 0);
  }

 private:
  std::vector<int> slot_;
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

/// Border vertices that lie on a part of an edge.
std::vector<int> vertices_on(const design::EdgePart& part, const BorderPanel& outline, const Border& border) {
  std::vector<int> result;
  double low = std::min(part.from, part.to), high = std::max(part.from, part.to), slack = 0.2 * outline.h;
  auto n = static_cast<int>(border.at.size());
  for (int k = 0; k < n; ++k) {
    const Piece& piece = outline.outline.pieces[border.piece[k]];
    if (piece.edge != part.edge || piece.on != part.on) continue;
    auto inside = [&](double arc) { return arc >= low - slack && arc <= high + slack; };
    if (inside(border.arc_from[k]) && (result.empty() || result.back() != k)) result.push_back(k);
    if (inside(border.arc_to[k])) result.push_back(border.next[k]);
  }
  return result;
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
  const MeshedPanel& p = panels[pin.panel];
  std::size_t nearest = 0;
  for (std::size_t v = 1; v < p.mesh.at.size(); ++v)
    if ((p.mesh.at[v] - pin.point).squaredNorm() < (p.mesh.at[nearest] - pin.point).squaredNorm())
      nearest = v;
  Index particle = model.vertex_particle[p.first_vertex + nearest];
  holds.add(particle, HoldKind::point, model.start[particle], model);
}

/// True where the region reaches: its border counts, whatever the last bits of a coordinate say.
bool reaches(const design::RegionTest& test, const design::Point2& p) {
  constexpr double kOnBorder = 1e-6;  // m
  for (const auto& [x, y] : {std::pair{0., 0.}, {kOnBorder, 0.}, {-kOnBorder, 0.}, {0., kOnBorder}, {0., -kOnBorder}})
    if (test.contains(p + design::Point2(x, y))) return true;
  return false;
}

/// Between the jaws nothing bends. Where the cloth leaves them, at `b` of a stencil (a, b, c) with a and b held, only the half
/// towards c bends: h- + h+ of the energy p B psi^2 / (h- + h+) is h+ alone. Without this a strip would be longer by h / 2.
void stiffen_at_jaws(const std::vector<bool>& clamped, model::Model& model) {
  for (std::size_t k = 0; k < model.bend.size(); ++k) {
    const model::Indices<3>& at = model.bend[k];
    const bool before = clamped[at[0]], after = clamped[at[2]];
    if (!clamped[at[1]] || before == after) continue;
    const Eigen::Vector2d& h = model.bend_lengths[k];
    model.bend_rigidity[k] *= h.sum() / (before ? h[1] : h[0]);
  }
}

/// What lies between the jaws stays where it starts.
void add_clamp(const design::Clamp& clamp, const design::Garment& garment,
               const std::vector<BorderPanel>& outlines, const Borders& borders,
               const std::vector<MeshedPanel>& panels, Holds& holds, std::vector<bool>& clamped, model::Model& model) {
  auto hold = [&](int panel, std::size_t vertex) {
    Index particle = model.vertex_particle[panels[panel].first_vertex + vertex];
    clamped[particle] = true;
    holds.add(particle, HoldKind::point, model.start[particle], model);
  };
  for (const design::EdgePart& part : clamp.parts) {
    if (part.on == design::EdgePart::On::line) continue;  // told as not modelled
    for (int v : vertices_on(part, outlines[part.panel], borders.panels[part.panel]))
      hold(part.panel, static_cast<std::size_t>(v));
  }
  if (clamp.region < 0) return;
  for (const design::RegionPart& part : garment.regions[clamp.region].parts) {
    const design::RegionTest test(garment.panels[part.panel], part.shape);
    const MeshedPanel& p = panels[part.panel];
    for (std::size_t v = 0; v < p.mesh.at.size(); ++v)
      if (reaches(test, p.mesh.at[v])) hold(part.panel, v);
  }
}

}  // namespace

void add_holds(const design::Garment& garment, const std::vector<body::Body>& bodies,
               const std::vector<BorderPanel>& outlines, const Borders& borders,
               const std::vector<MeshedPanel>& panels, model::Model& model, Findings& findings) {
  Holds holds(model.n_particles());
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
        holds.add(particle, a.slide ? HoldKind::plane : HoldKind::point, point, model);
      }
    }
  }
  std::vector<bool> clamped(model.n_particles(), false);
  for (const design::Clamp& clamp : garment.scene.clamps)
    add_clamp(clamp, garment, outlines, borders, panels, holds, clamped, model);
  stiffen_at_jaws(clamped, model);
  for (const design::Pin& pin : garment.pins) add_pin(pin, panels, holds, model, findings);
}

}  // namespace garment::modeller
