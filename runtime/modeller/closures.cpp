#include "runtime/modeller/closures.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "runtime/base/number.hpp"
#include "runtime/body/index.hpp"
#include "runtime/model/flat_index.hpp"

namespace garment::modeller {
namespace {

using design::Point2;
using model::Index;
using model::Vector3d;

constexpr double kLeastLength = 1e-3;       // m, of a tie: more than contact keeps the thinnest cloths apart
constexpr double kButtonStiffness = 1e4;    // N/m, of a sewn shank: 0.5 mm under 5 N
constexpr double kStitchStiffness = 2e3;    // N/m, of one stitch of a tack
constexpr double kSeamStiffness = 2e5;      // N/m per m of a tied seam: a stitch of a tack to the centimetre
constexpr double kThreadStiffness = 100;    // N per strain, of two sewing threads (tex 30 polyester: 12 N at 15 to 20 %)
constexpr double kStitchEvery = 0.02;       // m between the stitches of a tack
constexpr int kFiner = 3;                   // times that the stitches of a small region are set twice as close
constexpr double kFarthest = 0.1;           // m from a stitch to the other panel

/// A point of the cloth.
struct Place {
  Index panel = -1;
  model::Indices<3> particle{};
  std::array<double, 3> weight{1, 0, 0};

  Vector3d at(const std::vector<Vector3d>& x) const {
    return weight[0] * x[particle[0]] + weight[1] * x[particle[1]] + weight[2] * x[particle[2]];
  }
  /// Of the cloth there, m.
  double thickness(const model::Model& model) const {
    return weight[0] * model.thickness[particle[0]] + weight[1] * model.thickness[particle[1]] +
           weight[2] * model.thickness[particle[2]];
  }
};

/// The weights of a point on a triangle of the panel's flat pattern, where it lies beyond the border those of the border.
std::array<double, 3> on_triangle(std::array<double, 3> weights) {
  double sum = 0;
  for (double& w : weights) sum += w = std::max(w, 0.0);
  for (double& w : weights) w /= sum;
  return weights;
}

/// The barycentric coordinates of a point in the plane of a triangle; of a triangle that is a line, its first corner's.
std::array<double, 3> weights_in(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a);
  const double area = normal.squaredNorm();
  if (area == 0) return {1, 0, 0};
  const double wb = (p - a).cross(c - a).dot(normal) / area, wc = (b - a).cross(p - a).dot(normal) / area;
  return on_triangle({1 - wb - wc, wb, wc});
}

class Ties {
 public:
  Ties(model::Model& model, Findings& findings) : model_(model), findings_(findings), flat_(model.panels.size()) {}

  void button(const design::Button& button) {
    const std::optional<Place> sewn = place_of(button.panel, button.point);
    std::vector<Place> holes;
    for (const design::ButtonHole& hole : button.holes)
      if (const std::optional<Place> place = place_of(hole.panel, hole.point)) holes.push_back(*place);
    if (!sewn || holes.size() < button.holes.size()) return lost("button", button.name, button.origin);
    begin(button.name, button.origin, button.mass);
    for (int k = 0; k < 3; ++k) model_.mass[sewn->particle[k]] += button.mass * sewn->weight[k];
    const Place* before = &*sewn;
    double thread = button.shank;  // the cloths with the holes lie on each other
    for (const Place& hole : holes) {
      add(*before, hole, thread, kButtonStiffness);
      before = &hole;
      thread = 0;
    }
  }

  void tack(const design::Tack& tack, const std::vector<Place>& stitches) {
    begin(tack.name, tack.origin, 0);
    double farthest = 0;
    for (const Place& stitch : stitches) {
      const Vector3d at = stitch.at(model_.start);
      const Place other = nearest(tack.panel[1], at);
      farthest = std::max(farthest, (other.at(model_.start) - at).norm());
      add(stitch, other, 0, kStitchStiffness);
    }
    if (farthest <= kFarthest) return;
    findings_.push_back({"G0653",
                         Severity::error,
                         fmt::format("tack `{}`: panel `{}` lies {} cm from `{}` where the garment is placed", tack.name,
                                     model_.panels[tack.panel[1]].name, format_number(100 * farthest, 3),
                                     model_.panels[tack.panel[0]].name),
                         {{tack.origin, ""}},
                         "a tack holds what lies within 10 cm: place the two panels on each other, or tack along another line"});
  }

