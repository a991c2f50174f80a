#pragma once
// Pieces that come without places: moved to their corners and laid side by side.
#include "runtime/design/garment.hpp"

namespace garment::io {

/// Moves every panel's own coordinates so that its box begins at (0, 0), and places the panels upright on y =
/// 0 in a row, 5 cm apart, faces to +z.
void lay_flat(design::Garment& garment);

}  // namespace garment::io
