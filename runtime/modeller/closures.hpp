#pragma once
// Buttons, hooks, snaps, tacks, and seams that are tied: ties between places of the cloth. Zips are sewn as far as they are closed
// (matching.hpp).
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/design/garment.hpp"
#include "runtime/model/model.hpp"
#include "runtime/modeller/sewing.hpp"

namespace garment::modeller {

/// Fills ties and closures, and adds the mass of the buttons to the particles of their places. The panels must be placed:
/// a tack goes to what lies nearest to it at the start. Findings: what names no panel (G0652), a tack whose panels lie too
/// far apart (G0653).
void add_closures(const design::Garment& garment, model::Model& model, Findings& findings);

/// Fills ties and closures for seams that are more than merged particles: of a slack seam, threads as long as the slack between
/// corresponding places of its sides; of a lapped one, stitches from each side's edge to the other side, by the lap inside its
/// edge; of one with a thread that draws in, the thread from particle to particle, (1 + tension) times as long as the cloth.
void add_seam_ties(const std::vector<SewnSides>& sides, model::Model& model, Findings& findings);

}  // namespace garment::modeller
