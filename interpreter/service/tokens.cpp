#include "interpreter/service/tokens.hpp"

#include "grammar/text.hpp"
#include "interpreter/language/units.hpp"

namespace garment::service {
namespace {

using grammar::is_blank;
using grammar::is_digit;
using grammar::is_word_char;
using grammar::is_word_start;

char at(std::string_view text, std::size_t i) { return i < text.size() ? text[i] : '\0'; }

std::size_t end_of_number(std::string_view text, std::size_t i) {
  while (is_digit(at(text, i))) ++i;
  if (at(text, i) == '.' && is_digit(at(text, i + 1)))
    for (++i; is_digit(at(text, i));) ++i;
  if (at(text, i) == 'e' || at(text, i) == 'E') {
    const std::size_t sign = at(text, i + 1) == '+' || at(text, i + 1) == '-' ? 1 : 0;
    if (is_digit(at(text, i + 1 + sign)))
      for (i += 1 + sign; is_digit(at(text, i));) ++i;
  }
  return i;
}

/// End of one unit of the table with its power, `cm^2`; `i` where none stands.
std::size_t end_of_factor(std::string_view text, std::size_t i) {
  std::size_t end = i;
  if (at(text, i) == '%')
    end = i + 1;
  else if (const std::string_view word = grammar::word_at(text, i);
           !word.empty() && interpreter::find_unit(word))
    end = i + word.size();
  if (end == i || at(text, end) != '^') return end;
  std::size_t power = end + (at(text, end + 1) == '-' ? 2 : 1);
  if (!is_digit(at(text, power))) return end;
  while (is_digit(at(text, power))) ++power;
  return power;
}

/// End of the unit that begins at `i`, products and quotients included; `i` where none stands.
std::size_t end_of_unit(std::string_view text, std::size_t i) {
  std::size_t end = end_of_factor(text, i);
  if (end == i) return i;
  while (at(text, end) == '*' || at(text, end) == '/') {
    const std::size_t next = end_of_factor(text, end + 1);
    if (next == end + 1) break;
    end = next;
  }
  return end;
}

std::size_t end_of_word(std::string_view text, std::size_t i) {
  while (is_word_char(at(text, i))) ++i;
  return i;
}

std::size_t end_of_sign(std::string_view text, std::size_t i) {
  for (std::string_view two : {"..", "==", "!=", "<=", ">="})
    if (text.substr(i, 2) == two) return i + 2;
  std::size_t end = i + 1;
  while (end < text.size() && grammar::is_utf8_tail(text[end])) ++end;
  return end;
}

Token token_at(std::string_view text, std::size_t i, bool after_number) {
  Token token;
  token.begin = static_cast<std::uint32_t>(i);
  std::size_t end = after_number ? end_of_unit(text, i) : i;
  if (end > i) {
    token.kind = TokenKind::unit;
  } else if (text[i] == '#') {
    token.kind = TokenKind::comment;
    end = std::min(text.find('\n', i), text.size());
  } else if (text[i] == '"') {
    token.kind = TokenKind::string;
    end = grammar::end_of_string(text, i);
  } else if (is_digit(text[i])) {
    token.kind = TokenKind::number;
    end = end_of_number(text, i);
  } else if (is_word_start(text[i])) {
    token.kind = TokenKind::word;
    end = end_of_word(text, i);
  } else {
    end = end_of_sign(text, i);
  }
  token.end = static_cast<std::uint32_t>(end);
  return token;
}

}  // namespace

std::vector<Token> tokenize(std::string_view text) {
  std::vector<Token> tokens;
  std::size_t i = text.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0;
  int indent = 0;
  bool first = true;
  while (i < text.size()) {
    if (text[i] == '\n') {
      first = true;
      indent = 0;
      ++i;
    } else if (is_blank(text[i])) {
      if (first) indent = text[i] == '\t' ? (indent / 4 + 1) * 4 : indent + 1;
      ++i;
    } else {
      Token token = token_at(text, i, !first && !tokens.empty() && tokens.back().kind == TokenKind::number);
      token.indent = indent;
      token.first_on_line = first;
      first = false;
      i = token.end;
      tokens.push_back(token);
    }
  }
  return tokens;
}

}  // namespace garment::service
