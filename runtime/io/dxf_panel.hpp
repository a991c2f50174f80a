#pragma once
// One piece of a DXF pattern as a panel.
#include <optional>

#include "runtime/design/panel.hpp"
#include "runtime/io/dxf_piece.hpp"
#include "runtime/io/pattern_report.hpp"

namespace garment::io {

/// The panel of a piece in metres: outline (the stitch line), allowances, notches, grain, holes, lines and
/// points; a half is opened about its mirror line. Without name and place. Nothing, and a warning (G0965),
/// where there is no closed outline. What a panel cannot hold is left out with a note.
std::optional<design::Panel> read_dxf_piece(DxfPiece piece, PatternReport& report);

}  // namespace garment::io
