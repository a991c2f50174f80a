#pragma once
// Measurement files of Seamly and Valentina: individual (.smis, .vit) and multisize (.smms, .vst).
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/finding.hpp"

namespace garment::io {

inline constexpr std::uint64_t kMaxMeasurementBytes = 4u << 20;

struct Measurement {
  std::string name;    ///< without the @ or # of a custom measure
  double value = 0;    ///< m, or rad
  bool angle = false;  ///< an angle: its name ends in `_angle`, as in Seamly's own list, or it has `specialUnits`
};

struct MeasurementOptions {
  std::optional<double> size, height;  ///< m, of a multisize file; without them its base
};

struct MeasurementsResult {
  std::optional<std::vector<Measurement>> measurements;  ///< in the order of the file
  Findings findings;
};

/// Reads the text of a file. Values may be formulas over other measures of the file, in its own unit (cm, mm,
/// inch).
///
/// Multisize: value = base + (size - base size) / 2 cm * size_increase + (height - base height) / 6 cm *
/// height_increase: the steps are those of both programs (`MeasurementVariable::CalcValue`), whatever sizes
/// the file lists. Where a measure has `sizeRules` or `heightRules`, each step counts with the increment of the last
/// break whose threshold is not above the place where the step begins, before the first with the plain one; part of
/// a step counts in part.
///
/// Newer files of Valentina state `dimensions` with steps of their own, a shift for each and corrections for single
/// sizes; `size` is their dimension y, `height` x, and the others (hip, waist) stay at their base.
///
/// Errors, each with the line: G0720 no measurement file, G0721 a value that cannot be computed (unknown
/// name, cycle, not finite, no formula). Entities of a document type are not expanded.
MeasurementsResult read_measurements(std::string_view text, const MeasurementOptions& options,
                                     const std::string& name, OriginId origin);

}  // namespace garment::io
