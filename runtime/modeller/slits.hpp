#pragma once
// Cuts along interior lines.
#include "runtime/modeller/panel_mesh.hpp"

namespace garment::modeller {

/// Parts the mesh along the panel's slits: every particle on a slit, but for ends that lie inside the cloth, becomes two, 0.1 mm
/// apart. The one to the left of the line keeps its number, the others come last. Where slits meet, a particle becomes as many as
/// there are pieces of cloth between them: three at a T, four at an X, two where they meet at their ends; each moves into its own
/// piece, 0.05 mm from the lips.
void open_slits(const BorderPanel& panel, const Border& border, PanelMesh& mesh);

}  // namespace garment::modeller
