#include "runtime/modeller/flat_start.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/modeller/pleats.hpp"

namespace garment::modeller {
namespace {

using design::Placement;
using design::Point2;
using model::Index;
using model::Vector3d;

constexpr double kLeastGap = 2e-3;  // m
constexpr double kOnAxis = 1e-6;    // m

/// How far a panel reaches below (towards the back) and above its plane, m.
struct Reach {
  double below = 0, above = 0;
};

/// How far off its place each panel starts, m, so that what lies over or under others clears them.
std::vector<double> offsets(const design::Garment& garment, const std::vector<Reach>& reach) {
  std::vector<double> off(garment.panels.size(), 0);
  for (std::size_t round = 0; round < garment.panels.size(); ++round) {  // a chain is no longer than that
    bool moved = false;
    for (const design::Stacking& s : garment.stackings) {
      const double gap = std::max(layer_gap(garment, s.panel), layer_gap(garment, s.other));
      const double over = off[s.other] + reach[s.other].above + gap + reach[s.panel].below,
                   under = off[s.other] - reach[s.other].below - gap - reach[s.panel].above;
      const double before = off[s.panel];
      off[s.panel] = s.over ? std::max(before, over) : std::min(before, under);
      moved = moved || off[s.panel] != before;
    }
    if (!moved) break;
  }
  return off;
}

/// The line along which a panel is folded in half.
struct Axis {
  Point2 at{0, 0}, along{0, 1};
  int side = -1;  ///< -1 folds to the back, 1 to the face
};

Axis half_axis(const design::Garment& garment, int panel, const Point2& low, const Point2& high) {
  const design::Panel& p = garment.panels[panel];
  for (const design::Press& press : garment.presses)
    for (const design::EdgePart& part : press.line) {
      if (press.kind != design::Press::Kind::fold || part.panel != panel || part.on != design::EdgePart::On::line) continue;
      const geometry::Curve& curve = design::edge_of(p, part).curve;
      const Point2 way = curve.end() - curve.start();
      if (way.norm() > 0) return {curve.start(), way.normalized(), press.to == design::Facing::back ? -1 : 1};
    }
  const Point2 middle = 0.5 * (low + high);
  if (p.fold_x) return {{*p.fold_x, 0}, {0, 1}};
  if (high.x() - low.x() >= high.y() - low.y()) return {middle, {0, 1}};
  return {middle, {1, 0}};
}

/// The edges of a panel on which pleats stand.
class PleatedEdges {
 public:
  PleatedEdges(const design::Panel& panel, const std::vector<LaidPleat>& pleats) {
    std::vector<int> edges;
    for (const LaidPleat& p : pleats)
      if (std::find(edges.begin(), edges.end(), p.edge) == edges.end()) edges.push_back(p.edge);
    for (int e : edges) lines_.push_back(panel.edges[e].curve.polyline(kChordError));
  }

  bool hold(const Point2& at) const {
    for (const std::vector<Point2>& line : lines_)
      for (std::size_t k = 0; k + 1 < line.size(); ++k) {
        const Point2 way = line[k + 1] - line[k];
        const double t = std::clamp((at - line[k]).dot(way) / std::max(1e-300, way.squaredNorm()), 0.0, 1.0);
        if ((line[k] + t * way - at).norm() < 2 * kChordError) return true;
      }
    return false;
  }

 private:
  static constexpr double kChordError = 2e-5;  // m
  std::vector<std::vector<Point2>> lines_;
};

}  // namespace

double layer_gap(const design::Garment& garment, int panel) {
  return std::max(kLeastGap, 2 * garment.fabrics[garment.panels[panel].fabric].thickness);
}

std::vector<Vector3d> flat_start(const design::Garment& garment, const model::Model& model) {
  std::vector<Vector3d> flat(model.n_vertices());
  std::vector<Reach> reach(garment.panels.size());
  for (std::size_t p = 0; p < garment.panels.size(); ++p) {
    const design::Panel& panel = garment.panels[p];
    const std::vector<LaidPleat> pleats = laid_pleats(panel);
    const PleatedEdges pleated(panel, pleats);
    const double gap = layer_gap(garment, static_cast<int>(p));
    const model::PanelRange& range = model.panels[p];
    const Index end = range.first_vertex + range.n_vertices;
    Point2 low(1e300, 1e300), high(-1e300, -1e300);
    for (Index v = range.first_vertex; v < end; ++v) {
      flat[v] = fold_pleats(pleats, model.vertex_uv[v], gap);
      // What the edge's seam holds together is one line: the layers part from there.
      if (flat[v].z() != 0 && pleated.hold(model.vertex_uv[v])) flat[v].z() = 0;
      low = low.cwiseMin(flat[v].head<2>());
      high = high.cwiseMax(flat[v].head<2>());
    }
    if (panel.placement.folded) {
      const Axis axis = half_axis(garment, static_cast<int>(p), low, high);
      Point2 across(-axis.along.y(), axis.along.x());
      // The smaller part is turned, whichever way the line runs: a lapel, not the front that it belongs to.
      Index turned = 0, kept = 0;
      for (Index v = range.first_vertex; v < end; ++v) {
        const double off = (flat[v].head<2>() - axis.at).dot(across);
        if (std::abs(off) > kOnAxis) ++(off > 0 ? turned : kept);
      }
      if (turned > kept) across = -across;
      for (Index v = range.first_vertex; v < end; ++v) {
        const double off = (flat[v].head<2>() - axis.at).dot(across);
        if (off <= 0) continue;
        flat[v].head<2>() -= 2 * off * across;
        flat[v].z() = axis.side * gap - flat[v].z();
      }
    }
    for (Index v = range.first_vertex; v < end; ++v) {
      reach[p].below = std::max(reach[p].below, -flat[v].z());
      reach[p].above = std::max(reach[p].above, flat[v].z());
    }
  }
  const std::vector<double> off = offsets(garment, reach);
  for (std::size_t p = 0; p < garment.panels.size(); ++p) {
    // A panel that is placed by hand lies where it was put, one without a place is laid on the other.
    const Placement::Kind kind = garment.panels[p].placement.kind;
    if (off[p] == 0 || (kind != Placement::Kind::on_part && kind != Placement::Kind::around)) continue;
    const model::PanelRange& range = model.panels[p];
    for (Index v = range.first_vertex; v < range.first_vertex + range.n_vertices; ++v) flat[v].z() += off[p];
  }
  return flat;
}

}  // namespace garment::modeller
