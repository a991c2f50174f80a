// The tree as indented text: expressions with all brackets that precedence implies, one clause a line.
#include <fmt/format.h>

#include "grammar/syntax_tree.hpp"
#include "runtime/base/number.hpp"

namespace garment::grammar {
namespace {

std::string show(const Expr& expr);

std::string show_list(const Expr& expr, std::size_t first, std::string_view separator,
                      std::string_view between) {
  std::string out;
  for (std::size_t i = first; i < expr.children.size(); ++i) {
    if (i > first) out += separator;
    std::size_t label = i - first;
    if (label < expr.labels.size() && !expr.labels[label].text.empty())
      out += expr.labels[label].text + std::string(between);
    out += show(expr.children[i]);
  }
  return out;
}

std::string escape(std::string_view text) {
  std::string out;
  for (char c : text) {
    if (c == '"' || c == '\\' || c == '{') out += '\\';
    if (c == '\n')
      out += "\\n";
    else
      out += c;
  }
  return out;
}

std::string show_string(const Expr& expr) {
  std::string out = "\"";
  for (const Expr& part : expr.children)
    out += part.kind == ExprKind::text ? escape(part.text) : "{" + show(part) + "}";
  return out + "\"";
}

std::string show_unary(const Expr& expr) {
  bool is_word = expr.text == "not" || expr.text == "minus";
  return fmt::format("({}{}{})", expr.text, is_word ? " " : "", show(expr.children[0]));
}

std::string show(const Expr& expr) {
  const std::vector<Expr>& c = expr.children;
  switch (expr.kind) {
    case ExprKind::number:
      return format_number(expr.number) + (expr.unit.empty() || expr.unit == "%" ? "" : " ") + expr.unit;
    case ExprKind::string:
      return show_string(expr);
    case ExprKind::text:
    case ExprKind::boolean:
    case ExprKind::name:
      return expr.text;
    case ExprKind::member:
      return show(c[0]) + "." + expr.text;
    case ExprKind::range_index:
      return fmt::format("{}[{} .. {}]", show(c[0]), show(c[1]), show(c[2]));
    case ExprKind::index:
      return fmt::format("{}[{}]", show(c[0]), show(c[1]));
    case ExprKind::call:
      return fmt::format("{}({})", show(c[0]), show_list(expr, 1, ", ", ": "));
    case ExprKind::unary:
      return show_unary(expr);
    case ExprKind::binary:
      return fmt::format("({} {} {})", show(c[0]), expr.text, show(c[1]));
    case ExprKind::range:
      return fmt::format("({} .. {})", show(c[0]), show(c[1]));
    case ExprKind::list:
      return "[" + show_list(expr, 0, ", ", "") + "]";
    case ExprKind::record:
      return "{" + show_list(expr, 0, ", ", " = ") + "}";
    case ExprKind::with:
      return fmt::format("({} with {})", show(c[0]), show(c[1]));
    case ExprKind::point:
      return "(" + show_list(expr, 0, ", ", "") + ")";
    case ExprKind::conditional:
      return fmt::format("(if {} {{{}}} else {{{}}})", show(c[0]), show(c[1]), show(c[2]));
    case ExprKind::none:
      return "_";
    case ExprKind::error:
      return "<error>";
  }
  return {};
}

std::string show_values(const std::vector<Expr>& values) {
  std::string out;
  for (const Expr& value : values) out += " " + show(value);
  return out;
}

void show_block(const Block& block, int indent, std::string& out);

void show_statement(const Statement& s, int indent, std::string& out) {
  std::string margin(static_cast<std::size_t>(indent), ' ');
  std::string_view doc = s.doc;
  while (!doc.empty()) {
    std::size_t end = std::min(doc.find('\n'), doc.size());
    out += fmt::format("{}## {}\n", margin, doc.substr(0, end));
    doc.remove_prefix(std::min(end + 1, doc.size()));
  }
  out += fmt::format("{}{}{}{}{}\n", margin, s.broken ? "! " : "", s.keyword.text,
                     s.name ? " " + s.name->text : "", show_values(s.operands));
  for (const Clause& clause : s.clauses)
    out += fmt::format("{}  | {}{}\n", margin, clause.word.text, show_values(clause.values));
  if (s.body) show_block(*s.body, indent + 2, out);
  if (!s.else_body) return;
  out += margin + "else\n";
  show_block(*s.else_body, indent + 2, out);
}

void show_block(const Block& block, int indent, std::string& out) {
  if (block.empty()) out += std::string(static_cast<std::size_t>(indent), ' ') + "{}\n";
  for (const Statement& statement : block) show_statement(statement, indent, out);
}

}  // namespace

std::string to_outline(const Script& script) {
  std::string out;
  for (const Statement& statement : script.statements) show_statement(statement, 0, out);
  return out;
}

}  // namespace garment::grammar
