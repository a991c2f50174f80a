#include "runtime/modeller/placement_hinge.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "runtime/base/portable_math.hpp"

namespace garment::modeller {
namespace {

using model::Index;
using model::Vector2d;
using model::Vector3d;

constexpr double kDegree = 3.14159265358979323846 / 180;  // rad
constexpr double kLeastOpening = 12 * kDegree;
constexpr double kMostOpening = 130 * kDegree;
constexpr double kWide = 100 * kDegree;  // beyond the foot, from which on it is no use to open further there alone
constexpr double kOpeningStep = 8 * kDegree;
constexpr double kMostTwist = 25 * kDegree / 0.01;  // per m along the seam, by which the opening changes
constexpr double kFootStep = 1e-3;                 // m
constexpr double kFarthestFoot = 0.3;              // m
constexpr double kBeforeFoot = 0.85;               // of the way there, from which on the panel may bend
constexpr double kLeanStep = 0.125;
constexpr double kMostLean = 0.75;
constexpr double kLeanReach = 0.15;  // m, along the seam, within which the lean dies away
constexpr double kFarApart = 0.05;   // m, in the flat pattern: what meets there are different ends
constexpr double kEvenedOver = 0.015;  // m, of directions along the seam
constexpr int kMostEvenings = 150;
constexpr int kEveningsStep = 12;
constexpr int kFewerBeside = 4;  // evenings of the next hinge

}  // namespace

/// What it is laid by: from places of the others.
struct HingedPanel::Shape {
  const Points& place;
  Points at;      ///< of the hinges
  Points normal;  ///< unit, of the other panel's vertices, on the side where this one lies
  Points away;    ///< unit ways off the seam beyond the other one's foot, at every hinge
};

HingedPanel::HingedPanel(const model::Model& model, std::size_t panel, const std::vector<bool>& placed, const std::vector<Vector3d>& flat)
    : model_(model), flat_(flat), panel_(panel) {
  find_hinges(placed);
  find_spans();
  find_ends();
  if (hinged()) find_feet();
}

HingedPanel::HingedPanel(const model::Model& model, std::size_t panel, std::size_t other, bool over, const std::vector<bool>& placed,
                         const std::vector<Vector3d>& flat)
    : model_(model), flat_(flat), panel_(panel), other_(other), sense_(over ? 1 : -1) {
  index_.emplace(model, static_cast<Index>(other));
  find_hinges(placed);
  find_spans();
  find_ends();
  if (!hinged()) return;
  find_feet_of_other();
  find_feet();
}

bool HingedPanel::hinged() const {
  if (!other_) return !spans_.empty();
  return std::any_of(spans_.begin(), spans_.end(), [&](const Span& s) { return hinges_[s.from].other >= 0 && hinges_[s.to].other >= 0; });
}

void HingedPanel::find_hinges(const std::vector<bool>& placed) {
  std::map<Index, std::vector<Index>> vertices;  // of placed panels, by particle
  for (std::size_t v = 0; v < model_.n_vertices(); ++v)
    if (placed[model_.vertex_panel[v]] && model_.vertex_panel[v] != static_cast<Index>(panel_))
      vertices[model_.vertex_particle[v]].push_back(static_cast<Index>(v));
  const model::PanelRange& range = model_.panels[panel_];
  std::map<Index, std::size_t> hinge_of;  // by vertex of a placed panel
  for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v) {
    const auto found = vertices.find(model_.vertex_particle[v]);
    if (found == vertices.end()) continue;
    Hinge hinge;
    hinge.here = v;
    hinge.there = found->second;
    hinge.opening = {kLeastOpening, kLeastOpening};
    auto on_other = [&](Index w) { return other_ && model_.vertex_panel[w] == static_cast<Index>(*other_); };
    for (Index w : hinge.there)
      if (on_other(w) && hinge.other < 0) hinge.other = w;
    for (Index w : hinge.there)
      if (hinge.other < 0 || on_other(w)) hinge_of.emplace(w, hinges_.size());
    hinges_.push_back(std::move(hinge));
  }
  for (std::size_t t = 0; t < model_.n_triangles(); ++t)
    for (Index w : model_.triangle[t])
      if (const auto hinge = hinge_of.find(w); hinge != hinge_of.end()) hinges_[hinge->second].triangles.push_back(static_cast<Index>(t));
}

