#pragma once
// The one printer and the one parser of numbers. The locale never matters; -0 prints as 0.
#include <optional>
#include <string>
#include <string_view>

namespace garment {

/// Shortest text that reads back to the same double ("0.1", "1e-07"). NaN and infinities print as "nan", "inf".
std::string format_number(double value);

/// `value` with at most `digits` significant digits, trailing zeros removed; for messages and tables.
std::string format_number(double value, int digits);

/// The number that all of `text` spells (decimal point, optional exponent and sign); nothing if it is not one or not finite.
std::optional<double> parse_number(std::string_view text);

}  // namespace garment
