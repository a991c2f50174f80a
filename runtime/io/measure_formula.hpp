#pragma once
// The formulas in which Seamly and Valentina state measures: `waist_circ / 2 + 1.5`, `max(bust_circ,
// #custom)`.
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace garment::io {

struct FormulaResult {
  std::optional<double> value;
  std::string error;  ///< "`waits_circ` is no measure of this file", where there is no value
};

/// What a name stands for; a result without value is handed through.
using FormulaNames = std::function<FormulaResult(const std::string&)>;

/// Computes `text`: numbers, names (a leading @ or # is part of no name), + - * / ^, parentheses, and the
/// functions min max sum avg abs sqrt sin cos tan (radians) sinD cosD tanD (degrees) degTorad radTodeg.
/// Arguments are parted by , or ;. Deeper than 40 brackets is refused, and so is what is not finite.
FormulaResult compute_formula(std::string_view text, const FormulaNames& names);

}  // namespace garment::io
