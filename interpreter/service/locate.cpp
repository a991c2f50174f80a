#include "interpreter/service/locate.hpp"

namespace garment::service {
namespace {

using grammar::Expr;
using grammar::Span;
using grammar::Statement;

void locate_expr(const Expr& expr, std::uint32_t offset, Located& found) {
  if (!holds(expr.span, offset)) return;
  found.exprs.push_back(&expr);
  for (const Expr& child : expr.children) {
    if (!holds(child.span, offset)) continue;
    // `front.side`: at the dot's far side the whole member is meant, at its near side what stands before it.
    if (child.span.end == offset && expr.kind == grammar::ExprKind::member && expr.name_span.begin <= offset)
      continue;
    return locate_expr(child, offset, found);
  }
}

bool locate_block(const grammar::Block& block, std::uint32_t offset, Located& found);

bool locate_statement(const Statement& statement, std::uint32_t offset, Located& found) {
  if (!holds(statement.span, offset)) return false;
  found.statements.push_back(&statement);
  if (statement.body && locate_block(*statement.body, offset, found)) return true;
  if (statement.else_body && locate_block(*statement.else_body, offset, found)) return true;
  for (const Expr& operand : statement.operands)
    if (found.exprs.empty()) locate_expr(operand, offset, found);
  for (const grammar::Clause& clause : statement.clauses) {
    if (!holds(clause.span, offset)) continue;
    found.clause = &clause;
    found.exprs.clear();
    for (const Expr& value : clause.values)
      if (found.exprs.empty()) locate_expr(value, offset, found);
  }
  return true;
}

bool locate_block(const grammar::Block& block, std::uint32_t offset, Located& found) {
  for (const Statement& statement : block)
    if (locate_statement(statement, offset, found)) return true;
  return false;
}

}  // namespace

Located locate(const grammar::Script& script, std::uint32_t offset) {
  Located found;
  locate_block(script.statements, offset, found);
  return found;
}

interpreter::Scope* scope_at(const interpreter::Module& module, const Located& located) {
  for (std::size_t k = located.statements.size(); k-- > 0;)
    for (const interpreter::Item& item : module.items)
      if (item.statement == located.statements[k]) return item.scope;
  return module.scope;
}

}  // namespace garment::service
