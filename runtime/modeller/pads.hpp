#pragma once
// Soft pieces between the cloth and the body: shoulder pads.
#include "runtime/modeller/elements.hpp"

namespace garment::modeller {

/// Fills pad_*: how far the pads keep each particle off the bodies. A pad's thickness runs over equal steps from its innermost
/// place to the border of its region or circle; what seams join has the largest. A pad that no particle lies on: a warning
/// (G1150).
void add_pads(const design::Garment& garment, const std::vector<MeshedPanel>& panels, model::Model& model, Findings& findings);

}  // namespace garment::modeller
