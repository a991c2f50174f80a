#include "runtime/modeller/placement.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "runtime/base/number.hpp"
#include "runtime/base/portable_math.hpp"
#include "runtime/modeller/dressing.hpp"
#include "runtime/modeller/flat_start.hpp"
#include "runtime/modeller/placement_carry.hpp"
#include "runtime/modeller/placement_flared.hpp"
#include "runtime/modeller/placement_laps.hpp"
#include "runtime/modeller/placement_layers.hpp"
#include "runtime/modeller/ring_turn.hpp"
#include "runtime/modeller/wrap_curve.hpp"

namespace garment::modeller {
namespace {

using design::Placement;

/// Bounds of a panel's flat positions.
struct Extent {
  Vector2d low{1e300, 1e300}, high{-1e300, -1e300};
  double width() const { return high.x() - low.x(); }
};

Extent extent_of(const Workspace& w, std::size_t panel) {
  Extent e;
  for_each_vertex(w.model, panel, [&](model::Index v) {
    const Vector2d at = w.flat[v].head<2>();
    e.low = e.low.cwiseMin(at);
    e.high = e.high.cwiseMax(at);
  });
  return e;
}

/// There is another one of a pair, mirrored in x = 0.
bool has_image(const Workspace& w, std::size_t panel) {
  constexpr double kSame = 1e-6;  // m
  const std::optional<std::size_t> image = image_of(w.garment, panel);
  if (!image) return false;
  const Extent a = extent_of(w, panel), b = extent_of(w, *image);
  return std::abs(a.low.x() + b.high.x()) < kSame && std::abs(a.high.x() + b.low.x()) < kSame;
}

/// The x of the panel that comes to the middle of its part: the axis of what is symmetric, else its own middle.
double middle_x(const Workspace& w, std::size_t panel) {
  const design::Panel& p = w.garment.panels[panel];
  if (p.fold_x) return *p.fold_x;
  if (has_image(w, panel)) return 0;
  Extent e = extent_of(w, panel);
  return (e.low.x() + e.high.x()) / 2;
}

/// Mean y, by length, of the edges that go by `name` (a name means both of its halves, too).
std::optional<double> edge_height(const design::Panel& panel, const std::string& name) {
  double length = 0, sum = 0;
  for (const design::Edge& e : panel.edges) {
    if (e.name != name && e.name != "left." + name && e.name != "right." + name) continue;
    std::vector<geometry::Point2> line = e.curve.polyline(1e-4);
    for (std::size_t i = 1; i < line.size(); ++i) {
      double d = (line[i] - line[i - 1]).norm();
      length += d;
      sum += d * (line[i].y() + line[i - 1].y()) / 2;
    }
  }
  if (length == 0) return std::nullopt;
  return sum / length;
}

const body::Body* find_body(const Workspace& w, const std::string& name) {
  for (const body::Body& b : w.bodies)
    if (b.name == name) return &b;
  return w.bodies.empty() ? nullptr : &w.bodies.front();
}

void report(Workspace& w, std::size_t panel, const char* code, std::string message, std::string help) {
  const design::Panel& p = w.garment.panels[panel];
  OriginId at = p.placement.origin.value ? p.placement.origin : p.origin;
  w.findings.push_back({code, Severity::error, std::move(message), {{at, ""}}, std::move(help)});
}

/// Height in space of the panel's y = 0, from `with EDGE at LEVEL`; without them the panel's middle comes to `fallback`.
std::optional<double> base_height(Workspace& w, std::size_t panel, const body::Body& body, double fallback) {
  const design::Panel& p = w.garment.panels[panel];
  Extent e = extent_of(w, panel);
  if (p.placement.edge.empty() || p.placement.level.empty()) return fallback - (e.low.y() + e.high.y()) / 2;
  auto level = body.levels.find(p.placement.level);
  if (level == body.levels.end()) {
    report(w, panel, "G0601", fmt::format("body `{}` has no level `{}`", body.name, p.placement.level),
           "use a level of a person: waist, hip, bust, neck; plain shapes have none: place the panel `at (x, y, z)`");
    return std::nullopt;
  }
  std::optional<double> y = edge_height(p, p.placement.edge);
  if (!y) {
    report(w, panel, "G0602", fmt::format("panel `{}` has no edge `{}` to bring to the level", p.name, p.placement.edge),
           "name an edge of this panel after `with`");
    return std::nullopt;
  }
  return level->second.height - *y;
}

bool is_ring_part(const std::string& part) {
  return part.empty() || part == "front" || part == "back" || part == "left" || part == "right" || part == "torso";
}

bool wraps_torso(const Placement& p) {
  return (p.kind == Placement::Kind::on_part || p.kind == Placement::Kind::around) && is_ring_part(p.part);
}

/// Fraction of the girth line, from the front centre towards the wearer's left, at which a part's middle lies.
double ring_fraction(const std::string& part) {
  if (part == "back") return 0.5;
  if (part == "left") return 0.25;
  if (part == "right") return 0.75;
  return 0;
}

/// Penetration of a placed panel: how far its deepest particle would have to move to be `clearance` outside.
double shortfall(const Workspace& w, std::size_t panel, const body::Body& body, double clearance) {
  double worst = 0;
  for_each_vertex(w.model, panel, [&](model::Index v) {
    if (auto hit = body.closest(w.place[v], 0.15)) worst = std::max(worst, clearance - hit->distance);
  });
  return worst;
}

/// Panels that lie round the same body at heights that overlap, to be wrapped on one common girth line.
struct Ring {
  const body::Body* body = nullptr;
  std::vector<std::size_t> panels;
  std::vector<double> base;  ///< height of each panel's y = 0
  double low = 1e300, high = -1e300, offset = 0.01;
};

/// What lies round the body, side by side: not what lies over or under it.
double ring_width(const Workspace& w, const Ring& ring) {
  double total = 0, all = 0;
  for (std::size_t p : ring.panels) {
    const double width = extent_of(w, p).width();
    const bool layered = std::any_of(w.garment.stackings.begin(), w.garment.stackings.end(), [&](const design::Stacking& s) {
      return s.panel == static_cast<int>(p) && std::find(ring.panels.begin(), ring.panels.end(), static_cast<std::size_t>(s.other)) != ring.panels.end();
    });
    all += width;
    if (!layered) total += width;
  }
  return total > 0 ? total : all;
}

void lay_on(Workspace& w, const Ring& ring, const WrapCurve& curve) {
  for (std::size_t k = 0; k < ring.panels.size(); ++k) {
    std::size_t panel = ring.panels[k];
    double middle = middle_x(w, panel);
    double s0 = ring_fraction(w.garment.panels[panel].placement.part) * curve.length();
    for_each_vertex(w.model, panel, [&](model::Index v) {
      const Vector3d& flat = w.flat[v];
      const double s = s0 + flat.x() - middle;
      Vector2d p = curve.at(s);
      if (flat.z() != 0) p += flat.z() * curve.normal_at(s);
      w.place[v] = {p.x(), flat.y() + ring.base[k], p.y()};
    });
  }
}

bool wrap_ring(Workspace& w, const Ring& ring) {
  std::vector<Vector2d> points = torso_points(*ring.body, ring.low, ring.high);
  double x_low = 1e300, x_high = -1e300;
  for (const Vector2d& p : points) x_low = std::min(x_low, p.x()), x_high = std::max(x_high, p.x());
  if (points.size() < 3) {
    report(w, ring.panels.front(), "G0603",
           fmt::format("body `{}` has nothing between heights {} m and {} m to wrap panel `{}` on", ring.body->name,
                       format_number(ring.low, 4), format_number(ring.high, 4), w.garment.panels[ring.panels.front()].name),
           "check the level, or place the panel `at (x, y, z)`");
    return false;
  }
  double center = (x_low + x_high) / 2;
  double needed = ring_width(w, ring);
  std::vector<OnRing> on_ring;
  for (std::size_t k = 0; k < ring.panels.size(); ++k) on_ring.push_back({ring.panels[k], middle_x(w, ring.panels[k]), ring.base[k]});
  lift_laps(w, on_ring);
  double offset = ring.offset;
  // A garment wider than the body stands off it evenly: a girth line grown by d is longer by 2 pi d.
  double length = WrapCurve(points, center, offset).length();
  if (needed > length && ring.panels.size() > 1) offset += (needed - length) / (2 * portable::kPi);
  for (int attempt = 0; attempt < 12; ++attempt, offset += 0.01) {
    lay_on(w, ring, WrapCurve(points, center, offset));
    double deepest = 0;
    for (std::size_t p : ring.panels) deepest = std::max(deepest, shortfall(w, p, *ring.body, 0.003));
    if (deepest <= 0) {
      for (std::size_t p : ring.panels) w.done[p] = true;
      return true;
    }
  }
  report(w, ring.panels.front(), "G0604",
         fmt::format("panel `{}` still lies in body `{}` when wrapped 10 cm off it", w.garment.panels[ring.panels.front()].name,
                     ring.body->name),
         "check the level and the part it is placed on, or give a larger offset");
  return false;
}

/// Lays what hangs flared, and leaves in the ring what does not.
void take_flared(Workspace& w, Ring& ring) {
  const std::vector<std::size_t> flared = lay_flared(w, *ring.body, ring.panels);
  if (flared.empty()) return;
  Ring rest{.body = ring.body, .panels = {}, .base = {}, .offset = ring.offset};
  for (std::size_t k = 0; k < ring.panels.size(); ++k) {
    const std::size_t panel = ring.panels[k];
    if (std::find(flared.begin(), flared.end(), panel) != flared.end()) {
      w.done[panel] = true;
      continue;
    }
    const Extent e = extent_of(w, panel);
    rest.panels.push_back(panel);
    rest.base.push_back(ring.base[k]);
    rest.low = std::min(rest.low, ring.base[k] + e.low.y());
    rest.high = std::max(rest.high, ring.base[k] + e.high.y());
  }
  ring = std::move(rest);
}

bool place_rings(Workspace& w) {
  std::vector<Ring> rings;
  bool ok = true;
  for (std::size_t i = 0; i < w.garment.panels.size(); ++i) {
    const Placement& placement = w.garment.panels[i].placement;
    if (!wraps_torso(placement)) continue;
    const body::Body* body = find_body(w, placement.body);
    if (!body) {
      report(w, i, "G0605", fmt::format("panel `{}` is placed on a body, but there is none", w.garment.panels[i].name),
             "declare one: body form = bodies.woman(size: 40)");
      ok = false;
      continue;
    }
    double low = 1e300, high = -1e300;
    for (const Vector3d& p : body->mesh.vertices) low = std::min(low, p.y()), high = std::max(high, p.y());
    std::optional<double> base = base_height(w, i, *body, (low + high) / 2);
    if (!base) {
      ok = false;
      continue;
    }
    Extent e = extent_of(w, i);
    double y0 = *base + e.low.y(), y1 = *base + e.high.y();
    auto ring = std::find_if(rings.begin(), rings.end(), [&](const Ring& r) {
      if (r.body != body) return false;
      double overlap = std::min(r.high, y1) - std::max(r.low, y0);
      return overlap > 0.5 * std::min(r.high - r.low, y1 - y0);
    });
    if (ring == rings.end()) {
      rings.push_back({.body = body, .panels = {}, .base = {}, .offset = placement.offset});
      ring = rings.end() - 1;
    }
    ring->panels.push_back(i);
    ring->base.push_back(*base);
    ring->low = std::min(ring->low, y0);
    ring->high = std::max(ring->high, y1);
    ring->offset = std::max({ring->offset, placement.offset, 0.003});
  }
  for (Ring& ring : rings) {
    take_flared(w, ring);
    if (!ring.panels.empty()) ok = wrap_ring(w, ring) && ok;
  }
  return ok;
}

/// Rolls a panel round a limb: its middle on the outer side, its y along the axis towards the limb's root.
bool place_around_limb(Workspace& w, std::size_t panel) {
  const design::Panel& p = w.garment.panels[panel];
  const body::Body* body = find_body(w, p.placement.body);
  auto part = body ? body->parts.find(p.placement.part) : std::map<std::string, body::Part>::const_iterator{};
  if (!body || part == body->parts.end() || part->second.sections.size() < 2) {
    report(w, panel, "G0606", fmt::format("panel `{}` is placed on part `{}`, which {} has not", p.name, p.placement.part,
                                          body ? fmt::format("body `{}`", body->name) : "the scene"),
           "a person has front, back, torso, neck, arm.left, arm.right, leg.left and leg.right");
    return false;
  }
  const body::Section& root = part->second.sections.front();
  const body::Section& tip = part->second.sections.back();
  Vector3d axis = (tip.center - root.center).normalized();
  Vector3d outward = std::abs(root.center.x()) > 0.02 ? Vector3d(root.center.x() > 0 ? 1 : -1, 0, 0) : Vector3d(0, 0, 1);
  outward = (outward - outward.dot(axis) * axis).normalized();
  if (p.placement.part == "neck") outward = Vector3d(0, 0, -1) + axis.z() * axis, outward.normalize();
  Vector3d right = (-axis).cross(outward);
  double radius = 0;
  for (const body::Section& s : part->second.sections)
    for (const Vector2d& q : s.hull) {
      Vector3d r = s.center + q.x() * s.u + q.y() * s.v - root.center;
      radius = std::max(radius, (r - r.dot(axis) * axis).norm());
    }
  Extent e = extent_of(w, panel);
  double middle = middle_x(w, panel);
  radius = std::max(radius + std::max(p.placement.offset, 0.003), e.width() / (2 * portable::kPi));
  std::optional<double> top = e.high.y();
  if (!p.placement.edge.empty()) top = edge_height(p, p.placement.edge);
  if (!top) top = e.high.y();
  for_each_vertex(w.model, panel, [&](model::Index v) {
    const Vector3d& flat = w.flat[v];
    double angle = (flat.x() - middle) / radius;
    w.place[v] = root.center + (*top - flat.y()) * axis +
                 (radius + flat.z()) * (portable::cos(angle) * outward + portable::sin(angle) * right);
  });
  w.done[panel] = true;
  return true;
}

void place_rigid(Workspace& w, std::size_t panel) {
  const Placement& p = w.garment.panels[panel].placement;
  for_each_vertex(w.model, panel, [&](model::Index v) {
    w.place[v] = p.rotation * w.flat[v] + p.translation;
  });
  w.done[panel] = true;
}

/// Panels without a stated place are carried on from the panels they are sewn to, those with the longest seam first.
bool place_from_seams(Workspace& w) {
  bool any_placed = std::find(w.done.begin(), w.done.end(), true) != w.done.end();
  if (!any_placed && !w.done.empty() && w.bodies.empty()) {
    for (std::size_t i = 0; i < w.done.size(); ++i) place_rigid(w, i);  // no body, nothing stated: lie flat as drawn
    return true;
  }
  while (true) {
    if (lay_on_others(w)) continue;
    std::optional<std::size_t> best;
    std::size_t most = 1;
    for (std::size_t i = 0; i < w.done.size(); ++i) {
      if (w.done[i]) continue;
      std::size_t shared = count_shared_particles(w.model, i, w.done);
      const bool as_many = best && shared == most && w.garment.panels[i].name < w.garment.panels[*best].name;
      if (shared > most || as_many) most = shared, best = i;
    }
    if (!best) break;
    if (!carry_stand(w, *best)) carry_panel(w.model, *best, w.flat, w.done, w.place);
    w.done[*best] = true;
  }
  bool ok = true;
  for (std::size_t i = 0; i < w.done.size(); ++i) {
    if (w.done[i]) continue;
    report(w, i, "G0607", fmt::format("panel `{}` has no place: no `place` names it and no seam joins it to a placed panel",
                                      w.garment.panels[i].name),
           fmt::format("add: place {} on form.front with EDGE at form.waist, or place {} at (0 cm, 1 m, 20 cm)",
                       w.garment.panels[i].name, w.garment.panels[i].name));
    ok = false;
  }
  return ok;
}

void average_shared(const std::vector<Vector3d>& place, model::Model& model) {
  model.start.assign(model.n_particles(), Vector3d::Zero());
  std::vector<int> count(model.n_particles(), 0);
  for (std::size_t v = 0; v < model.n_vertices(); ++v) {
    model.start[model.vertex_particle[v]] += place[v];
    ++count[model.vertex_particle[v]];
  }
  for (std::size_t i = 0; i < model.n_particles(); ++i)
    if (count[i] > 1) model.start[i] /= count[i];
}

/// Largest length of a triangle's side over its length in the pattern.
double largest_stretch(const model::Model& model) {
  double most = 0;
  for (std::size_t t = 0; t < model.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k) {
      const model::Index v = model.triangle[t][k], w = model.triangle[t][(k + 1) % 3];
      const double length = (model.start[model.vertex_particle[v]] - model.start[model.vertex_particle[w]]).norm();
      most = std::max(most, length / (model.vertex_uv[v] - model.vertex_uv[w]).norm());
    }
  return most;
}

/// Brings the start out of the bodies. Panels that all lie on bodies are out already, but for what seams pull in: where that does not
/// come out whole, or only by being drawn out much more than the seams do, it stays as it is.
void clear_bodies(const std::vector<body::Body>& bodies, bool any_rigid, model::Model& model) {
  constexpr double kDrawnOut = 1.5;
  const std::vector<Vector3d> as_placed = model.start;
  const double stretch = largest_stretch(model);
  std::size_t pierced = 0;
  for (const body::Body& b : bodies)
    if (any_rigid || starts_inside(b, model)) pierced += clear_start(b, model);
  if (!any_rigid && (pierced > 0 || largest_stretch(model) > kDrawnOut * stretch)) model.start = as_placed;
}

}  // namespace

bool place_panels(const design::Garment& garment, const std::vector<body::Body>& bodies, const std::vector<SewnSides>& sides,
                  model::Model& model, Findings& findings, bool dress) {
  Workspace w{garment, bodies, model, findings, std::vector<Vector3d>(model.n_vertices(), Vector3d::Zero()),
              std::vector<bool>(garment.panels.size(), false), flat_start(garment, model)};
  bool ok = place_rings(w);
  for (std::size_t i = 0; i < garment.panels.size(); ++i) {
    const Placement& p = garment.panels[i].placement;
    if (p.kind == Placement::Kind::rigid) place_rigid(w, i);
    if ((p.kind == Placement::Kind::on_part || p.kind == Placement::Kind::around) && !is_ring_part(p.part))
      ok = place_around_limb(w, i) && ok;
  }
  bool any_rigid = std::any_of(garment.panels.begin(), garment.panels.end(), [](const design::Panel& p) {
    return p.placement.kind == Placement::Kind::rigid;
  });
  bool any_person =
      std::any_of(bodies.begin(), bodies.end(), [](const body::Body& b) { return !b.parts.empty(); });
  if (any_rigid)
    for (const body::Body& b : bodies) {
      lift_to_shoulders(garment, b, model, w.place);
      follow_arms(garment, b, model, w.place);
      follow_head(garment, b, model, w.place);
      follow_legs(garment, b, model, w.place);
      if (dress) clear_panels(garment, b, model, w.place);
    }
  if (any_rigid && any_person) part_panels(garment, model, w.place);
  for (Finding& finding : turned_rings(sides, model, w.done, w.place)) findings.push_back(std::move(finding));
  const bool spread = dress && any_rigid && any_person;
  if (spread && ok) {  // what is carried on goes on from there
    spread_seams(garment, model, w.done, {}, w.place);
    if (const auto necklines = even_necklines(w); !necklines.empty()) spread_seams(garment, model, w.done, necklines, w.place);
  }
  ok = ok && place_from_seams(w);
  if (spread && ok) spread_seams(garment, model, w.done, {}, w.place);
  average_shared(w.place, model);
  if (dress && any_person && ok) clear_bodies(bodies, any_rigid, model);
  if (dress && any_person && ok) part_cloth(w, model);
  return ok;
}

}  // namespace garment::modeller
