#pragma once
// What cloth lies where on the panels: factors of regions and starch, what was shrunk or drawn out, layers joined to the panel,
// hems and pressed allowances.
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/design/garment.hpp"
#include "runtime/modeller/elements.hpp"

namespace garment::modeller {

/// Cloth of one kind about a place of a panel.
struct Patch {
  double share = 1;                     ///< of the place, 0 .. 1
  design::RegionFactors factors{};      ///< product of the factors of all regions that hold it
  double rest_warp = 1, rest_weft = 1;  ///< length at rest over length as cut
  std::vector<int> layers{};            ///< joined to the panel there; indices into ClothFields::layers, ascending

  bool alike(const Patch& other) const {
    return factors == other.factors && rest_warp == other.rest_warp && rest_weft == other.rest_weft && layers == other.layers;
  }
};

/// Width of cloth beyond the stitch line of a part of a seam, m: the edge's own, the seam's, or else 1 cm.
double sewn_allowance(const design::Garment& garment, const design::Seam& seam, const design::EdgePart& part);

class ClothFields {
 public:
  explicit ClothFields(const design::Garment& garment);

  const design::Garment& garment() const { return garment_; }
  /// Layers of the garment, then hems and pressed allowances: the panel's own cloth, turned over.
  const std::vector<design::Layer>& layers() const { return layers_; }
  /// dN/dstrain of a fabric at rest, N/m; direction 0 is warp, 1 weft.
  double slope(int fabric, int direction) const { return slope_[static_cast<std::size_t>(2 * fabric + direction)]; }
  /// True where the whole panel is its fabric, as it came from the loom: nothing need be asked.
  bool plain(std::size_t panel) const { return panels_[panel].empty(); }
  /// The cloth in the square of side `width` (m) about the point (panel coordinates); shares add up to 1. On the border of
  /// a region both sides have their shares, to a sixteenth of the square, so that nothing jumps with the grid.
  std::vector<Patch> around(std::size_t panel, const design::Point2& p, double width) const;

  /// Regions with something to say in which no particle of the meshed panels lies: a warning for each (G1150).
  Findings unreached(const std::vector<MeshedPanel>& panels) const;

 private:
  struct Entry {
    design::RegionTest test;
    Patch patch;  // one layer at most
    int region;   // -1: the whole panel
  };
  void add(int region, int only_panel, const Patch& patch);
  void add_along(const std::vector<design::EdgePart>& parts, double width, int fabric, design::Facing side);
  void add_allowances(const design::Seam& seam);
  Patch at(std::size_t panel, const design::Point2& p) const;

  const design::Garment& garment_;
  std::vector<design::Layer> layers_;
  std::vector<std::vector<Entry>> panels_;
  std::vector<design::RegionTest> outlines_;  // of the panels, without their holes
  std::vector<double> slope_;
};

}  // namespace garment::modeller
