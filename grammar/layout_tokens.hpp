#pragma once
// A correct source cut into tokens for laying it out anew: only what spacing depends on.
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "grammar/syntax_tree.hpp"

namespace garment::grammar {

enum class TokenKind : std::uint8_t { word, number, unit, string, sign, comment };

struct LayoutToken {
  TokenKind kind;
  std::string_view text;
  std::uint32_t begin = 0;
  int lines_before = 0;       ///< line ends between the token before and this one
  bool blank_before = false;  ///< a blank or a line end
  bool blank_after = false;
  bool begins_statement = false;
  bool opens_block = false;   ///< the { of a block that is laid out over several lines
  bool closes_block = false;  ///< its }
};

/// What the tree knows about offsets of the source.
struct LayoutRoles {
  std::unordered_map<std::uint32_t, std::uint32_t> units;  ///< begin to end
  std::unordered_set<std::uint32_t> statements;
  std::unordered_set<std::uint32_t> openers, closers;  ///< braces of blocks that hold a line end
};

LayoutRoles layout_roles(const Script& script, std::string_view text);
std::vector<LayoutToken> layout_tokens(std::string_view text, const LayoutRoles& roles);

}  // namespace garment::grammar
