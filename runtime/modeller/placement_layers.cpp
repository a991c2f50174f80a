#include "runtime/modeller/placement_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

#include "runtime/geometry/self_crossings.hpp"
#include "runtime/modeller/dressing.hpp"
#include "runtime/modeller/flat_start.hpp"
#include "runtime/modeller/placement_carry.hpp"
#include "runtime/modeller/placement_lay.hpp"

namespace garment::modeller {
namespace {

using design::Placement;
using design::Stacking;
using Eigen::Vector3d;

/// Of the grid's spacing, between layers that lie over each other where both are bent: their triangles do not coincide.
constexpr double kGapOfGrid = 0.5;
constexpr std::size_t kMostTurnedPairs = 20'000;

bool has_own_place(const Workspace& w, int panel) { return w.garment.panels[panel].placement.kind != Placement::Kind::none; }

double gap_between(const Workspace& w, const Stacking& s) {
  return std::max(layer_gap(w.garment, s.panel), layer_gap(w.garment, s.other));
}

/// Stackings of panels that share a seam: those that share most first, then by names.
std::vector<Stacking> sewn_stackings(const Workspace& w) {
  std::vector<std::pair<std::size_t, Stacking>> sewn;
  for (const Stacking& s : w.garment.stackings) {
    std::vector<bool> other(w.garment.panels.size(), false);
    other[s.other] = true;
    if (const std::size_t shared = count_shared_particles(w.model, s.panel, other); shared > 1) sewn.emplace_back(shared, s);
  }
  auto name = [&](int panel) -> const std::string& { return w.garment.panels[panel].name; };
  std::sort(sewn.begin(), sewn.end(), [&](const auto& a, const auto& b) {
    return std::tie(b.first, name(a.second.panel), name(a.second.other), a.second.over) <
           std::tie(a.first, name(b.second.panel), name(b.second.other), b.second.over);
  });
  std::vector<Stacking> stackings;
  for (const auto& [shared, s] : sewn) stackings.push_back(s);
  return stackings;
}

/// Of each panel that lies on another one and shares a seam with it, what it lies on: each after that. Where panels are said to
/// lie on each other, the one with a place of its own lies below.
std::vector<Stacking> laid_in_order(const Workspace& w) {
  std::map<int, Stacking> of_panel;
  for (const Stacking& s : sewn_stackings(w)) of_panel.emplace(s.panel, s);
  std::vector<Stacking> waiting, order;
  for (const auto& [panel, s] : of_panel) waiting.push_back(s);
  std::sort(waiting.begin(), waiting.end(), [&](const Stacking& a, const Stacking& b) {
    return std::tuple(!has_own_place(w, a.panel), w.garment.panels[a.panel].name) <
           std::tuple(!has_own_place(w, b.panel), w.garment.panels[b.panel].name);
  });
  while (!waiting.empty()) {
    const auto free = std::find_if(waiting.begin(), waiting.end(), [&](const Stacking& s) {
      return std::none_of(waiting.begin(), waiting.end(), [&](const Stacking& t) { return t.panel == s.other; });
    });
    if (free != waiting.end()) order.push_back(*free);
    waiting.erase(free != waiting.end() ? free : waiting.begin());
  }
  return order;
}

/// Turns a panel over the seam with the one that it lies over, where it is to.
bool turn_panel(Workspace& w, const Stacking& s) {
  if (!s.over || !turns_beyond(w.model, s.panel, s.other, w.flat)) return false;
  HingedPanel turned(w.model, s.panel, s.other, s.over, w.done, w.flat);
  if (!turned.hinged()) return false;
  turned.lay(w.place);
  w.turned.push_back(std::move(turned));
  return true;
}

bool is_turned(const Workspace& w, int panel) {
  return std::any_of(w.turned.begin(), w.turned.end(), [&](const HingedPanel& t) { return t.panel() == static_cast<std::size_t>(panel); });
}

/// Another panel is to be turned over it.
bool is_stand(const Workspace& w, std::size_t panel) {
  return std::any_of(w.garment.stackings.begin(), w.garment.stackings.end(), [&](const Stacking& s) {
    return s.other == static_cast<int>(panel) && s.over && !w.done[s.panel] && turns_beyond(w.model, s.panel, s.other, w.flat);
  });
}

void take_places(const model::Model& model, std::vector<Vector3d>& place) {
  for (std::size_t v = 0; v < model.n_vertices(); ++v) place[v] = model.start[model.vertex_particle[v]];
}

/// Lays on the others anew the panels of `again` whose other has moved from `before` [n_particles], and, with more room, those
/// that have a place of their own.
void lay_again(Workspace& w, const std::vector<Stacking>& again, const std::vector<Vector3d>& before, model::Model& model) {
  take_places(model, w.place);
  std::vector<bool> lies(w.garment.panels.size(), false), held(model.n_particles(), false);
  for (const Stacking& s : again) lies[s.panel] = true;
  for (std::size_t v = 0; v < model.n_vertices(); ++v)
    if (!lies[model.vertex_panel[v]]) held[model.vertex_particle[v]] = true;
  for (const Stacking& s : again) {
    if (is_turned(w, s.panel)) continue;
    const bool own = has_own_place(w, s.panel);
    bool moved = own;
    for_each_vertex(w.model, s.other, [&](model::Index v) {
      moved = moved || model.start[model.vertex_particle[v]] != before[model.vertex_particle[v]];
    });
    double gap = gap_between(w, s);
    if (own) gap = std::max(gap, kGapOfGrid * w.garment.panels[s.panel].resolution);
    if (!moved || !lay_panel(w.model, s.panel, s.other, w.flat, s.over ? gap : -gap, w.place)) continue;
    for_each_vertex(w.model, s.panel, [&](model::Index v) {
      if (!held[model.vertex_particle[v]]) model.start[model.vertex_particle[v]] = w.place[v];
      held[model.vertex_particle[v]] = true;
    });
  }
}

geometry::SelfCrossings crossings_of(const model::Model& model) {
  std::vector<model::Indices<3>> triangles;
  for (std::size_t t = 0; t < model.n_triangles(); ++t) triangles.push_back(model.corners(t));
  return geometry::self_crossings(triangles, model.start, kMostTurnedPairs);
}

/// Lays what is turned over on the others as they lie now, and opens it until it crosses nothing, or can open no further.
void turn_again(Workspace& w, model::Model& model) {
  for (bool opened = true; opened;) {
    for (const HingedPanel& turned : w.turned) {
      take_places(model, w.place);
      turned.lay(w.place);
      for_each_vertex(model, turned.panel(), [&](model::Index v) { model.start[model.vertex_particle[v]] = w.place[v]; });
    }
    const geometry::SelfCrossings found = crossings_of(model);
    opened = false;
    for (HingedPanel& turned : w.turned) opened = turned.open(found.pairs) || opened;
  }
}

/// Says which panels cross, those that do so most first.
void tell_crossings(Workspace& w, const model::Model& model) {
  constexpr std::size_t kNamed = 3;
  const geometry::SelfCrossings found = crossings_of(model);
  if (found.count == 0) return;
  std::map<std::pair<std::string, std::string>, std::size_t> counts;
  std::map<std::string, OriginId> origins;
  for (const design::Panel& p : w.garment.panels) origins[p.name] = p.origin;
  for (const geometry::TrianglePair& pair : found.pairs) {
    const std::string &a = model.panels[model.triangle_panel[pair.first]].name, &b = model.panels[model.triangle_panel[pair.second]].name;
    ++counts[std::minmax(a, b)];
  }
  std::vector<std::pair<std::size_t, std::pair<std::string, std::string>>> most;
  for (const auto& [names, n] : counts) most.emplace_back(n, names);
  std::stable_sort(most.begin(), most.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string which;
  for (std::size_t k = 0; k < std::min(kNamed, most.size()); ++k) {
    const auto& [a, b] = most[k].second;
    which += fmt::format("{}`{}` {}", k > 0 ? ", " : "", a, a == b ? "itself" : fmt::format("and `{}`", b));
  }
  if (most.size() > kNamed) which += " ...";
  const auto& [a, b] = most[0].second;
  Finding finding{"G0608", Severity::warning, fmt::format("cloth starts through cloth that could not be parted: {}", which), {{origins[a], ""}},
                  "place them farther apart, or say which lies `over` the other; the drape tries to part them"};
  if (a != b) finding.labels.push_back({origins[b], ""});
  w.findings.push_back(std::move(finding));
}

}  // namespace

bool lay_on_others(Workspace& w) {
  for (const Stacking& s : sewn_stackings(w)) {
    if (w.done[s.panel] || !w.done[s.other]) continue;
    if (turn_panel(w, s)) return w.done[s.panel] = true;
    const double gap = gap_between(w, s);
    if (lay_panel(w.model, s.panel, s.other, w.flat, s.over ? gap : -gap, w.place)) return w.done[s.panel] = true;
  }
  return false;
}

std::vector<std::pair<model::Index, Vector3d>> even_necklines(const Workspace& w) {
  std::vector<std::pair<model::Index, Vector3d>> wanted;
  for (std::size_t p = 0; p < w.garment.panels.size(); ++p) {
    if (w.done[p] || !is_stand(w, p)) continue;
    const auto more = HingedPanel(w.model, p, w.done, w.flat).evenly_along_seam(w.place);
    wanted.insert(wanted.end(), more.begin(), more.end());
  }
  return wanted;
}

bool carry_stand(Workspace& w, std::size_t panel) {
  if (!is_stand(w, panel)) return false;
  const HingedPanel stand(w.model, panel, w.done, w.flat);
  if (stand.hinged()) stand.lay(w.place);
  return stand.hinged();
}

void part_cloth(Workspace& w, model::Model& model) {
  const std::vector<Stacking> laid = laid_in_order(w);
  std::vector<bool> lies(w.garment.panels.size(), false), left_out(lies), none(lies);
  for (const Stacking& s : laid) {
    lies[s.panel] = true;
    left_out[s.panel] = !has_own_place(w, s.panel);
  }
  const std::vector<Vector3d> before = model.start;
  take_apart(w.bodies, lies, model);
  if (!laid.empty()) {
    if (model.start != before || crosses(model, left_out)) lay_again(w, laid, before, model);
    take_apart(w.bodies, left_out, model);
    if (!w.turned.empty()) {
      turn_again(w, model);
      for (const body::Body& b : w.bodies) clear_start(b, model);
    }
    take_apart(w.bodies, none, model);
  }
  tell_crossings(w, model);
}

}  // namespace garment::modeller
