// The tree as JSON. Spans are byte offsets [begin, end) into the source named at the top.
#include <array>
#include <nlohmann/json.hpp>

#include "grammar/syntax_tree.hpp"

namespace garment::grammar {
namespace {

using nlohmann::ordered_json;

constexpr std::array<const char*, 19> kKindNames = {
    "number", "string", "text", "boolean", "name", "member", "range_index", "index", "call", "unary",
    "binary", "range",  "list", "record",  "with", "point",  "conditional", "none",  "error"};

ordered_json json_span(Span span) { return {span.begin, span.end}; }

ordered_json json_expr(const Expr& expr) {
  ordered_json out;
  out["kind"] = kKindNames[static_cast<std::size_t>(expr.kind)];
  out["span"] = json_span(expr.span);
  if (!expr.text.empty()) out["text"] = expr.text;
  if (expr.kind == ExprKind::number) {
    out["number"] = expr.number;
    if (!expr.unit.empty()) out["unit"] = expr.unit;
  }
  if (!expr.labels.empty()) {
    out["labels"] = ordered_json::array();
    for (const Name& label : expr.labels) out["labels"].push_back(label.text);
  }
  if (!expr.children.empty()) {
    out["children"] = ordered_json::array();
    for (const Expr& child : expr.children) out["children"].push_back(json_expr(child));
  }
  return out;
}

ordered_json json_name(const Name& name) {
  ordered_json out = {{"text", name.text}, {"span", json_span(name.span)}};
  if (name.parts.empty()) return out;
  out["parts"] = ordered_json::array();
  for (const Expr& part : name.parts) out["parts"].push_back(json_expr(part));
  return out;
}

ordered_json json_values(const std::vector<Expr>& values) {
  ordered_json out = ordered_json::array();
  for (const Expr& value : values) out.push_back(json_expr(value));
  return out;
}

ordered_json json_block(const Block& block);

ordered_json json_statement(const Statement& statement) {
  ordered_json out;
  out["keyword"] = statement.keyword.text;
  out["span"] = json_span(statement.span);
  if (statement.broken) out["broken"] = true;
  if (!statement.doc.empty()) out["doc"] = statement.doc;
  if (statement.name) out["name"] = json_name(*statement.name);
  if (!statement.operands.empty()) out["operands"] = json_values(statement.operands);
  if (!statement.clauses.empty()) {
    out["clauses"] = ordered_json::array();
    for (const Clause& clause : statement.clauses)
      out["clauses"].push_back({{"word", clause.word.text},
                                {"span", json_span(clause.span)},
                                {"values", json_values(clause.values)}});
  }
  if (statement.body) out["body"] = json_block(*statement.body);
  if (statement.else_body) out["else"] = json_block(*statement.else_body);
  return out;
}

ordered_json json_block(const Block& block) {
  ordered_json out = ordered_json::array();
  for (const Statement& statement : block) out.push_back(json_statement(statement));
  return out;
}

}  // namespace

std::string to_json(const Script& script, const Sources& sources) {
  ordered_json out;
  out["source"] = sources[script.source].name;
  out["statements"] = json_block(script.statements);
  return out.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace garment::grammar
