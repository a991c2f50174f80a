#pragma once
// The flat pattern as an AAMA-292 / ASTM D6673 DXF.
#include <string>

#include "runtime/base/finding.hpp"
#include "runtime/design/garment.hpp"

namespace garment::io {

struct DxfText {
  std::string text;
  Findings findings;  ///< G0906: what the format cannot hold
};

/// One block for each panel, millimetres, R12 (AC1009): the boundary on layer 1 (the cut line where there are
/// allowances, then the stitch line on 14), turn and curve points on 2 and 3, notches on 4, grain on 7, inner
/// lines and darts on 8, holes on 11, points and tips of darts on 13, texts. Curves are followed within 3
/// micrometres, so that areas keep four digits. Text beyond ASCII is written as \U+00E9. The same garment
/// gives the same bytes.
DxfText write_dxf(const design::Garment& garment);

}  // namespace garment::io
