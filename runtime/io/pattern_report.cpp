#include "runtime/io/pattern_report.hpp"

#include <fmt/format.h>

namespace garment::io {
namespace {

constexpr int kShownPerCode = 12;
constexpr std::size_t kMaxNotes = 5000;
constexpr std::size_t kMaxQuoted = 60;

}  // namespace

void PatternReport::add(const char* code, Severity severity, std::string message, std::string help) {
  Held& held = by_code_[code];
  if (severity == Severity::error || held.shown == 0) held.severity = severity;
  if (held.shown >= kShownPerCode) {
    ++held.held;
    return;
  }
  ++held.shown;
  findings_.push_back({code, severity, std::move(message), {}, std::move(help)});
}

void PatternReport::note(std::string text) {
  if (notes_.size() < kMaxNotes) notes_.push_back(std::move(text));
}

Findings PatternReport::take_findings() {
  for (const auto& [code, held] : by_code_)
    if (held.held > 0)
      findings_.push_back({code, held.severity, fmt::format("{} more like these", held.held), {}, ""});
  by_code_.clear();
  return std::move(findings_);
}

std::string in_ticks(std::string_view name) {
  std::string out = "`";
  std::size_t end = name.size();
  if (end > kMaxQuoted) {
    end = kMaxQuoted;
    while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0) == 0x80)
      --end;  // not inside a character
  }
  for (char c : name.substr(0, end)) out += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c;
  if (end < name.size()) out += "...";
  return out + "`";
}

}  // namespace garment::io
