#pragma once
// Buttons, hooks, snaps and tacks: ties between places of the cloth. Zips are sewn as far as they are closed
// (matching.hpp).
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/design/garment.hpp"
#include "runtime/model/model.hpp"

namespace garment::modeller {

/// Fills ties and closures, and adds the mass of the buttons to the particles of their places. The panels must be placed:
/// a tack goes to what lies nearest to it at the start. Findings: what names no panel (G0652), a tack whose panels lie too
/// far apart (G0653).
void add_closures(const design::Garment& garment, model::Model& model, Findings& findings);

}  // namespace garment::modeller
