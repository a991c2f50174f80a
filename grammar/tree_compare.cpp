#include <algorithm>

#include "grammar/syntax_tree.hpp"

namespace garment::grammar {
namespace {

template <class T, class Same>
bool all_same(const std::vector<T>& a, const std::vector<T>& b, Same same) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

bool same_values(const std::vector<Expr>& a, const std::vector<Expr>& b) {
  return all_same(a, b, [](const Expr& x, const Expr& y) { return same_tree(x, y); });
}

bool same_name(const Name& a, const Name& b) { return a.text == b.text && same_values(a.parts, b.parts); }

bool same_clause(const Clause& a, const Clause& b) {
  return same_name(a.word, b.word) && same_values(a.values, b.values);
}

bool same_body(const std::optional<Block>& a, const std::optional<Block>& b) {
  return a.has_value() == b.has_value() && (!a || same_tree(*a, *b));
}

bool same_statement(const Statement& a, const Statement& b) {
  bool same_names = a.name.has_value() == b.name.has_value() && (!a.name || same_name(*a.name, *b.name));
  return same_names && same_name(a.keyword, b.keyword) && same_values(a.operands, b.operands) &&
         all_same(a.clauses, b.clauses, same_clause) && same_body(a.body, b.body) &&
         same_body(a.else_body, b.else_body) && a.doc == b.doc && a.broken == b.broken;
}

}  // namespace

bool same_tree(const Expr& a, const Expr& b) {
  bool same_node = a.kind == b.kind && a.text == b.text && a.number == b.number && a.unit == b.unit;
  return same_node && all_same(a.labels, b.labels, same_name) && same_values(a.children, b.children);
}

bool same_tree(const Block& a, const Block& b) { return all_same(a, b, same_statement); }

}  // namespace garment::grammar
