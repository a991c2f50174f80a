#include "tests/property/mutations/mutate.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace garment::mutations {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

std::size_t end_of_number(const std::string& text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  if (at + 1 < text.size() && text[at] == '.' && is_digit(text[at + 1]))
    for (++at; at < text.size() && is_digit(text[at]);) ++at;
  if (at + 2 < text.size() && text[at] == 'e' && (is_digit(text[at + 1]) || text[at + 1] == '-'))
    for (at += 2; at < text.size() && is_digit(text[at]);) ++at;
  return at;
}

std::size_t end_of_sign(const std::string& text, std::size_t at) {
  for (std::string_view pair : {"..", "==", "!=", "<=", ">="})
    if (text.compare(at, 2, pair) == 0) return at + 2;
  return at + 1;
}

std::string text_of(const std::string& text, const Token& token) {
  return text.substr(token.begin, token.end - token.begin);
}

std::string misspelt(std::string word, Dice& dice) {
  const std::size_t at = dice.roll(word.size());
  switch (dice.roll(3)) {
    case 0:
      word.insert(at, 1, word[at]);
      break;
    case 1:
      if (word.size() > 1) word.erase(at, 1);
      break;
    default:
      if (at + 1 < word.size()) std::swap(word[at], word[at + 1]);
  }
  return word;
}

std::string other_number(const std::string& number, Dice& dice) {
  static constexpr std::array<std::string_view, 8> kNumbers = {"0", "1",    "-3",  "0.5",
                                                               "7", "1000", "1e9", "12.345"};
  if (dice.roll(3) == 0) return number + "0";
  return std::string(kNumbers[dice.roll(kNumbers.size())]);
}

bool is_bracket(const std::string& token) {
  return token.size() == 1 && std::string("()[]{}").find(token[0]) < 6;
}

/// A token that `accepts` likes, from a random place on; `tokens.size()` if there is none.
template <class F>
std::size_t pick(const std::vector<Token>& tokens, Dice& dice, const F& accepts) {
  const std::size_t begin = dice.roll(tokens.size());
  for (std::size_t k = 0; k < tokens.size(); ++k)
    if (accepts(tokens[(begin + k) % tokens.size()])) return (begin + k) % tokens.size();
  return tokens.size();
}

Mutant replaced(const std::string& text, const Token& token, const std::string& with,
                const std::string& what) {
  Mutant mutant{text, token.begin, what + " `" + text_of(text, token) + "` -> `" + with + "`"};
  mutant.text.replace(token.begin, token.end - token.begin, with);
  return mutant;
}

}  // namespace

std::vector<Token> tokens_of(const std::string& text) {
  std::vector<Token> tokens;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    std::size_t end = at + 1;
    TokenKind kind = TokenKind::sign;
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
      ++at;
      continue;
    }
    if (c == '"') {
      kind = TokenKind::string;
      while (end < text.size() && text[end] != '"' && text[end] != '\n') end += text[end] == '\\' ? 2 : 1;
      end = std::min(end + 1, text.size());
    } else if (is_digit(c)) {
      kind = TokenKind::number;
      end = end_of_number(text, at);
    } else if (is_letter(c)) {
      kind = TokenKind::word;
      while (end < text.size() && (is_letter(text[end]) || is_digit(text[end]))) ++end;
    } else {
      end = end_of_sign(text, at);
    }
    tokens.push_back({kind, at, end});
    at = end;
  }
  return tokens;
}

Mutant mutate(const std::string& text, const std::vector<Token>& tokens,
              const std::vector<std::string>& words, Dice& dice) {
  const std::size_t at = dice.roll(tokens.size());
  const Token& token = tokens[at];
  const std::string here = text_of(text, token);
  switch (dice.roll(9)) {
    case 0:
      return replaced(text, token, "", "delete");
    case 1:
      return replaced(text, token, here + ' ' + here, "double");
    case 2: {
      if (at + 1 == tokens.size()) return replaced(text, token, "", "delete");
      const Token& next = tokens[at + 1];
      const std::string between = text.substr(token.end, next.begin - token.end);
      Token both = token;
      both.end = next.end;
      return replaced(text, both, text_of(text, next) + between + here, "swap");
    }
    case 3:
      return replaced(text, token, text_of(text, tokens[dice.roll(tokens.size())]), "replace");
    case 4:
      return replaced(text, token, words[dice.roll(words.size())], "replace");
    case 5: {
      const std::size_t number =
          pick(tokens, dice, [](const Token& t) { return t.kind == TokenKind::number; });
      if (number == tokens.size()) break;
      return replaced(text, tokens[number], other_number(text_of(text, tokens[number]), dice), "number");
    }
    case 6: {
      const std::size_t unit = pick(tokens, dice, [&](const Token& t) {
        return (t.kind == TokenKind::word || text[t.begin] == '%') && t.begin > 1 &&
               (is_digit(text[t.begin - 1]) || (text[t.begin - 1] == ' ' && is_digit(text[t.begin - 2])));
      });
      static constexpr std::array<std::string_view, 7> kUnits = {"mm", "m", "deg", "kg", "%", "", "inch"};
      if (unit == tokens.size()) break;
      return replaced(text, tokens[unit], std::string(kUnits[dice.roll(kUnits.size())]), "unit");
    }
    case 7: {
      const std::size_t word = pick(tokens, dice, [](const Token& t) { return t.kind == TokenKind::word; });
      if (word == tokens.size()) break;
      return replaced(text, tokens[word], misspelt(text_of(text, tokens[word]), dice), "misspell");
    }
    default: {
      const std::size_t bracket =
          pick(tokens, dice, [&](const Token& t) { return is_bracket(text_of(text, t)); });
      if (bracket == tokens.size()) break;
      return replaced(text, tokens[bracket], "", "drop");
    }
  }
  return replaced(text, token, "", "delete");
}

}  // namespace garment::mutations
