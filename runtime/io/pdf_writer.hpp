#pragma once
// The flat pattern on paper: a PDF in true scale, tiled over pages of a printer.
#include <optional>
#include <string>
#include <string_view>

#include "runtime/design/garment.hpp"
#include "runtime/model/model.hpp"

namespace garment::io {

/// Upright sheet, mm.
struct PaperSize {
  const char* name = "A4";
  double width = 210, height = 297;
};
/// A4, A3, A2, A1, A0, letter; nothing for other names. Upper or lower case.
std::optional<PaperSize> find_paper(std::string_view name);
/// "A4, A3, ...": for messages.
std::string paper_names();

/// The first page has the title, a test square of 50 mm, the cut list and a map of the tiles; then come the
/// tiles, row by row, those without a line left out. Neighbours overlap by 10 mm; each tile has its number
/// ("B2"), a frame to cut and glue along, and the numbers of its neighbours. Of a pair the left piece alone
/// is drawn. Returns the bytes of a PDF file, the same for the same garment: it holds no date. Empty where
/// the library gives up.
std::string write_pattern_pdf(const design::Garment& garment, const model::Model* model,
                              const PaperSize& paper);

}  // namespace garment::io
