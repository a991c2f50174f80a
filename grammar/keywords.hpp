#pragma once
// The vocabulary made ready for look-up while parsing. Holds views into the Vocabulary, which must outlive
// it.
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "grammar/syntax_tree.hpp"

namespace garment::grammar {

using WordSet = std::unordered_set<std::string_view>;  // for membership only: never walked

struct Keyword {
  const KeywordInfo* info = nullptr;
  WordSet clauses;
  WordSet body;
};

class Keywords {
 public:
  explicit Keywords(const Vocabulary& vocabulary);

  struct Match {
    const Keyword* keyword = nullptr;
    std::size_t length = 0;
  };
  /// The keyword that begins at `text[at]`, of one word or of two with blanks between (`pair panel`). A word
  /// that touches a `.` or `{` is no keyword.
  Match match(std::string_view text, std::size_t at) const;

  const WordSet& top() const { return top_; }

  /// Length of the unit at `text[at]`, the longest of the table that is not the front of a longer word; 0 if
  /// none.
  std::size_t unit_length(std::string_view text, std::size_t at) const;

  /// The keyword meant by a misspelt one among the words of `allowed` and the parser's own; "" if none is
  /// near.
  std::string suggest_keyword(std::string_view word, const WordSet& allowed) const;
  /// The unit meant by a misspelt one; "" if none is near.
  std::string suggest_unit(std::string_view word) const;
  /// Where a keyword may stand: "the top level", "`outline`", in the order of the vocabulary.
  std::vector<std::string> places_of(std::string_view keyword) const;

 private:
  const Vocabulary& vocabulary_;
  std::unordered_map<std::string_view, Keyword> keywords_;
  WordSet first_words_;  // of keywords of two words
  WordSet top_;
  WordSet units_;
  std::size_t longest_sign_ = 0;  // of a unit that is no word, such as %
};

}  // namespace garment::grammar