/// The edges of the panel's border whose ends are both hinges.
void HingedPanel::find_spans() {
  std::map<Index, std::size_t> number;
  for (std::size_t k = 0; k < hinges_.size(); ++k) number[hinges_[k].here] = k;
  std::map<std::array<Index, 2>, int> edges;  // of triangles, in their sense
  const model::PanelRange& range = model_.panels[panel_];
  for (Index t = range.first_triangle; t < range.first_triangle + range.n_triangles; ++t)
    for (int k = 0; k < 3; ++k) ++edges[{model_.triangle[t][k], model_.triangle[t][(k + 1) % 3]}];
  for (const auto& [edge, n] : edges) {
    if (edges.contains({edge[1], edge[0]})) continue;
    const auto from = number.find(edge[0]), to = number.find(edge[1]);
    if (from == number.end() || to == number.end()) continue;
    spans_.push_back({from->second, to->second, (flat_at(edge[1]) - flat_at(edge[0])).norm()});
  }
  double length = 0;
  for (const Span& s : spans_) length += s.length / static_cast<double>(spans_.size());
  for (Hinge& h : hinges_) h.evenings = std::min(kMostEvenings, static_cast<int>(2 * (kEvenedOver / length) * (kEvenedOver / length)));
}

void HingedPanel::find_ends() {
  for (Hinge& h : hinges_) h.to_end = 1e300;
  std::vector<std::array<bool, 2>> goes_on(hinges_.size(), {false, false});  // before it, behind it
  for (const Span& s : spans_) goes_on[s.from][1] = goes_on[s.to][0] = true;
  for (std::size_t k = 0; k < hinges_.size(); ++k)
    if (goes_on[k][0] != goes_on[k][1]) hinges_[k].to_end = 0, hinges_[k].way_from_end = goes_on[k][1] ? 1 : -1;
  for (bool changed = true; changed;) {
    changed = false;
    for (const Span& s : spans_)
      for (auto [a, b] : {std::pair{s.from, s.to}, std::pair{s.to, s.from}}) {
        if (hinges_[a].to_end + s.length >= hinges_[b].to_end) continue;
        hinges_[b].to_end = hinges_[a].to_end + s.length;
        hinges_[b].way_from_end = hinges_[a].way_from_end;
        changed = true;
      }
  }
}

/// How far the other panel goes straight off the seam.
void HingedPanel::find_feet_of_other() {
  std::vector<Vector2d> way(hinges_.size(), Vector2d::Zero());
  for (const Span& s : spans_) {
    const Index from = hinges_[s.from].other, to = hinges_[s.to].other;
    if (from < 0 || to < 0) continue;
    way[s.from] += model_.vertex_uv[to] - model_.vertex_uv[from];
    way[s.to] += model_.vertex_uv[to] - model_.vertex_uv[from];
  }
  for (std::size_t k = 0; k < hinges_.size(); ++k) {
    Hinge& hinge = hinges_[k];
    if (hinge.other < 0) continue;
    const Vector2d at = model_.vertex_uv[hinge.other], along = way[k].normalized();
    Vector2d& into = hinge.into;
    for (Index t : hinge.triangles) {
      const model::Indices<3>& c = model_.triangle[t];
      into += (model_.vertex_uv[c[0]] + model_.vertex_uv[c[1]] + model_.vertex_uv[c[2]]) / 3 - at;
    }
    into = (into - into.dot(along) * along).normalized();
    std::array<double, 3> weights{};
    double off = kFootStep;
    while (off < kFarthestFoot && index_->locate(at + off * into, weights) >= 0 && *std::min_element(weights.begin(), weights.end()) > -1e-6)
      off += kFootStep;
    hinge.foot = kBeforeFoot * (off - kFootStep);
  }
}

void HingedPanel::find_feet() {
  const model::PanelRange& range = model_.panels[panel_];
  for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v) {
    Foot foot;
    double nearest = 1e300;
    for (std::size_t k = 0; k < spans_.size(); ++k) {
      const Vector2d from = flat_at(hinges_[spans_[k].from].here), way = flat_at(hinges_[spans_[k].to].here) - from;
      const double share = std::clamp(way.dot(flat_at(v) - from) / way.squaredNorm(), 0.0, 1.0);
      const Vector2d off = flat_at(v) - from - share * way;
      if (off.norm() >= nearest) continue;
      nearest = off.norm();
      // Beyond the ends of the seam the panel goes on along it.
      const double along = way.dot(off) / way.norm();
      foot = {k, share, along, std::sqrt(std::max(0.0, off.squaredNorm() - along * along))};
    }
    feet_.push_back(foot);
  }
}

/// Directions and those beside them are mixed, and brought to unit length.
HingedPanel::Points HingedPanel::evened(Points directions) const {
  for (int k = 0; k < kMostEvenings; ++k) {
    Points next = directions;
    for (const Span& s : spans_) {
      if (k < hinges_[s.from].evenings) next[s.from] += 0.5 * directions[s.to];
      if (k < hinges_[s.to].evenings) next[s.to] += 0.5 * directions[s.from];
    }
    for (Vector3d& d : next) d.normalize();
    directions.swap(next);
  }
  return directions;
}