  void slack(const SewnSides& sewn) {
    begin(sewn.seam->name, sewn.seam->origin, 0);
    for (std::size_t s = 1; s < sewn.side.size(); ++s)
      for (std::size_t k = 0; k < std::min(sewn.side[0].size(), sewn.side[s].size()); ++k)
        add_thread(place_at(sewn.side[0][k]), place_at(sewn.side[s][k]), sewn.seam->slack, kSeamStiffness * held_by(sewn.side[0], k));
  }

  void lap(const SewnSides& sewn) {
    begin(sewn.seam->name, sewn.seam->origin, 0);
    for (std::size_t s = 1; s < sewn.side.size(); ++s)
      for (const auto& [from, to] : {std::pair{std::size_t{0}, s}, std::pair{s, std::size_t{0}}})
        for (std::size_t k = 0; k < std::min(sewn.side[from].size(), sewn.side[to].size()); ++k)
          if (const std::optional<Place> under = inside(sewn.side[to], sewn.side[from], k, sewn.seam->lap))
            add(place_at(sewn.side[from][k]), *under, 0, kSeamStiffness * held_by(sewn.side[from], k));
  }

  void thread(const SewnSides& sewn) {
    begin(sewn.seam->name, sewn.seam->origin, 0);
    const std::vector<Index>& side = sewn.side[0];
    for (std::size_t k = 0; k + 1 < side.size(); ++k) {
      const Place a = place_at(side[k]), b = place_at(side[k + 1]);
      const double length = (model_.vertex_uv[side[k + 1]] - model_.vertex_uv[side[k]]).norm();
      if (a.panel != b.panel || a.particle == b.particle || !(length > 0)) continue;
      add_thread(a, b, (1 + sewn.seam->tension) * length, kThreadStiffness / length);
    }
  }

  /// Where a point of the pattern lies on the cloth; nothing where there is no such panel.
  std::optional<Place> place_of(int panel, const Point2& point) {
    if (!has(panel) || !point.allFinite()) return std::nullopt;
    Place place{panel, {}, {}};
    const Index t = locate(panel, point, place.weight);
    if (t < 0) return std::nullopt;
    place.particle = model_.corners(static_cast<std::size_t>(t));
    place.weight = on_triangle(place.weight);
    return place;
  }

  /// True where a point of the pattern lies on a triangle of the panel.
  bool on_cloth(int panel, const Point2& point) {
    constexpr double kOnBorder = -1e-9;
    std::array<double, 3> weights{};
    return locate(panel, point, weights) >= 0 && *std::min_element(weights.begin(), weights.end()) > kOnBorder;
  }

  bool has(int panel) const {
    return panel >= 0 && panel < static_cast<int>(model_.panels.size()) && model_.panels[panel].n_triangles > 0;
  }

  void lost(const char* kind, const std::string& name, OriginId origin) {
    findings_.push_back({"G0652",
                         Severity::error,
                         fmt::format("{} `{}` is not on the cloth of declared panels", kind, name),
                         {{origin, ""}},
                         "name declared panels, and places or lines on them"});
  }

 private:
  Place place_at(Index vertex) const {
    const Index particle = model_.vertex_particle[vertex];
    return {model_.vertex_panel[vertex], {particle, particle, particle}, {1, 0, 0}};
  }

  /// Length of a side that its vertex k stands for, m; at least 1 mm.
  double held_by(const std::vector<Index>& side, std::size_t k) const {
    double length = 0;
    for (std::size_t other : {k > 0 ? k - 1 : k, std::min(k + 1, side.size() - 1)})
      if (model_.vertex_panel[side[other]] == model_.vertex_panel[side[k]])
        length += 0.5 * (model_.vertex_uv[side[other]] - model_.vertex_uv[side[k]]).norm();
    return std::max(length, 1e-3);
  }

