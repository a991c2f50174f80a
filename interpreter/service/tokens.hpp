#pragma once
// A text cut into words, numbers, units, strings, comments and signs. Never fails: what is being typed seldom
// parses.
#include <cstdint>
#include <string_view>
#include <vector>

namespace garment::service {

enum class TokenKind : std::uint8_t { word, number, unit, string, comment, sign };

struct Token {
  TokenKind kind = TokenKind::sign;
  std::uint32_t begin = 0, end = 0;  ///< bytes
  int indent = 0;                    ///< of its line; a tab counts to the next multiple of four
  bool first_on_line = false;
};

std::vector<Token> tokenize(std::string_view text);

inline std::string_view text_of(std::string_view text, const Token& token) {
  return text.substr(token.begin, token.end - token.begin);
}

}  // namespace garment::service
