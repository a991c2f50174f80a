#include "grammar/layout_tokens.hpp"

#include <algorithm>

#include "grammar/text.hpp"

namespace garment::grammar {
namespace {

void note_units(const Expr& expr, LayoutRoles& roles) {
  if (expr.kind == ExprKind::number && !expr.unit.empty())
    roles.units[expr.unit_span.begin] = expr.unit_span.end;
  for (const Expr& child : expr.children) note_units(child, roles);
}

void note_block(const Block& block, std::string_view text, LayoutRoles& roles);

void note_braces(Span span, std::string_view text, LayoutRoles& roles) {
  if (span.begin == span.end) return;
  if (text.substr(span.begin, span.end - span.begin).find('\n') == std::string_view::npos) return;
  roles.openers.insert(span.begin);
  roles.closers.insert(span.end - 1);
}

void note_statement(const Statement& statement, std::string_view text, LayoutRoles& roles) {
  roles.statements.insert(statement.span.begin);
  for (const Expr& operand : statement.operands) note_units(operand, roles);
  for (const Clause& clause : statement.clauses)
    for (const Expr& value : clause.values) note_units(value, roles);
  note_braces(statement.body_span, text, roles);
  note_braces(statement.else_span, text, roles);
  if (statement.body) note_block(*statement.body, text, roles);
  if (statement.else_body) note_block(*statement.else_body, text, roles);
}

void note_block(const Block& block, std::string_view text, LayoutRoles& roles) {
  for (const Statement& statement : block) note_statement(statement, text, roles);
}

std::size_t end_of_number(std::string_view text, std::size_t at) {
  auto digit = [&](std::size_t i) { return i < text.size() && is_digit(text[i]); };
  while (digit(at)) ++at;
  if (at < text.size() && text[at] == '.' && digit(at + 1))
    for (++at; digit(at);) ++at;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t exponent = at + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    if (digit(exponent))
      for (at = exponent; digit(at);) ++at;
  }
  return at;
}

/// A name with its `{expr}` parts is one token: nothing in it may move.
std::size_t end_of_name(std::string_view text, std::size_t at) {
  const std::size_t begin = at;
  while (at < text.size()) {
    if (is_word_char(text[at])) {
      ++at;
      continue;
    }
    std::string_view word = text.substr(begin, at - begin);
    bool is_hole = word != "with" && word != "else" && text[at] == '{' && at + 1 < text.size() &&
                   !is_blank(text[at + 1]) &&
                   std::string_view("\n}#").find(text[at + 1]) == std::string_view::npos;
    if (!is_hole) break;
    int open = 0;
    do {
      if (text[at] == '"') {
        at = end_of_string(text, at);
        continue;
      }
      if (text[at] == '{') ++open;
      if (text[at] == '}') --open;
      ++at;
    } while (open > 0 && at < text.size());
  }
  return at;
}

std::size_t end_of_sign(std::string_view text, std::size_t at) {
  for (std::string_view two : {"..", "==", "!=", "<=", ">="})
    if (text.substr(at, 2) == two) return at + 2;
  return at + 1;
}

LayoutToken token_at(std::string_view text, std::size_t at, const LayoutRoles& roles) {
  std::uint32_t begin = static_cast<std::uint32_t>(at);
  std::size_t end;
  TokenKind kind;
  auto unit = roles.units.find(begin);
  if (unit != roles.units.end()) {
    kind = TokenKind::unit;
    end = unit->second;
  } else if (text[at] == '#') {
    kind = TokenKind::comment;
    end = std::min(text.find('\n', at), text.size());
    while (is_blank(text[end - 1])) --end;
  } else if (text[at] == '"') {
    kind = TokenKind::string;
    end = end_of_string(text, at);
  } else if (is_digit(text[at])) {
    kind = TokenKind::number;
    end = end_of_number(text, at);
  } else if (is_word_start(text[at])) {
    kind = TokenKind::word;
    end = end_of_name(text, at);
  } else {
    kind = TokenKind::sign;
    end = end_of_sign(text, at);
  }
  LayoutToken token{kind, text.substr(at, end - at), begin};
  token.begins_statement = roles.statements.count(begin) > 0;
  token.opens_block = roles.openers.count(begin) > 0;
  token.closes_block = roles.closers.count(begin) > 0;
  return token;
}

}  // namespace

LayoutRoles layout_roles(const Script& script, std::string_view text) {
  LayoutRoles roles;
  note_block(script.statements, text, roles);
  return roles;
}

std::vector<LayoutToken> layout_tokens(std::string_view text, const LayoutRoles& roles) {
  std::vector<LayoutToken> tokens;
  std::size_t at = text.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0;
  while (true) {
    std::size_t gap = at;
    int lines = 0;
    for (; at < text.size() && (is_blank(text[at]) || text[at] == '\n'); ++at)
      if (text[at] == '\n') ++lines;
    if (!tokens.empty()) tokens.back().blank_after = at > gap || at >= text.size();
    if (at >= text.size()) return tokens;
    LayoutToken token = token_at(text, at, roles);
    token.lines_before = lines;
    token.blank_before = at > gap;
    at += token.text.size();
    tokens.push_back(token);
  }
}

}  // namespace garment::grammar