  /// Across a side at its vertex k, to the left of its way; zero where it has no way.
  Point2 across(const std::vector<Index>& side, std::size_t k) const {
    const Index here = side[k];
    Point2 way(0, 0);
    for (std::size_t other : {k > 0 ? k - 1 : k, std::min(k + 1, side.size() - 1)})
      if (model_.vertex_panel[side[other]] == model_.vertex_panel[here])
        way += (other > k ? 1 : -1) * (model_.vertex_uv[side[other]] - model_.vertex_uv[here]);
    return way.norm() > 0 ? Point2(Point2(-way.y(), way.x()).normalized()) : Point2(0, 0);
  }

  /// 1 where the cloth lies to the left of a side at its vertex k, -1 to the right, 0 on both sides: a line inside a panel.
  int cloth_beside(const std::vector<Index>& side, std::size_t k) {
    constexpr double kLook = 0.5e-3;  // m
    const Point2 off = kLook * across(side, k), at = model_.vertex_uv[side[k]];
    const int panel = model_.vertex_panel[side[k]];
    return static_cast<int>(on_cloth(panel, at + off)) - static_cast<int>(on_cloth(panel, at - off));
  }

  /// The place that lies `depth` inside the cloth from vertex k of a side; from a line, away from the cloth of the other side.
  std::optional<Place> inside(const std::vector<Index>& side, const std::vector<Index>& other, std::size_t k, double depth) {
    const Point2 way = across(side, k);
    if (way.isZero()) return std::nullopt;
    int sense = cloth_beside(side, k);
    if (sense == 0) sense = cloth_beside(other, k) > 0 ? -1 : 1;
    return place_of(model_.vertex_panel[side[k]], model_.vertex_uv[side[k]] + sense * depth * way);
  }

  Index locate(int panel, const Point2& point, std::array<double, 3>& weights) {
    if (!flat_[panel]) flat_[panel].emplace(model_, panel);
    return flat_[panel]->locate(point, weights);
  }

  void begin(const std::string& name, OriginId origin, double mass) { model_.closures.push_back({name, origin, mass}); }

  /// Stitches through two cloths that lie on each other, or a shank between them.
  void add(const Place& a, const Place& b, double thread, double stiffness) {
    const double between = 0.5 * (a.thickness(model_) + b.thickness(model_));
    add_thread(a, b, std::max(thread + between, kLeastLength), stiffness);
  }

  void add_thread(const Place& a, const Place& b, double length, double stiffness) {
    model_.tie.push_back({a.particle[0], a.particle[1], a.particle[2], b.particle[0], b.particle[1], b.particle[2]});
    model_.tie_weights.push_back({a.weight[0], a.weight[1], a.weight[2], b.weight[0], b.weight[1], b.weight[2]});
    model_.tie_length.push_back(length);
    model_.tie_stiffness.push_back(stiffness);
    model_.tie_closure.push_back(static_cast<Index>(model_.closures.size() - 1));
  }

  /// The place of a panel that is nearest to `p` at the start.
  Place nearest(int panel, const Vector3d& p) const {
    const model::PanelRange& range = model_.panels[panel];
    const std::vector<Vector3d>& x = model_.start;
    Place best{panel, {}, {}};
    double least = 1e300;
    for (Index t = range.first_triangle; t < range.first_triangle + range.n_triangles; ++t) {
      const model::Indices<3> c = model_.corners(static_cast<std::size_t>(t));
      const Vector3d q = body::closest_on_triangle(p, x[c[0]], x[c[1]], x[c[2]]).point;
      const double d = (q - p).squaredNorm();
      if (d >= least) continue;
      least = d;
      best = {panel, c, weights_in(q, x[c[0]], x[c[1]], x[c[2]])};
    }
    return best;
  }

