#pragma once
// Differences between what a test expects and what came, as a person reads them. Empty text: there are none.
#include <optional>
#include <string>

#include "interpreter/cli/golden_expectations.hpp"
#include "interpreter/cli/golden_outcome.hpp"

namespace garment::cli {

/// Diagnostics that did not come, and those that nothing expects.
std::string compare_diagnostics(const Expectations& expected, const GoldenOutcome& outcome);

/// Values of `#! expect:` lines; numbers may differ by the tolerance.
std::string compare_values(const Expectations& expected, const GoldenOutcome& outcome);

/// Lines of two texts that differ, `-` for the golden and `+` for what came, with two lines around, and numbers that
/// changed side by side. Lines whose numbers lie within the tolerance are the same.
std::string compare_texts(const std::string& golden, const std::string& now,
                          const std::optional<GoldenTolerance>& tolerance);

}  // namespace garment::cli
