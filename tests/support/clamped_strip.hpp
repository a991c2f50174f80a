#pragma once
// A strip that bends under its own weight: the cantilever of textbooks.
#include "tests/support/grid_model.hpp"

namespace garment::test {

/// A strip of two rows along weft, clamped at its left end with the half bending length that a clamp needs.
inline model::Model clamped_strip(SheetSpec& spec, int cells, double length, double gamma, double rigidity) {
  spec.nx = cells + 2;  // one column more inside the clamp
  spec.ny = 2;
  spec.h = length / cells;
  spec.bend = rigidity;
  spec.density = gamma * rigidity / (kGravity * length * length * length);
  spec.stretch = 2000 * rigidity / (spec.h * spec.h);
  spec.shear = spec.stretch / 50;
  spec.twist = 0.4 * rigidity;
  spec.plane = SheetPlane::horizontal;
  model::Model m = make_sheet(spec);
  hold_column(m, spec, 0);
  hold_column(m, spec, 1);
  for (std::size_t k = 0; k < m.bend.size(); ++k)
    if (m.bend[k][1] % spec.nx == 1) m.bend_lengths[k] = {0, spec.h};
  return m;
}

}  // namespace garment::test
