#pragma once
// From bytes to a JSON value, with limits: the first stage of the pattern reader.
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/io/pattern_json.hpp"
#include "runtime/io/pattern_report.hpp"

namespace garment::io {

struct PatternDocument {
  nlohmann::json root;
  std::vector<std::string> panel_order;  ///< keys of pattern.panels in the order they stand in the file
};

/// Parses the text. Nothing (and an error in `report`, with line and column where there is one) when it is
/// too large, nested too deep, not JSON, or names a key of one object twice.
std::optional<PatternDocument> parse_pattern_document(std::string_view text, const PatternLimits& limits,
                                                      PatternReport& report);

/// Member `key` of `object`; null when there is none or `object` is no object.
const nlohmann::json* member(const nlohmann::json& object, const char* key);

/// "a string", "a list of 3", ... for messages.
std::string describe(const nlohmann::json& value);

/// Number i of a list of finite numbers of at most `limit` in size; nothing if it is not that.
std::optional<double> number_at(const nlohmann::json& list, std::size_t i, double limit);
/// Non-negative whole number below `end`; nothing otherwise.
std::optional<int> index_below(const nlohmann::json& value, std::size_t end);

}  // namespace garment::io
