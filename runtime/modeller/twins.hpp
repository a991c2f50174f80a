#pragma once
#include "runtime/modeller/elements.hpp"

namespace garment::modeller {

/// Sewing can lay two triangles onto the same three particles (where a border is folded onto itself, or two
/// panels meet round a corner). Turns a diagonal of one of them, within its cell or among cut triangles, so
/// that no two triangles share all their corners. Twins that no diagonal parts are left.
void part_twins(std::vector<MeshedPanel>& panels, const std::vector<model::Index>& particle);

}  // namespace garment::modeller
