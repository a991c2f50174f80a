#include "interpreter/service/symbols.hpp"

#include <algorithm>

#include "grammar/text.hpp"
#include "interpreter/service/tokens.hpp"

namespace garment::service {
namespace {

using grammar::Expr;
using grammar::ExprKind;
using grammar::Span;
using grammar::Statement;

constexpr std::size_t kShownDetail = 80;

bool is_control(const std::string& keyword) {
  return keyword == "if" || keyword == "for" || keyword == "both";
}

/// What stands after the name and before the block, on one line.
std::string head_of(const Statement& statement, Span name, const grammar::Sources& sources) {
  Span head{statement.span.source, name.end, statement.span.end};
  if (statement.body && statement.body_span.begin > head.begin) head.end = statement.body_span.begin;
  std::string text(sources.text(head));
  if (const std::size_t line = text.find_first_of("\n#"); line != std::string::npos) text.resize(line);
  const std::size_t begin = text.find_first_not_of(" \t\r:"), end = text.find_last_not_of(" \t\r");
  text = begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
  if (text.size() <= kShownDetail) return text;
  std::size_t cut = kShownDetail;
  while (cut > 0 && grammar::is_utf8_tail(text[cut])) --cut;
  return text.substr(0, cut) + "...";
}

void collect(const grammar::Block& block, const grammar::Sources& sources, std::vector<Symbol>& out) {
  for (const Statement& statement : block) {
    if (is_control(statement.keyword.text)) {
      if (statement.body) collect(*statement.body, sources, out);
      if (statement.else_body) collect(*statement.else_body, sources, out);
      continue;
    }
    const Span* name = declared_span(statement);
    if (name == nullptr && !statement.body) continue;
    Symbol symbol;
    symbol.keyword = statement.keyword.text;
    symbol.name = name != nullptr ? std::string(sources.text(*name)) : symbol.keyword;
    symbol.name_span = name != nullptr ? *name : statement.keyword.span;
    symbol.span = cover(statement.span, symbol.name_span);
    symbol.doc = statement.doc;
    symbol.detail = head_of(statement, symbol.name_span, sources);
    if (statement.body) collect(*statement.body, sources, symbol.children);
    out.push_back(std::move(symbol));
  }
}

const Span* span_of_name(const Expr& expr) { return expr.kind == ExprKind::name ? &expr.span : nullptr; }

}  // namespace

const Span* declared_span(const Statement& statement) {
  if (statement.name) return &statement.name->span;
  const std::vector<Expr>& operands = statement.operands;
  const std::string& keyword = statement.keyword.text;
  if (operands.empty()) return nullptr;
  if (keyword == "fn" || keyword == "component")
    return span_of_name(operands[0].kind == ExprKind::call ? operands[0].children[0] : operands[0]);
  return nullptr;
}

std::vector<Symbol> symbols_of(const grammar::Block& block, const grammar::Sources& sources) {
  std::vector<Symbol> symbols;
  collect(block, sources, symbols);
  return symbols;
}

std::vector<Fold> folds_of(const grammar::Script& script, const grammar::Sources& sources) {
  const std::string_view text = sources[script.source].text;
  std::vector<Fold> folds;
  std::vector<std::uint32_t> open;
  std::uint32_t comment_begin = 0, comment_end = 0;  // a run of lines that hold comments alone
  auto add = [&](std::uint32_t begin, std::uint32_t end, bool comment) {
    if (text.substr(begin, end - begin).find('\n') != std::string_view::npos)
      folds.push_back({{script.source, begin, end}, comment});
  };
  auto end_comment = [&] {
    if (comment_end > comment_begin) add(comment_begin, comment_end, true);
    comment_begin = comment_end = 0;
  };
  for (const Token& token : tokenize(text)) {
    const std::string_view sign = text_of(text, token);
    if (token.kind == TokenKind::comment && token.first_on_line) {
      const std::string_view gap = text.substr(comment_end, token.begin - comment_end);
      const bool follows = comment_end > 0 && std::count(gap.begin(), gap.end(), '\n') == 1;
      if (!follows) end_comment();
      if (!follows) comment_begin = token.begin;
      comment_end = token.end;
      continue;
    }
    end_comment();
    if (token.kind != TokenKind::sign) continue;
    if (sign == "{" || sign == "(" || sign == "[") open.push_back(token.begin);
    if ((sign == "}" || sign == ")" || sign == "]") && !open.empty()) {
      add(open.back(), token.end, false);
      open.pop_back();
    }
  }
  end_comment();
  std::sort(folds.begin(), folds.end(),
            [](const Fold& a, const Fold& b) { return a.span.begin < b.span.begin; });
  return folds;
}

}  // namespace garment::service
