#pragma once
// Bending and twist stencils. Particles amid full cells bend along their grid lines; all others that lie
// within the sewn sheet bend by a fitted quadratic; particles on free borders have no stencil and leave their
// area to the nearest that has.
#include "runtime/modeller/elements.hpp"

namespace garment::modeller {

class ClothFields;
class Folds;

/// Fills bend_*, fit_*, fold_* and cell_twist. Warp, weft and twist weights each add up to the area of the garment,
/// so that a uniform curvature has the energy A/2 kappa . D kappa on any outline of one cloth. With
/// rigidities B_1 (warp), B_2 (weft), Ct, and kappa in the cloth's axes, D = diag(B_1, B_2, 4 Ct).
void add_bending(const std::vector<MeshedPanel>& panels, const ClothFields& fields, const Folds& folds,
                 model::Model& model);

}  // namespace garment::modeller
