#pragma once
// One-token mutations of a script, the same ones for the same seed.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace garment::mutations {

/// Random numbers with the same bits everywhere.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15ull + 1) {}
  /// 0 .. n - 1.
  std::size_t roll(std::size_t n) {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<std::size_t>(state_ >> 33) % n;
  }

 private:
  std::uint64_t state_;
};

enum class TokenKind { word, number, string, sign };

/// A token of the text, by its bytes. Comments and blanks are no tokens.
struct Token {
  TokenKind kind;
  std::size_t begin, end;
};
std::vector<Token> tokens_of(const std::string& text);

struct Mutant {
  std::string text;
  std::size_t at = 0;  ///< byte where it differs first
  std::string what;    ///< "delete `waist`"
};

/// A mutant of `text`: a token deleted, doubled, swapped with the next, replaced by another of the file or by
/// a word of the language, a number or unit changed, a word misspelt, a bracket dropped. `tokens` are those
/// of `text`; `words` the words of the language.
Mutant mutate(const std::string& text, const std::vector<Token>& tokens,
              const std::vector<std::string>& words, Dice& dice);

}  // namespace garment::mutations
