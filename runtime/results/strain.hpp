#pragma once
// How much the cloth is stretched and sheared. Strain is (l - l0) / l0 along warp and weft lines: l / l0 - 1
// of springs, |U| - 1 and |V| - 1 of cut cells. Only tension counts as strain of a garment: gathers are
// compressed by right.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/model/model.hpp"

namespace garment::results {

/// Tensile strains of many samples, 1 = 100 %. Zero where nothing is stretched.
struct Tension {
  double largest = 0;
  double p99 = 0;  ///< 99 % of the sampled area is stretched no more than this
};

struct PanelStrain {
  std::string panel;  ///< "all" for the whole garment
  Tension warp, weft;
  Tension any;               ///< both directions together; `any.largest` is the `strain(...)` of the language
  double largest_shear = 0;  ///< |pi/2 - angle(warp, weft)| of cells and cut cells, rad
};

struct StrainReport {
  std::vector<PanelStrain> panels;  ///< in the order of the model's panels
  PanelStrain all;
};

/// Strains at the positions of `state`.
StrainReport measure_strain(const model::Model& model, const model::State& state);

/// (warp, weft) strain at every vertex [n_vertices], compression negative: means over the adjoining springs
/// and cut cells of the vertex's panel, weighted by area. For pictures and files; smoother than
/// `measure_strain`.
std::vector<Eigen::Vector2d> vertex_strain(const model::Model& model, const model::State& state);

}  // namespace garment::results