HingedPanel::Points HingedPanel::places_of_hinges(const Points& place) const {
  Points at(hinges_.size(), Vector3d::Zero());
  for (std::size_t k = 0; k < hinges_.size(); ++k)
    for (Index w : hinges_[k].there) at[k] += place[w] / static_cast<double>(hinges_[k].there.size());
  return at;
}

std::vector<std::pair<Index, Vector3d>> HingedPanel::evenly_along_seam(const Points& place) const {
  const Points at = places_of_hinges(place);
  std::vector<const Span*> next(hinges_.size(), nullptr);
  std::vector<bool> begins(hinges_.size(), true);
  for (const Span& s : spans_) next[s.from] = &s, begins[s.to] = false;
  std::vector<std::pair<Index, Vector3d>> result;
  for (std::size_t begin = 0; begin < hinges_.size(); ++begin) {
    if (!begins[begin]) continue;  // a ring has no beginning, and stays
    std::vector<std::size_t> line{begin};
    std::vector<double> flat{0}, space{0};  // m, from the beginning
    for (const Span* s = next[begin]; s != nullptr; s = next[s->to]) {
      line.push_back(s->to);
      flat.push_back(flat.back() + s->length);
      space.push_back(space.back() + (at[s->to] - at[s->from]).norm());
    }
    for (std::size_t k = 0, j = 0; k < line.size(); ++k) {
      const double wanted = flat.back() > 0 ? flat[k] / flat.back() * space.back() : 0;
      while (j + 2 < line.size() && space[j + 1] < wanted) ++j;
      const bool last = j + 1 >= line.size() || space[j + 1] <= space[j];
      const double share = last ? 0 : std::clamp((wanted - space[j]) / (space[j + 1] - space[j]), 0.0, 1.0);
      const Vector3d there = last ? at[line[j]] : Vector3d((1 - share) * at[line[j]] + share * at[line[j + 1]]);
      result.emplace_back(model_.vertex_particle[hinges_[line[k]].here], there);
    }
  }
  return result;
}

/// Unit, of its vertices, on the side where this panel lies.
HingedPanel::Points HingedPanel::normals_of_other(const Points& place) const {
  const model::PanelRange& other = model_.panels[*other_];
  Points normals(static_cast<std::size_t>(other.n_vertices), Vector3d::Zero());
  for (Index t = other.first_triangle; t < other.first_triangle + other.n_triangles; ++t) {
    const model::Indices<3>& c = model_.triangle[t];
    const Vector3d normal = sense_ * (place[c[1]] - place[c[0]]).cross(place[c[2]] - place[c[0]]);
    for (Index v : c) normals[v - other.first_vertex] += normal;
  }
  for (Vector3d& n : normals) n.normalize();
  return normals;
}

HingedPanel::Shape HingedPanel::shape(const Points& place) const {
  Shape shape{place, places_of_hinges(place), {}, {}};
  if (other_) shape.normal = normals_of_other(place);
  const Index first_of_other = other_ ? model_.panels[*other_].first_vertex : 0;
  Points tangent(hinges_.size(), Vector3d::Zero());
  for (const Span& s : spans_) {
    const Vector3d way = (shape.at[s.to] - shape.at[s.from]).normalized();
    tangent[s.from] += way;
    tangent[s.to] += way;
  }
  for (std::size_t k = 0; k < hinges_.size(); ++k) {
    const Hinge& hinge = hinges_[k];
    Vector3d into = Vector3d::Zero();
    for (Index t : hinge.triangles) {
      const model::Indices<3>& c = model_.triangle[t];
      into += (place[c[0]] + place[c[1]] + place[c[2]]) / 3 - shape.at[k];
    }
    tangent[k].normalize();
    const Vector3d down = (into - into.dot(tangent[k]) * tangent[k]).normalized();
    if (hinge.other < 0) {
      shape.away.push_back(-down);
      continue;
    }
    const Vector3d& out = shape.normal[hinge.other - first_of_other];
    const Vector3d square = (out - out.dot(down) * down).normalized();
    shape.away.push_back(portable::cos(hinge.opening[1]) * down + portable::sin(hinge.opening[1]) * square);
  }
  shape.away = evened(std::move(shape.away));
  for (std::size_t k = 0; k < hinges_.size(); ++k)
    if (hinges_[k].to_end < kLeanReach)
      shape.away[k] += lean_ * (1 - hinges_[k].to_end / kLeanReach) * hinges_[k].way_from_end * tangent[k];
  return shape;
}

