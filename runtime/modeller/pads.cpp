#include "runtime/modeller/pads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace garment::modeller {
namespace {

using design::Point2;

constexpr double kRegionStep = 2e-3;  // m between the places at which a region is asked for its border

/// Where the places of one panel lie in the region of a pad.
class PadShape {
 public:
  PadShape(const design::Garment& garment, const design::Pad& pad, const std::vector<Point2>& places) : pad_(pad) {
    if (pad.region < 0) return;
    for (const design::RegionPart& part : garment.regions[pad.region].parts)
      if (part.panel == pad.panel) test_.emplace_back(garment.panels[pad.panel], part.shape);
    Point2 low(1e300, 1e300), high(-1e300, -1e300);
    for (const Point2& p : places)
      if (inside(p)) low = low.cwiseMin(p), high = high.cwiseMax(p);
    if (!(low.x() <= high.x())) return;
    const double beyond = 2 * garment.panels[pad.panel].resolution;  // no particle need lie at the border
    low -= Point2(beyond, beyond);
    high += Point2(beyond, beyond);
    const double step = std::max(kRegionStep, (high - low).maxCoeff() / 100);
    auto look = [&](const auto& is_outside) {
      for (double y = low.y(); y <= high.y(); y += step)
        for (double x = low.x(); x <= high.x(); x += step)
          if (is_outside(Point2(x, y))) outside_.emplace_back(x, y);
    };
    look([&](const Point2& p) { return !inside(p); });
    if (outside_.empty()) {  // a region without a border of its own: the panel's
      const design::RegionTest outline(garment.panels[pad.panel], design::outline_shape(garment.panels[pad.panel]));
      look([&](const Point2& p) { return !outline.contains(p); });
    }
    for (const Point2& p : places)
      if (inside(p)) deepest_ = std::max(deepest_, depth(p));
  }

  /// 0 in the middle, 1 on the border; nothing beyond it.
  std::optional<double> ring(const Point2& p) const {
    if (pad_.region < 0) {
      const double share = (p - pad_.centre).norm() / pad_.radius;
      return share <= 1 ? std::optional<double>(share) : std::nullopt;
    }
    if (!inside(p)) return std::nullopt;
    return deepest_ > 0 ? 1 - depth(p) / deepest_ : 0;
  }

 private:
  bool inside(const Point2& p) const {
    return std::any_of(test_.begin(), test_.end(), [&](const design::RegionTest& t) { return t.contains(p); });
  }
  double depth(const Point2& p) const {
    double least = 1e300;
    for (const Point2& q : outside_) least = std::min(least, (q - p).squaredNorm());
    return std::sqrt(least);
  }

  const design::Pad& pad_;
  std::vector<design::RegionTest> test_;
  std::vector<Point2> outside_;
  double deepest_ = 0;
};

double thickness_at(const std::vector<double>& profile, double ring) {
  if (profile.size() < 2) return profile.empty() ? 0 : profile[0];
  const double at = ring * static_cast<double>(profile.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(at), profile.size() - 2);
  return profile[k] + (at - static_cast<double>(k)) * (profile[k + 1] - profile[k]);
}

}  // namespace

void add_pads(const design::Garment& garment, const std::vector<MeshedPanel>& panels, model::Model& model, Findings& findings) {
  std::vector<double> padding(model.n_particles(), 0);
  for (const design::Pad& pad : garment.pads) {
    if (pad.panel < 0 || pad.panel >= static_cast<int>(panels.size())) continue;
    const MeshedPanel& panel = panels[pad.panel];
    const PadShape shape(garment, pad, panel.mesh.at);
    bool any = false;
    for (std::size_t v = 0; v < panel.mesh.at.size(); ++v) {
      const std::optional<double> ring = shape.ring(panel.mesh.at[v]);
      if (!ring) continue;
      any = true;
      double& at = padding[model.vertex_particle[panel.first_vertex + v]];
      at = std::max(at, thickness_at(pad.thickness, *ring));
    }
    if (!any)
      findings.push_back({"G1150",
                          Severity::warning,
                          fmt::format("no particle of panel `{}` lies on pad `{}`", panel.panel->name, pad.name),
                          {{pad.origin, ""}},
                          "give the panel a finer resolution, or make the pad larger"});
  }
  for (std::size_t i = 0; i < padding.size(); ++i) {
    if (!(padding[i] > 0)) continue;
    model.pad_particle.push_back(static_cast<model::Index>(i));
    model.pad_thickness.push_back(padding[i]);
  }
}

}  // namespace garment::modeller
