#include "runtime/modeller/region_fields.hpp"

#include <fmt/format.h>

#include <cmath>

namespace garment::modeller {
namespace {

using design::RegionFactors;

/// Starch stiffens: B and twist by its factor, G by the square root of it.
RegionFactors starched(double factor) {
  RegionFactors f;
  f.bend_warp = f.bend_weft = f.twist = factor;
  f.shear = std::sqrt(factor);
  return f;
}

}  // namespace

RegionFields::RegionFields(const design::Garment& garment) : panels_(garment.panels.size()) {
  for (std::size_t r = 0; r < garment.regions.size(); ++r) {
    const design::Region& region = garment.regions[r];
    RegionFactors factors = region.factors;
    for (const design::Starch& starch : garment.starches)
      if (starch.region == static_cast<int>(r)) factors = factors * starched(starch.factor);
    if (factors == RegionFactors{}) continue;
    for (const design::RegionPart& part : region.parts) {
      if (part.panel < 0 || part.panel >= static_cast<int>(garment.panels.size())) continue;
      const auto p = static_cast<std::size_t>(part.panel);
      panels_[p].push_back({design::RegionTest(garment.panels[p], part.shape), factors, static_cast<int>(r)});
    }
  }
}

RegionFactors RegionFields::at(std::size_t panel, const design::Point2& p) const {
  RegionFactors product;
  for (const Entry& entry : panels_[panel])
    if (entry.test.contains(p)) product = product * entry.factors;
  return product;
}

Findings RegionFields::unreached(const design::Garment& garment,
                                 const std::vector<MeshedPanel>& panels) const {
  std::vector<char> known(garment.regions.size(), 0), reached(garment.regions.size(), 0);
  for (std::size_t p = 0; p < panels.size(); ++p)
    for (const Entry& entry : panels_[p]) {
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
           fmt::format("region `{}` is finer than the grid: no particle lies in it", garment.regions[r].name),
           {{garment.regions[r].origin, ""}},
           "give the panel a finer resolution, or make the region larger"});
  return findings;
}

}  // namespace garment::modeller
