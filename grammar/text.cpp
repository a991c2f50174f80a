#include "grammar/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace garment::grammar {

Character decode_utf8(std::string_view text, std::size_t at) {
  auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  unsigned char first = byte(at);
  if (first < 0x80) return {first, 1, true};
  std::uint32_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || at + length > text.size()) return {first, 1, false};
  std::uint32_t code = first & (0xFFu >> (length + 1));
  for (std::uint32_t i = 1; i < length; ++i) {
    if (!is_utf8_tail(text[at + i])) return {first, 1, false};
    code = code << 6 | (byte(at + i) & 0x3Fu);
  }
  constexpr std::array<std::uint32_t, 5> kSmallest = {0, 0, 0x80, 0x800, 0x10000};
  bool surrogate = code >= 0xD800 && code < 0xE000;
  if (code < kSmallest[length] || code > 0x10FFFF || surrogate) return {first, 1, false};
  return {code, length, true};
}

std::size_t find_invalid_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    Character c = decode_utf8(text, i);
    if (!c.valid) return i;
    i += c.length;
  }
  return std::string_view::npos;
}

int display_width(std::uint32_t code) {
  struct Range {
    std::uint32_t first, last;
  };
  constexpr std::array<Range, 6> kCombining = {
      {{0x300, 0x36F}, {0x483, 0x489}, {0x591, 0x5BD}, {0x1AB0, 0x1AFF}, {0x20D0, 0x20FF}, {0xFE00, 0xFE0F}}};
  constexpr std::array<Range, 9> kWide = {{{0x1100, 0x115F},
                                           {0x2E80, 0x303E},
                                           {0x3041, 0xA4CF},
                                           {0xAC00, 0xD7A3},
                                           {0xF900, 0xFAFF},
                                           {0xFE30, 0xFE6F},
                                           {0xFF00, 0xFF60},
                                           {0x1F300, 0x1FAFF},
                                           {0x20000, 0x3FFFD}}};
  auto within = [code](Range r) { return code >= r.first && code <= r.last; };
  if (std::any_of(kCombining.begin(), kCombining.end(), within)) return 0;
  return std::any_of(kWide.begin(), kWide.end(), within) ? 2 : 1;
}

bool is_control(std::uint32_t code) {
  bool control = code < 0x20 || (code >= 0x7F && code < 0xA0);
  bool reorders = code == 0x61C || (code >= 0x200B && code <= 0x200F) || (code >= 0x2028 && code <= 0x202E) ||
                  (code >= 0x2060 && code <= 0x206F) || code == 0xFEFF;
  return control || reorders;
}

std::string escape_character(std::uint32_t code) {
  if (code == '\t') return "\\t";
  if (code == '\n') return "\\n";
  if (code == '\r') return "\\r";
  return code < 0x100 ? fmt::format("\\x{:02x}", code) : fmt::format("\\u{{{:x}}}", code);
}

std::string escape_controls(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    Character c = decode_utf8(text, i);
    if (!c.valid || (is_control(c.code) && c.code != '\n'))
      out += escape_character(c.code);
    else
      out += text.substr(i, c.length);
    i += c.length;
  }
  return out;
}

std::string_view word_at(std::string_view text, std::size_t at) {
  if (at >= text.size() || !is_word_start(text[at])) return {};
  std::size_t end = at;
  while (end < text.size() && is_word_char(text[end])) ++end;
  return text.substr(at, end - at);
}

std::size_t end_of_string(std::string_view text, std::size_t at) {
  std::vector<char> open;  // quotes and braces
  for (; at < text.size() && text[at] != '\n'; ++at) {
    char c = text[at];
    bool in_string = !open.empty() && open.back() == '"';
    if (c == '\\' && in_string) {
      if (at + 1 < text.size() && text[at + 1] != '\n') ++at;
    } else if (c == '"' && in_string) {
      open.pop_back();
    } else if (c == '"' || c == '{') {
      open.push_back(c);
    } else if (c == '}' && !in_string) {
      open.pop_back();
    }
    if (open.empty()) return at + 1;
  }
  return at;
}

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> before_last, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last = last;
    last = row;
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      int replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string closest_word(std::string_view word, const std::vector<std::string_view>& candidates) {
  constexpr std::size_t kLongestWord =
      64;  // a longer word is no misspelling, and the table above is quadratic
  if (word.size() > kLongestWord) return {};
  std::string_view best;
  int best_distance = std::max<int>(1, static_cast<int>(word.size()) / 3) + 1;
  for (std::string_view candidate : candidates) {
    if (candidate.size() > kLongestWord || candidate == word) continue;
    int distance = edit_distance(word, candidate);
    // A short word that shares nothing with the candidate was not a slip of it.
    if (distance < best_distance && distance < static_cast<int>(candidate.size())) {
      best = candidate;
      best_distance = distance;
    }
  }
  return std::string(best);
}

}  // namespace garment::grammar
