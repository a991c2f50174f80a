#include "runtime/modeller/layer_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/base/number.hpp"
#include "runtime/geometry/box_tree.hpp"

namespace garment::modeller {
namespace {

using model::Vector3d;

constexpr double kReachAtRest = 0.03;    // m: worn layers hang a few centimetres apart at most
constexpr double kReachAtStart = 0.1;    // m: panels are placed farther apart than they will hang
constexpr double kLeastTogether = 0.1;   // of the smaller panel: less of it says nothing of the panel
constexpr double kMostWrong = 0.5;       // of what lies together
constexpr double kBesideNearest = 2e-3;  // m: so far beside its box a triangle may be the nearest one
constexpr double kBesideTriangle = 0.1;  // weights: over an outer ridge the normals of two triangles leave a gap

/// The surface of one panel as it lies, to be asked how high places lie over it.
class LyingPanel {
 public:
  LyingPanel(const model::Model& model, const std::vector<Vector3d>& x, const model::PanelRange& panel)
      : model_(model), x_(x), first_(static_cast<std::size_t>(panel.first_triangle)), tree_(boxes_of(panel)) {}

  /// Height of p over the nearest triangle that has it straight over or under it, on the face's side positive, m; infinite where
  /// none has within `reach`.
  double height_of(const Vector3d& p, double reach) const {
    double height = std::numeric_limits<double>::infinity(), within = reach;
    tree_.visit(
        [&](const geometry::ClosedBox& box) {
          return ((box.low - p).array() <= within).all() && ((p - box.high).array() <= within).all();
        },
        [&](std::int32_t k) {
          const double h = height_over(first_ + static_cast<std::size_t>(k), p);
          if (std::abs(h) > reach || std::abs(h) >= std::abs(height)) return;
          height = h;
          within = std::min(reach, std::abs(h) + kBesideNearest);
        });
    return height;
  }

 private:
  std::vector<geometry::ClosedBox> boxes_of(const model::PanelRange& panel) const {
    std::vector<geometry::ClosedBox> boxes(static_cast<std::size_t>(panel.n_triangles));
    for (std::size_t k = 0; k < boxes.size(); ++k)
      for (model::Index i : model_.corners(first_ + k)) boxes[k].grow(x_[i]);
    return boxes;
  }

  double height_over(std::size_t t, const Vector3d& p) const {
    const model::Indices<3> c = model_.corners(t);
    const Vector3d a = x_[c[0]], u = x_[c[1]] - a, v = x_[c[2]] - a, n = u.cross(v);
    const double square = n.squaredNorm();
    if (!(square > 0)) return std::numeric_limits<double>::infinity();
    const Vector3d d = p - a;
    const double w1 = d.cross(v).dot(n) / square, w2 = u.cross(d).dot(n) / square;
    if (std::min({w1, w2, 1 - w1 - w2}) < -kBesideTriangle) return std::numeric_limits<double>::infinity();
    return d.dot(n) / std::sqrt(square);
  }

  const model::Model& model_;
  const std::vector<Vector3d>& x_;
  std::size_t first_;
  geometry::BoxTree tree_;
};

double area_as_cut(const model::Model& model, std::size_t t) {
  const model::Indices<3>& v = model.triangle[t];
  const model::Vector2d a = model.vertex_uv[v[1]] - model.vertex_uv[v[0]], b = model.vertex_uv[v[2]] - model.vertex_uv[v[0]];
  return (a.x() * b.y() - a.y() * b.x()) / 2;
}

bool names_panels(const model::Model& model, const design::Stacking& s) {
  const auto n = static_cast<int>(model.panels.size());
  return s.panel >= 0 && s.panel < n && s.other >= 0 && s.other < n && s.panel != s.other;
}

/// A stacking that does not hold, and the share of it that is wrong.
struct Wrong {
  const design::Stacking& stacking;
  double share;
};

std::vector<Wrong> out_of_order(const design::Garment& garment, const model::Model& model, const std::vector<Vector3d>& x, double reach) {
  std::vector<Wrong> found;
  for (const design::Stacking& s : garment.stackings) {
    if (!names_panels(model, s)) continue;
    const LayerOrder order = layer_order(model, x, s, reach);
    const double smaller = std::min(model.panels[s.panel].area, model.panels[s.other].area);
    if (order.together >= kLeastTogether * smaller && order.wrong > kMostWrong * order.together)
      found.push_back({s, order.wrong / order.together});
  }
  return found;
}

struct Words {
  std::string panel, other;
  const char *declared, *found, *side;
};

Words words_of(const design::Stacking& s, const model::Model& model) {
  return {model.panels[s.panel].name, model.panels[s.other].name, s.over ? "over" : "under", s.over ? "under" : "over",
          s.over ? "face" : "back"};
}

}  // namespace

LayerOrder layer_order(const model::Model& model, const std::vector<Vector3d>& x, const design::Stacking& stacking, double reach) {
  LayerOrder order;
  const LyingPanel other(model, x, model.panels[stacking.other]);
  const model::PanelRange& panel = model.panels[stacking.panel];
  for (model::Index t = panel.first_triangle; t < panel.first_triangle + panel.n_triangles; ++t) {
    const model::Indices<3> c = model.corners(static_cast<std::size_t>(t));
    const double height = other.height_of((x[c[0]] + x[c[1]] + x[c[2]]) / 3, reach);
    if (!std::isfinite(height)) continue;
    const double area = area_as_cut(model, static_cast<std::size_t>(t));
    order.together += area;
    if (stacking.over ? height < 0 : height > 0) order.wrong += area;
  }
  return order;
}

Findings started_out_of_order(const design::Garment& garment, const model::Model& model) {
  Findings findings;
  for (const Wrong& wrong : out_of_order(garment, model, model.start, kReachAtStart)) {
    const Words w = words_of(wrong.stacking, model);
    Finding finding{"G0609",
                    Severity::warning,
                    fmt::format("`{}` is declared {} `{}`, but starts {} it: {}% of where the two lie together", w.panel, w.declared,
                                w.other, w.found, format_number(100 * wrong.share, 2)),
                    {{wrong.stacking.origin, ""}},
                    fmt::format("cloth does not pass through cloth: place `{}` on the side of the {} of `{}`", w.panel, w.side, w.other)};
    const design::Placement& placement = garment.panels[wrong.stacking.panel].placement;
    if (placement.origin.value) finding.labels.push_back({placement.origin, "placed here"});
    findings.push_back(std::move(finding));
  }
  return findings;
}

Findings rested_out_of_order(const design::Garment& garment, const model::Model& model, const std::vector<Vector3d>& x) {
  Findings findings;
  for (const Wrong& wrong : out_of_order(garment, model, x, kReachAtRest)) {
    const Words w = words_of(wrong.stacking, model);
    findings.push_back({"G0811",
                        Severity::error,
                        fmt::format("`{}` is declared {} `{}`, but came to rest {} it: {}% of where the two lie together", w.panel,
                                    w.declared, w.other, w.found, format_number(100 * wrong.share, 2)),
                        {{wrong.stacking.origin, ""}},
                        fmt::format("let it start in that order: give `{}` a place of its own on the side of the {} of `{}`, a centimetre off it",
                                    w.panel, w.side, w.other)});
  }
  return findings;
}

}  // namespace garment::modeller
