#pragma once
// What stands around a place of a text that need not parse: its blocks, its statement, its clause, its
// brackets.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/service/tokens.hpp"

namespace garment::service {

/// A bracket of the statement that is open at the place.
struct OpenBracket {
  char sign = '(';        ///< ( [ or { of a record
  std::string callee;     ///< what stands before it without a blank: "bodies.woman"; of a record what stands
                          ///< before `with`
  int commas = 0;         ///< in it, before the place
  std::string label;      ///< of the argument at hand: "size"; or the key of the record's entry
  bool in_value = false;  ///< something of the present argument or entry stands before the place
  std::vector<std::string> labels;  ///< all labels and keys before the place
  std::uint32_t begin = 0;
};

/// A block that is open around the place: `panel front ... {`.
struct OpenBlock {
  std::string
      keyword;  ///< the construct whose statements stand in it; those of `if` and `for` take the one around
  std::string name;  ///< what the innermost construct declares, "" where it declares nothing
};

struct Context {
  bool silent = false;                         ///< in a comment or a string
  std::uint32_t word_begin = 0, word_end = 0;  ///< the word at the place; empty where none stands
  std::string prefix;                          ///< of it, what stands before the place
  std::vector<OpenBlock> blocks;               ///< outermost first
  std::vector<std::string> loop_variables;     ///< of the `for` blocks around

  bool begins_statement = false;     ///< a statement may begin here
  bool in_statement = false;         ///< the statement below goes on here
  bool both = false;                 ///< it stands after `both`
  std::string keyword;               ///< of the statement at hand; "" in an assignment
  std::string target;                ///< of an assignment: "front.waist_dart.depth"
  bool names_itself = false;         ///< the name that the statement declares stands here
  std::string clause;                ///< the last clause word before the place, "" before the first
  std::vector<std::string> clauses;  ///< all clause words before the place
  int values = 0;                    ///< values that stand after `clause` (or the keyword) and are complete
  bool after_operator = false;       ///< a value must follow
  bool after_number = false;         ///< a unit may follow
  bool touches_number = false;       ///< without a blank: only a unit may follow
  std::string base;               ///< what stands before the dot that the word follows; "" if it follows none
  std::vector<OpenBracket> open;  ///< outermost first
};

Context context_at(std::string_view text, std::uint32_t offset);

}  // namespace garment::service
