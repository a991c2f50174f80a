#pragma once
// Triangles where lines inside a panel meet its border.
#include "runtime/modeller/grid_mesh.hpp"

namespace garment::modeller {

/// Lets a side of the mesh lead from every corner between a line and the border (or two lines), where none does. Pleats stitched
/// down at a sewn edge have several layers there that share the particles of both: a triangle that cuts the corner would lie in
/// all of them, and would cut through triangles that do not. Leaves as they are sides that would make an angle under 15 degrees.
void fan_out_corners(const LoopBorder& border, LoopMesh& mesh);

}  // namespace garment::modeller