  model::Model& model_;
  Findings& findings_;
  std::vector<std::optional<model::FlatIndex>> flat_;
};

/// Points along the line of a tack, those of two parts that meet once.
std::vector<Point2> points_along(const design::Tack& tack, const design::Panel& panel) {
  std::vector<Point2> points;
  auto add = [&](const Point2& p) {
    const bool again = !points.empty() && ((points.back() - p).norm() < 1e-6 || (points.front() - p).norm() < 1e-6);
    if (!again) points.push_back(p);
  };
  for (const design::EdgePart& part : tack.line) {
    const double length = std::abs(part.to - part.from);
    const int n = std::max(1, static_cast<int>(std::lround(length / kStitchEvery)));
    const geometry::Curve& curve = design::edge_of(panel, part).curve;
    for (int k = 0; k <= n; ++k) add(curve.point_at(part.from + (part.to - part.from) * k / n));
  }
  return points;
}

/// Points of a square grid in a region.
std::vector<Point2> points_inside(const design::RegionTest& region, const Point2& low, const Point2& high, double every) {
  std::vector<Point2> points;
  for (double j = std::ceil(low.y() / every); j <= high.y() / every; ++j)
    for (double i = std::ceil(low.x() / every); i <= high.x() / every; ++i)
      if (region.contains({i * every, j * every})) points.emplace_back(i * every, j * every);
  return points;
}

std::vector<Place> stitches_along(const design::Tack& tack, const design::Garment& garment, Ties& ties) {
  std::vector<Place> places;
  for (const Point2& p : points_along(tack, garment.panels[tack.panel[0]]))
    if (const std::optional<Place> place = ties.place_of(tack.panel[0], p)) places.push_back(*place);
  return places;
}

std::vector<Place> stitches_inside(const design::Tack& tack, const design::Garment& garment, const model::Model& model,
                                   Ties& ties) {
  const int panel = tack.panel[0];
  const model::PanelRange& range = model.panels[panel];
  Point2 low(1e300, 1e300), high(-1e300, -1e300);
  for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v) {
    low = low.cwiseMin(model.vertex_uv[v]);
    high = high.cwiseMax(model.vertex_uv[v]);
  }
  std::vector<Place> places;
  for (const design::RegionPart& part : garment.regions[tack.region].parts) {
    if (part.panel != panel) continue;
    const design::RegionTest test(garment.panels[panel], part.shape);
    double every = kStitchEvery;
    for (int k = 0; k <= kFiner && places.empty(); ++k, every /= 2)
      for (const Point2& p : points_inside(test, low, high, every))
        if (ties.on_cloth(panel, p)) places.push_back(*ties.place_of(panel, p));
  }
  return places;
}

bool is_valid(const design::Tack& tack, const design::Garment& garment, const Ties& ties) {
  if (!ties.has(tack.panel[0]) || !ties.has(tack.panel[1])) return false;
  if (tack.region >= 0) return tack.region < static_cast<int>(garment.regions.size());
  const design::Panel& panel = garment.panels[tack.panel[0]];
  return std::all_of(tack.line.begin(), tack.line.end(), [&](const design::EdgePart& part) {
    const std::size_t n = part.on == design::EdgePart::On::hole   ? panel.hole_edges.size()
                          : part.on == design::EdgePart::On::line ? panel.lines.size()
                                                                  : panel.edges.size();
    return part.panel == tack.panel[0] && part.edge >= 0 && part.edge < static_cast<int>(n) && std::isfinite(part.from) &&
           std::isfinite(part.to);
  });
}

}  // namespace

void add_seam_ties(const std::vector<SewnSides>& sides, model::Model& model, Findings& findings) {
  Ties ties(model, findings);
  for (const SewnSides& sewn : sides) {
    if (sewn.seam->slack > 0) ties.slack(sewn);
    if (sewn.seam->lap > 0) ties.lap(sewn);
    if (sewn.seam->tension < 0) ties.thread(sewn);
  }
}

void add_closures(const design::Garment& garment, model::Model& model, Findings& findings) {
  Ties ties(model, findings);
  for (const design::Button& button : garment.buttons) ties.button(button);
  for (const design::Tack& tack : garment.tacks) {
    std::vector<Place> stitches;
    if (is_valid(tack, garment, ties))
      stitches = tack.region >= 0 ? stitches_inside(tack, garment, model, ties) : stitches_along(tack, garment, ties);
    if (stitches.empty()) ties.lost("tack", tack.name, tack.origin);
    else ties.tack(tack, stitches);
  }
}

}  // namespace garment::modeller
