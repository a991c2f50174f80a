#pragma once
// Stitches of a pattern file: pairs of edges in, seams with a stated relation of lengths out.
#include <nlohmann/json.hpp>
#include <vector>

#include "runtime/design/garment.hpp"
#include "runtime/io/pattern_panel.hpp"

namespace garment::io {

constexpr double kPlainSeam = 2e-3;  ///< m; the sides of a seam without a relation may differ by this much

/// Reads `pattern.stitches` into seams of `panels` (indices as in the vector). The start of the first edge
/// meets the end of the second, with "right_wrong" its start. The longer side comes first and walks its edge
/// as drawn; its ratio is the length relation as a script prints it (see stated_ratio). Names are left empty.
/// `numbers` receives the number of each seam's stitch in the file.
std::vector<design::Seam> read_pattern_stitches(const nlohmann::json* stitches,
                                                const std::vector<FilePanel>& panels,
                                                const PatternLimits& limits, PatternReport& report,
                                                std::vector<std::size_t>* numbers = nullptr);

/// `length / reference` as a script states it: 1 where the two agree within 2 mm; below 1.5 an ease in
/// percent of two decimals; else a gather of four decimals. Both lengths in metres, length >= reference > 0.
double stated_ratio(double length, double reference);

}  // namespace garment::io
