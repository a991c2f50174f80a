#pragma once
// The mesh of one panel, in panel coordinates.
#include <optional>

#include "runtime/modeller/border.hpp"
#include "runtime/modeller/grid_mesh.hpp"

namespace garment::modeller {

struct PanelMesh {
  std::vector<Point2> at;  ///< m; vertices [0, n_border) are the border, counter-clockwise
  std::size_t n_border = 0;
  std::vector<std::array<int, 4>> cells;        ///< 0-1 along weft, 0-3 along warp
  Eigen::Vector2d cell_size{0, 0};              ///< (h1 along weft, h2 along warp), m
  std::vector<std::array<int, 3>> cut;          ///< triangles outside of full cells, counter-clockwise
  std::vector<std::array<int, 3>> cell_halves;  ///< two per cell
};

/// Meshes a panel whose border particles are known; symmetric panels come out as exact mirror images.
/// Nothing, with a finding at the panel, where the border's chords cross or no particle fits inside: the grid
/// is too coarse for it.
std::optional<PanelMesh> mesh_panel(const BorderPanel& panel, const GridFrame& frame, const Border& border,
                                    Findings& findings);

}  // namespace garment::modeller
