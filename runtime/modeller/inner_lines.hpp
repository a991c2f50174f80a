#pragma once
// Which lines inside a panel the mesh follows: those that something is sewn to, held or folded along, and cuts.
#include <vector>

#include "runtime/design/garment.hpp"
#include "runtime/modeller/outline.hpp"

namespace garment::modeller {

/// The lines of panel `panel`, whose grid spacing is `h` (m), that seams, zips, attachments, clamps, folds and slits lie on, in the panel's
/// order, each whole and once; then the lines of its pleats.
std::vector<InnerLine> lines_to_follow(const design::Garment& garment, int panel, double h);

}  // namespace garment::modeller