/// The place so far off the seam at a hinge.
Vector3d HingedPanel::off_seam(const Shape& shape, std::size_t k, double across) const {
  const Hinge& hinge = hinges_[k];
  if (hinge.other < 0) return shape.at[k] + across * shape.away[k];
  const double before = std::min(across, hinge.foot);
  const double along = before * portable::cos(hinge.opening[0]), off = before * portable::sin(hinge.opening[0]);
  // Beyond the seam the other panel is carried on, straight as it begins.
  std::array<double, 3> weights{};
  const Index t = index_->locate(model_.vertex_uv[hinge.other] + std::abs(along) * hinge.into, weights);
  const Index first = model_.panels[*other_].first_vertex;
  Vector3d at = Vector3d::Zero(), normal = Vector3d::Zero();
  for (int c = 0; c < 3; ++c) {
    at += weights[c] * shape.place[model_.triangle[t][c]];
    normal += std::max(0.0, weights[c]) * shape.normal[model_.triangle[t][c] - first];
  }
  if (along < 0) at = 2 * shape.at[k] - at;
  return at + off * normal.normalized() + (across - before) * shape.away[k];
}

void HingedPanel::lay(Points& place) const {
  const Points before = place;
  const Shape from = shape(before);
  const Index first = model_.panels[panel_].first_vertex;
  for (std::size_t k = 0; k < feet_.size(); ++k) {
    const Foot& foot = feet_[k];
    const Span& span = spans_[foot.span];
    place[first + static_cast<Index>(k)] = (1 - foot.share) * off_seam(from, span.from, foot.across) +
                                           foot.share * off_seam(from, span.to, foot.across) +
                                           foot.along * (from.at[span.to] - from.at[span.from]).normalized();
  }
}

/// Beside what is open the panel opens, too, so that it does not tear, and it bends outwards at the foot, not back in; evenings
/// fade out along the seam.
void HingedPanel::ease() {
  for (Hinge& h : hinges_) h.opening[1] = std::max(h.opening[1], h.opening[0]);
  for (bool changed = true; changed;) {
    changed = false;
    for (const Span& s : spans_)
      for (auto [a, b] : {std::pair{s.from, s.to}, std::pair{s.to, s.from}}) {
        for (std::size_t part = 0; part < 2; ++part) {
          const double least = hinges_[a].opening[part] - kMostTwist * s.length;
          changed = changed || hinges_[b].opening[part] < least;
          hinges_[b].opening[part] = std::max(hinges_[b].opening[part], least);
        }
        const int fewest = hinges_[a].evenings - kFewerBeside;
        changed = changed || hinges_[b].evenings < fewest;
        hinges_[b].evenings = std::max(hinges_[b].evenings, fewest);
      }
  }
}

bool HingedPanel::open(const std::vector<geometry::TrianglePair>& crossings) {
  const model::PanelRange& range = model_.panels[panel_];
  auto own = [&](std::int32_t t) { return t >= range.first_triangle && t < range.first_triangle + range.n_triangles; };
  auto is_beyond = [&](const Foot& foot) {
    return foot.across > std::min(hinges_[spans_[foot.span].from].foot, hinges_[spans_[foot.span].to].foot);
  };
  auto middle = [&](std::int32_t t) {
    const model::Indices<3>& c = model_.triangle[t];
    return Vector2d((flat_at(c[0]) + flat_at(c[1]) + flat_at(c[2])) / 3);
  };
  std::vector<std::array<bool, 2>> cut(hinges_.size(), {false, false});
  std::vector<bool> uneven(hinges_.size(), false);
  bool ends_meet = false;
  for (const geometry::TrianglePair& pair : crossings) {
    const bool both = own(pair.first) && own(pair.second);
    const bool near = both && (middle(pair.first) - middle(pair.second)).norm() < kFarApart;
    ends_meet = ends_meet || (both && !near);
    for (std::int32_t t : {pair.first, pair.second}) {
      if (!own(t)) continue;
      bool beyond = false;
      for (Index v : model_.triangle[t]) beyond = beyond || is_beyond(feet_[v - range.first_vertex]);
      for (Index v : model_.triangle[t]) {
        const Span& span = spans_[feet_[v - range.first_vertex].span];
        for (std::size_t k : {span.from, span.to}) {
          if (near) uneven[k] = true;
          else cut[k][beyond && hinges_[k].opening[1] < kWide] = true;
        }
      }
    }
  }
  bool changed = ends_meet && lean_ < kMostLean;
  if (changed) lean_ += kLeanStep;
  for (std::size_t k = 0; k < hinges_.size(); ++k) {
    for (std::size_t part = 0; part < 2; ++part)
      if (cut[k][part] && hinges_[k].opening[part] < kMostOpening) hinges_[k].opening[part] += kOpeningStep, changed = true;
    if (uneven[k] && hinges_[k].evenings < kMostEvenings) hinges_[k].evenings += kEveningsStep, changed = true;
  }
  ease();
  return changed;
}

}  // namespace garment::modeller
