#pragma once
// What a script says itself, in `#!` comments, about the outcome of its test.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/language/units.hpp"

namespace garment::cli {

/// The part of the program that a test looks at.
enum class GoldenStage { parse, format, check, model, run };
std::optional<GoldenStage> golden_stage(std::string_view name);

/// How far a number may be from the golden one: a part of it, or a quantity of one dimension.
struct GoldenTolerance {
  bool relative = false;
  double value = 0;  ///< SI, or a part
  interpreter::Dimension dimension{};
};
/// "2%", "1 mm", "0.5"; nothing if it is none of these.
std::optional<GoldenTolerance> golden_tolerance(std::string_view text);

/// `#! error[G0312] 7-12 "part of the message"`: a diagnostic of the line below.
struct ExpectedDiagnostic {
  std::size_t line = 0;  ///< of the code it speaks of, from 1
  std::string severity, code, part;
  std::uint32_t first = 0, last = 0;  ///< columns; 0: of the script as a whole, no place
};

/// `#! expect: 58 cm`: what the `let`, `param` or `measure` of the line below is.
struct ExpectedValue {
  std::size_t line = 0;
  std::string text;
};

struct Expectations {
  std::vector<ExpectedDiagnostic> diagnostics;
  std::vector<ExpectedValue> values;
  std::optional<GoldenStage> stage;
  std::optional<GoldenTolerance> tolerance;
  bool about_diagnostics = false;  ///< `#! ok` or an expected diagnostic: no .expected file is needed
  std::string malformed;           ///< the first `#!` line that says nothing known, told; empty if none
};

/// Reads all `#!` lines of a script.
Expectations read_expectations(const std::string& script);

}  // namespace garment::cli
