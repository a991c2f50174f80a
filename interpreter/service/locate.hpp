#pragma once
// Which statement, clause and expressions of a tree a place lies in.
#include <cstdint>
#include <vector>

#include "grammar/syntax_tree.hpp"
#include "interpreter/language/program.hpp"

namespace garment::service {

struct Located {
  std::vector<const grammar::Statement*> statements;  ///< outermost first
  const grammar::Clause* clause = nullptr;            ///< of the innermost statement
  std::vector<const grammar::Expr*> exprs;            ///< outermost first
};

/// True where the place touches the span.
inline bool holds(grammar::Span span, std::uint32_t offset) {
  return span.begin <= offset && offset <= span.end && span.end > span.begin;
}

Located locate(const grammar::Script& script, std::uint32_t offset);

/// A scope in which the innermost statement was evaluated (of several rounds the first); the script's if it
/// was not.
interpreter::Scope* scope_at(const interpreter::Module& module, const Located& located);

}  // namespace garment::service
