#include "interpreter/language/remedies.hpp"

#include <algorithm>
#include <string_view>

#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/function_table.hpp"

namespace garment::interpreter {
namespace {

using grammar::Block;
using grammar::Expr;
using grammar::Span;
using grammar::Statement;

/// Codes that say a statement or call is not put together as it must be: its form is the remedy.
bool is_about_form(std::string_view code) {
  constexpr std::string_view kForms[] = {"G0207", "G0208", "G0306", "G0307", "G0312", "G0313", "G0415", "G1101"};
  return std::find(std::begin(kForms), std::end(kForms), code) != std::end(kForms);
}

bool holds(Span outer, Span inner) {
  return outer.source == inner.source && outer.begin <= inner.begin && inner.end <= outer.end;
}

const Statement* innermost(const Block& block, Span place) {
  for (const Statement& statement : block) {
    if (!holds(statement.span, place)) continue;
    for (const auto* body : {&statement.body, &statement.else_body})
      if (*body)
        if (const Statement* inner = innermost(**body, place)) return inner;
    return &statement;
  }
  return nullptr;
}

/// The builtin of the innermost call that holds the place; null where there is none.
const FunctionRecord* innermost_call(const std::vector<Expr>& values, Span place) {
  for (const Expr& value : values) {
    if (!holds(value.span, place)) continue;
    if (const FunctionRecord* inner = innermost_call(value.children, place)) return inner;
    if (value.kind == grammar::ExprKind::call && !value.children.empty()) return find_function(value.children[0].text);
  }
  return nullptr;
}

std::string form_at(const Block& block, Span place) {
  const Statement* statement = innermost(block, place);
  if (statement == nullptr) return "";
  const FunctionRecord* function = innermost_call(statement->operands, place);
  for (const grammar::Clause& clause : statement->clauses)
    if (function == nullptr) function = innermost_call(clause.values, place);
  if (function != nullptr) return "it is written `" + std::string(function->form) + "`";
  const ConstructRecord* construct = find_construct(statement->keyword.text);
  return construct == nullptr || construct->form.empty() ? "" : "the form is `" + std::string(construct->form) + "`";
}

/// A word that begins a clause somewhere stands where it begins none: the form of its statement says what does.
bool is_clause_word(std::string_view word) {
  return std::any_of(construct_table().begin(), construct_table().end(),
                     [&](const ConstructRecord& construct) { return find_clause(construct, word) != nullptr; });
}

}  // namespace

void add_remedies(grammar::Diagnostics& diagnostics, const std::vector<const grammar::Script*>& scripts) {
  for (grammar::Diagnostic& d : diagnostics) {
    if (!d.help.empty() || d.severity == Severity::note) continue;
    const std::size_t tick = d.message.find('`');
    const bool misplaced = d.code == "G0301" && tick != std::string::npos && d.message.back() == '`' &&
                           is_clause_word(std::string_view(d.message).substr(tick + 1, d.message.size() - tick - 2));
    if ((is_about_form(d.code) || misplaced) && !d.labels.empty())
      for (const grammar::Script* script : scripts)
        if (d.help.empty() && script->source == d.labels[0].span.source)
          d.help = form_at(script->statements, d.labels[0].span);
    if (d.help.empty()) d.help = grammar::remedy_of(d.code);
  }
}

}  // namespace garment::interpreter
