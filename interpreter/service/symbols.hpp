#pragma once
// What a script declares, as a tree: the outline that an editor shows, and the names that completion
// proposes.
#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/syntax_tree.hpp"

namespace garment::service {

inline bool is_any(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// A declared thing. Those of a panel's or component's block are its children; `if`, `for` and `both` add no
/// level.
struct Symbol {
  std::string name;     ///< as written: "front", "gore_{i}"; "outline" and the like for blocks without a name
  std::string keyword;  ///< of its construct
  std::string detail;   ///< its head: "of shell on fold cf"; at most 80 bytes
  std::string doc;      ///< its doc comment
  grammar::Span span;   ///< the whole statement
  grammar::Span name_span;  ///< the declared name; the keyword where it has none
  std::vector<Symbol> children;
};

std::vector<Symbol> symbols_of(const grammar::Block& block, const grammar::Sources& sources);
inline std::vector<Symbol> symbols_of(const grammar::Script& script, const grammar::Sources& sources) {
  return symbols_of(script.statements, sources);
}

/// The name that a statement declares, the function's for `fn f(x)`, the edge's for `replace edge NAME`; null
/// if it declares none.
const grammar::Span* declared_span(const grammar::Statement& statement);

/// Where a text may be folded: blocks, brackets and runs of comments that hold a line end.
struct Fold {
  grammar::Span span;
  bool comment = false;
};
std::vector<Fold> folds_of(const grammar::Script& script, const grammar::Sources& sources);

}  // namespace garment::service
