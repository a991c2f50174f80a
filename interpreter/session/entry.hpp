#pragma once
// What was typed at the prompt, as far as its form goes.
#include <string>

#include "grammar/syntax_tree.hpp"

namespace garment::session {

enum class EntryKind {
  nothing,     ///< blank, or comments only
  command,     ///< `:undo`
  statements,  ///< `long = 70 cm`, `drape until rest`, `panel ... { ... }`
  expression,  ///< `front.waist`
  broken,      ///< neither; the diagnostics say why
};

struct Entry {
  EntryKind kind = EntryKind::nothing;
  bool incomplete = false;  ///< more lines would help
  std::string text;
  grammar::Sources sources;  ///< the entry, as `<prompt>`
  grammar::Script script;
  grammar::Expr expr;
  grammar::Diagnostics diagnostics;
};

Entry read_entry(const std::string& text);

/// Calls `take` for every expression of the tree below.
template <class Take>
void for_each_expr(const grammar::Expr& expr, const Take& take) {
  take(expr);
  for (const grammar::Expr& child : expr.children) for_each_expr(child, take);
}
template <class Take>
void for_each_expr(const grammar::Statement& statement, const Take& take) {
  for (const grammar::Expr& operand : statement.operands) for_each_expr(operand, take);
  for (const grammar::Clause& clause : statement.clauses)
    for (const grammar::Expr& value : clause.values) for_each_expr(value, take);
  for (const auto* block : {&statement.body, &statement.else_body})
    if (*block)
      for (const grammar::Statement& inner : **block) for_each_expr(inner, take);
}

/// 12345 as "12,345".
std::string with_commas(std::size_t n);

}  // namespace garment::session
