#pragma once
// Characters and words: UTF-8, what a word is made of, how wide a character is on a terminal, which word was
// meant.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace garment::grammar {

constexpr int kTabStop = 4;  // columns

inline bool is_utf8_tail(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }
inline bool is_word_start(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
inline bool is_word_char(char c) { return is_word_start(c) || is_digit(c); }
/// Blanks within a line; a carriage return counts, so that files with CRLF read as files with LF.
inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// One decoded character: its code point and its length in bytes. Bytes that are not UTF-8 give `valid`
/// false, length 1.
struct Character {
  std::uint32_t code = 0;
  std::uint32_t length = 1;
  bool valid = true;
};

/// The character that begins at `text[at]` (`at` < text.size()). Overlong forms and surrogates are not valid.
Character decode_utf8(std::string_view text, std::size_t at);

/// Offset of the first byte that is not UTF-8, or npos.
std::size_t find_invalid_utf8(std::string_view text);

/// Columns of a terminal that a printable character takes: 0 (combining), 1, or 2 (East Asian wide, emoji).
int display_width(std::uint32_t code);

/// True for control characters and for the invisible ones that reorder a line of text (bidirectional marks).
bool is_control(std::uint32_t code);

/// The character as an escape of printable ASCII: "\t", "\x1b", "\u{202e}".
std::string escape_character(std::uint32_t code);

/// `text` with control characters escaped, for messages. Line breaks are kept.
std::string escape_controls(std::string_view text);

/// The word (letters, digits, _) that begins at `at`; empty if none does.
std::string_view word_at(std::string_view text, std::size_t at);

/// Offset after the string that begins with the quote at `at`: after its closing quote, or at the line end if
/// it has none. Strings inside `{expr}` parts are skipped.
std::size_t end_of_string(std::string_view text, std::size_t at);

/// Number of inserted, removed, replaced or swapped characters between two words (optimal string alignment).
int edit_distance(std::string_view a, std::string_view b);

/// The candidate that a misspelt word most likely meant, or "" if none is near (one edit in three
/// characters). Equal distance: the first in the list.
std::string closest_word(std::string_view word, const std::vector<std::string_view>& candidates);

}  // namespace garment::grammar
