#include "runtime/modeller/cloth_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/modeller/tensile_law.hpp"

namespace garment::modeller {
namespace {

using design::Point2;
using design::RegionFactors;

constexpr double kUsualAllowance = 0.01;  // m, of a seam that is pressed and says nothing of it
constexpr int kSamples = 4;  // along each side of a square that a border crosses

/// Starch stiffens: B and twist by its factor, G by the square root of it.
RegionFactors starched(double factor) {
  RegionFactors f;
  f.bend_warp = f.bend_weft = f.twist = factor;
  f.shear = std::sqrt(factor);
  return f;
}

/// What pressing leaves of the lengths.
Patch pressed(const design::Press& press) {
  const double sign = press.kind == design::Press::Kind::shrink ? -1 : 1;
  Patch patch;
  patch.rest_warp = 1 + sign * press.factor * press.warp;
  patch.rest_weft = 1 + sign * press.factor * press.weft;
  return patch;
}

bool changes_length(const design::Press& press) {
  return press.kind == design::Press::Kind::shrink || press.kind == design::Press::Kind::extend;
}

/// Parts of one panel together: strips beside parts that meet would lie twice at the joint.
std::vector<std::vector<design::EdgePart>> by_panel(const std::vector<design::EdgePart>& parts) {
  std::vector<std::vector<design::EdgePart>> sorted;
  for (const design::EdgePart& part : parts) {
    auto known = std::find_if(sorted.begin(), sorted.end(), [&](const auto& some) { return some[0].panel == part.panel; });
    if (known != sorted.end())
      known->push_back(part);
    else
      sorted.push_back({part});
  }
  return sorted;
}

constexpr double kLeastRest = 0.25;  // length at rest over length as cut

}  // namespace

double sewn_allowance(const design::Garment& garment, const design::Seam& seam, const design::EdgePart& part) {
  const double own = design::edge_of(garment.panels[part.panel], part).allowance;
  return own > 0 ? own : seam.finish.allowance.value_or(kUsualAllowance);
}

ClothFields::ClothFields(const design::Garment& garment)
    : garment_(garment), layers_(garment.layers), panels_(garment.panels.size()) {
  for (const design::Fabric& fabric : garment.fabrics)
    for (const design::Tensile& tensile : fabric.tensile) slope_.push_back(make_tensile_law(tensile).slope.front());
  for (std::size_t r = 0; r < garment.regions.size(); ++r) {
    Patch patch;
    patch.factors = garment.regions[r].factors;
    for (const design::Starch& starch : garment.starches)
      if (starch.region == static_cast<int>(r)) patch.factors = patch.factors * starched(starch.factor);
    add(static_cast<int>(r), -1, patch);
  }
  for (const design::Press& press : garment.presses)
    if (changes_length(press)) add(press.region, -1, pressed(press));
  for (std::size_t k = 0; k < garment.layers.size(); ++k) {
    Patch patch;
    patch.layers.push_back(static_cast<int>(k));
    add(garment.layers[k].region, garment.layers[k].panel, patch);
  }
  for (const design::Hem& hem : garment.hems)
    for (const std::vector<design::EdgePart>& parts : by_panel(hem.parts))
      add_along(parts, hem.turn, garment.panels[parts[0].panel].fabric, hem.to);
  for (const design::Seam& seam : garment.seams) add_allowances(seam);
  for (const design::Panel& panel : garment.panels) outlines_.emplace_back(panel, design::outline_shape(panel));
}

/// What `patch` says holds in the region, on all its panels or on one; without a region on the whole panel.
void ClothFields::add(int region, int only_panel, const Patch& patch) {
  if (patch.alike(Patch{})) return;
  auto add_to = [&](int panel, const design::RegionShape& shape) {
    if (panel < 0 || panel >= static_cast<int>(garment_.panels.size())) return;
    const auto p = static_cast<std::size_t>(panel);
    panels_[p].push_back({design::RegionTest(garment_.panels[p], shape), patch, region});
  };
  if (region < 0 || region >= static_cast<int>(garment_.regions.size())) return add_to(only_panel, design::RegionShape{});
  for (const design::RegionPart& part : garment_.regions[region].parts)
    if (only_panel < 0 || part.panel == only_panel) add_to(part.panel, part.shape);
}

/// A strip of cloth beside the parts, sewn down or pressed flat: a basted layer, outside those that are stated.
void ClothFields::add_along(const std::vector<design::EdgePart>& parts, double width, int fabric, design::Facing side) {
  constexpr int kOutside = 1000;
  if (!(width > 0) || parts.empty()) return;
  const int panel = parts[0].panel;
  design::Layer strip;
  strip.fabric = fabric;
  strip.panel = panel;
  strip.fused = false;
  strip.grain_angle = garment_.panels[panel].grain_angle;
  strip.side = side;
  strip.order = kOutside;
  design::RegionShape shape;
  shape.kind = design::RegionShape::Kind::near;
  shape.parts = parts;
  shape.size = width;
  Patch patch;
  patch.layers.push_back(static_cast<int>(layers_.size()));
  layers_.push_back(strip);
  panels_[panel].push_back({design::RegionTest(garment_.panels[panel], shape), patch, -1});
}

/// Allowances pressed open lie on the back of their own pieces, those pressed to one side all on that one.
void ClothFields::add_allowances(const design::Seam& seam) {
  using Ironed = design::SeamFinish::Ironed;
  if (seam.finish.ironed == Ironed::no) return;
  for (std::size_t on = 0; on < seam.sides.size(); ++on) {
    if (seam.finish.ironed == Ironed::toward && static_cast<int>(on) != seam.finish.ironed_toward) continue;
    for (const std::vector<design::EdgePart>& parts : by_panel(seam.sides[on].parts))
      for (std::size_t from = 0; from < seam.sides.size(); ++from) {
        if (seam.sides[from].parts.empty() || (seam.finish.ironed == Ironed::open && from != on)) continue;
        // Of several pieces on a side the first says what cloth it is.
        const design::EdgePart& own = from == on ? parts[0] : seam.sides[from].parts[0];
        add_along(parts, sewn_allowance(garment_, seam, own), garment_.panels[own.panel].fabric, design::Facing::back);
      }
  }
}

Patch ClothFields::at(std::size_t panel, const Point2& p) const {
  Patch sum;
  for (const Entry& entry : panels_[panel]) {
    if (!entry.test.contains(p)) continue;
    sum.factors = sum.factors * entry.patch.factors;
    sum.rest_warp *= entry.patch.rest_warp;
    sum.rest_weft *= entry.patch.rest_weft;
    sum.layers.insert(sum.layers.end(), entry.patch.layers.begin(), entry.patch.layers.end());
  }
  sum.rest_warp = std::max(kLeastRest, sum.rest_warp);
  sum.rest_weft = std::max(kLeastRest, sum.rest_weft);
  return sum;
}

std::vector<Patch> ClothFields::around(std::size_t panel, const Point2& p, double width) const {
  const Patch middle = at(panel, p);
  bool border = false;
  for (const Point2& corner : {Point2(-1, -1), Point2(1, -1), Point2(1, 1), Point2(-1, 1)})
    border = border || !at(panel, p + width / 2 * corner).alike(middle);
  if (!border) return {middle};
  std::vector<Patch> patches;
  int counted = 0;
  for (int i = 0; i < kSamples; ++i)
    for (int j = 0; j < kSamples; ++j) {
      const Point2 off((i + 0.5) / kSamples - 0.5, (j + 0.5) / kSamples - 0.5);
      if (!outlines_[panel].contains(p + width * off)) continue;
      Patch here = at(panel, p + width * off);
      ++counted;
      auto known = std::find_if(patches.begin(), patches.end(), [&](const Patch& other) { return other.alike(here); });
      if (known != patches.end())
        known->share += 1;
      else
        patches.push_back(std::move(here));
    }
  if (counted == 0) return {middle};
  for (Patch& patch : patches) patch.share /= counted;
  return patches;
}

Findings ClothFields::unreached(const std::vector<MeshedPanel>& panels) const {
  std::vector<char> known(garment_.regions.size(), 0), reached(garment_.regions.size(), 0);
  for (std::size_t p = 0; p < panels.size(); ++p)
    for (const Entry& entry : panels_[p]) {
      if (entry.region < 0) continue;
      const auto r = static_cast<std::size_t>(entry.region);
      known[r] = 1;
      for (std::size_t v = 0; v < panels[p].mesh.at.size() && !reached[r]; ++v)
        reached[r] = entry.test.contains(panels[p].mesh.at[v]);
    }
  Findings findings;
  for (std::size_t r = 0; r < known.size(); ++r)
    if (known[r] && !reached[r])
      findings.push_back(
          {"G1150",
           Severity::warning,
           fmt::format("region `{}` is finer than the grid: no particle lies in it", garment_.regions[r].name),
           {{garment_.regions[r].origin, ""}},
           "give the panel a finer resolution, or make the region larger"});
  return findings;
}

}  // namespace garment::modeller
