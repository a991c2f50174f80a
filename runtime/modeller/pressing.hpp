#pragma once
// What the iron leaves of folds: bending stencils that are folded at rest.
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/modeller/elements.hpp"

namespace garment::modeller {

/// Fills crease_* from the garment's presses, in the order in which they are stated, for the grid lines that they cross:
///   fold   along a line: a thread that crosses it at the angle b to it is folded by 2 asin(sin b sin(angle / 2)), spread over
///          the length radius * angle; where the mesh follows the line (folding.hpp), at the particles that lie on it
///   curl   in a region: 1 / radius about the line, of which a thread at the angle b to it has the part sin^2 b, and the twist
///          of cells, twist_*, the part sin b cos b
///   flat   in a region: what was folded there before is taken out, by the factor
/// Angles are times `set` and `factor`. Borders and seams, whose stencils are fitted, stay as they are. Needs bend_*.
/// A press that reaches no thread: a warning (G1150).
void add_creases(const design::Garment& garment, const std::vector<MeshedPanel>& panels,
                 const std::vector<BorderPanel>& outlines, model::Model& model, Findings& findings);

}  // namespace garment::modeller
