#pragma once
// Factors of regions and starch, as a field over the panels' material points.
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/design/garment.hpp"
#include "runtime/modeller/elements.hpp"

namespace garment::modeller {

class RegionFields {
 public:
  explicit RegionFields(const design::Garment& garment);

  /// True where no region touches the panel, or every factor is 1: nothing need be asked.
  bool plain(std::size_t panel) const { return panels_[panel].empty(); }
  /// Product of the factors of all regions that hold the point (panel coordinates).
  design::RegionFactors at(std::size_t panel, const design::Point2& p) const;

  /// Regions with factors in which no particle of the meshed panels lies: a warning for each (G1150).
  Findings unreached(const design::Garment& garment, const std::vector<MeshedPanel>& panels) const;

 private:
  struct Entry {
    design::RegionTest test;
    design::RegionFactors factors;
    int region;
  };
  std::vector<std::vector<Entry>> panels_;
};

}  // namespace garment::modeller
