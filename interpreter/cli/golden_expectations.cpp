#include "interpreter/cli/golden_expectations.hpp"

#include <fmt/format.h>

#include <charconv>

#include "runtime/base/number.hpp"

namespace garment::cli {
namespace {

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t' || s.back() == '\r')) s.remove_suffix(1);
  return s;
}

bool take_number(std::string_view& s, std::uint32_t& number) {
  const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), number);
  if (error != std::errc{}) return false;
  s.remove_prefix(static_cast<std::size_t>(end - s.data()));
  return true;
}

/// `error[G0312] 7-12 "text"`; nothing if it is not of that shape.
std::optional<ExpectedDiagnostic> read_diagnostic(std::string_view s) {
  ExpectedDiagnostic e;
  const std::size_t open = s.find('[');
  if (open == std::string_view::npos || s.substr(open).size() < 7 || s[open + 6] != ']') return std::nullopt;
  e.severity = trimmed(s.substr(0, open));
  if (e.severity != "error" && e.severity != "warning" && e.severity != "note") return std::nullopt;
  e.code = s.substr(open + 1, 5);
  s = trimmed(s.substr(open + 7));
  if (!s.empty() && s.front() != '"') {
    if (!take_number(s, e.first) || e.first == 0 || s.empty() || s.front() != '-') return std::nullopt;
    s.remove_prefix(1);
    if (!take_number(s, e.last)) return std::nullopt;
    s = trimmed(s);
  }
  if (s.size() < 3 || s.front() != '"' || s.back() != '"') return std::nullopt;
  e.part = s.substr(1, s.size() - 2);
  return e;
}

/// The value of `word: value`; nothing if the line begins otherwise.
std::optional<std::string_view> value_of(std::string_view row, std::string_view word) {
  if (row.substr(0, word.size()) != word) return std::nullopt;
  row = trimmed(row.substr(word.size()));
  if (row.empty() || row.front() != ':') return std::nullopt;
  return trimmed(row.substr(1));
}

/// Takes in one `#!` line, without its `#!`; false if it says nothing known.
bool take_line(std::string_view row, Expectations& out, std::vector<ExpectedDiagnostic>& open,
               std::vector<ExpectedValue>& values) {
  if (row == "ok") return out.about_diagnostics = true;
  if (const auto stage = value_of(row, "stage")) return (out.stage = golden_stage(*stage)).has_value();
  if (const auto tolerance = value_of(row, "tolerance"))
    return (out.tolerance = golden_tolerance(*tolerance)).has_value();
  if (const auto value = value_of(row, "expect")) {
    if (value->empty()) return false;
    values.push_back({0, std::string(*value)});
    return true;
  }
  const auto diagnostic = read_diagnostic(row);
  if (!diagnostic) return false;
  open.push_back(*diagnostic);
  return out.about_diagnostics = true;
}

}  // namespace

std::optional<GoldenStage> golden_stage(std::string_view name) {
  constexpr std::pair<std::string_view, GoldenStage> kStages[] = {{"parse", GoldenStage::parse},
                                                                  {"format", GoldenStage::format},
                                                                  {"check", GoldenStage::check},
                                                                  {"model", GoldenStage::model},
                                                                  {"run", GoldenStage::run}};
  for (const auto& [word, stage] : kStages)
    if (word == name) return stage;
  return std::nullopt;
}

std::optional<GoldenTolerance> golden_tolerance(std::string_view text) {
  std::size_t end = 0;
  while (end < text.size() && ((text[end] >= '0' && text[end] <= '9') || text[end] == '.' || text[end] == 'e' ||
                               (text[end] == '-' && end > 0)))
    ++end;
  const auto number = parse_number(text.substr(0, end));
  const auto unit = interpreter::find_unit(trimmed(text.substr(end)));
  if (!number || !(*number >= 0) || !unit) return std::nullopt;
  return GoldenTolerance{unit->percent, *number * unit->factor, unit->dimension};
}

Expectations read_expectations(const std::string& script) {
  Expectations out;
  std::vector<ExpectedDiagnostic> open;
  std::vector<ExpectedValue> values;
  std::size_t line = 0;
  const auto settle = [&](std::size_t at) {
    for (ExpectedDiagnostic& e : open) e.line = at, out.diagnostics.push_back(e);
    for (ExpectedValue& e : values) e.line = at, out.values.push_back(e);
    open.clear();
    values.clear();
  };
  for (std::size_t begin = 0; begin < script.size();) {
    const std::size_t end = std::min(script.find('\n', begin), script.size());
    const std::string_view row = trimmed(std::string_view(script).substr(begin, end - begin));
    begin = end + 1;
    ++line;
    if (row.substr(0, 2) != "#!")
      settle(line);
    else if (!take_line(trimmed(row.substr(2)), out, open, values) && out.malformed.empty())
      out.malformed = fmt::format(
          "line {}: `{}` says nothing known; there are `#! ok`, `#! error[G0312] 7-12 \"part of the message\"` (also "
          "warning, note), `#! expect: VALUE`, `#! stage: parse | format | check | model | run`, `#! tolerance: 2%`",
          line, row);
  }
  settle(line + 1);  // below the last line: the end of the text
  return out;
}

}  // namespace garment::cli
