// The statements under construction: begun at their keyword, filled by the rules, handed to the block around
// them.
#include <fmt/format.h>

#include "grammar/parse_state.hpp"
#include "grammar/text.hpp"

namespace garment::grammar {
namespace {

constexpr std::size_t kMaxErrors = 100;

}  // namespace

std::string ParseState::doc_above(std::size_t at) const {
  if (!first_on_line(at)) return {};
  std::vector<std::string_view> lines;
  for (std::size_t line = line_of(at); line > 0; --line) {
    std::size_t begin = line_begin_[line - 1], end = line_begin_[line] - 1;
    while (begin < end && is_blank(text_[begin])) ++begin;
    std::string_view content = text_.substr(begin, end - begin);
    bool is_doc = content.substr(0, 2) == "##" && content.substr(0, 3) != "###";
    if (!is_doc) break;
    content.remove_prefix(2);
    if (!content.empty() && content.front() == ' ') content.remove_prefix(1);
    while (!content.empty() && is_blank(content.back())) content.remove_suffix(1);
    lines.push_back(content);
  }
  std::string doc;
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    if (line != lines.rbegin()) doc += '\n';
    doc += *line;
  }
  return doc;
}

void ParseState::begin_statement(Span keyword, std::string_view text, const Keyword* info) {
  if (statements_.size() >= static_cast<std::size_t>(max_depth_)) {
    Diagnostic d{"G0210",
                 Severity::error,
                 fmt::format("nested more than {} deep", max_depth_),
                 {{keyword, "one level too many"}},
                 "state the inner part by itself"};
    throw SyntaxError{d, keyword.begin, false, true};
  }
  find_footing(keyword.begin);
  Open open;
  open.statement.keyword = {info ? info->info->keyword : std::string(text), keyword};
  open.statement.span = keyword;
  open.statement.doc = doc_above(keyword.begin);
  open.keyword = info;
  open.allowed = info ? &info->body : &allowed_words();
  open.indent = indent_of(keyword.begin);
  left_open_ = false;
  statements_.push_back(std::move(open));
}

void ParseState::begin_assignment(Span sign) {
  Expr target = expressions_.take();
  begin_statement(sign, "=", nullptr);
  Open& open = statements_.back();
  open.statement.span.begin = target.span.begin;
  open.statement.doc = doc_above(target.span.begin);
  open.indent = indent_of(target.span.begin);
  open.statement.operands.push_back(std::move(target));
}

void ParseState::add_value() {
  Statement& statement = statements_.back().statement;
  Expr value = expressions_.take();
  if (statement.clauses.empty()) {
    statement.operands.push_back(std::move(value));
    return;
  }
  Clause& clause = statement.clauses.back();
  clause.span.end = value.span.end;
  clause.values.push_back(std::move(value));
}

void ParseState::begin_clause(Span word) {
  Clause clause;
  clause.word = {std::string(text_.substr(word.begin, word.end - word.begin)), word};
  clause.span = word;
  statements_.back().statement.clauses.push_back(std::move(clause));
}

void ParseState::open_block(Span brace) {
  expressions_.open('b', brace, Mode::items);
  Open& open = statements_.back();
  open.brace = brace;
  open.in_block = true;
  if (brace.begin < brace.end) return;
  SyntaxError error;
  error.diagnostic = {"G0212",
                      Severity::error,
                      fmt::format("the block of `{}` has no `{{`", open.statement.keyword.text),
                      {{open.statement.keyword.span, "this has a block"}},
                      "add `{` at the end of this line"};
  report(std::move(error));
}

bool ParseState::closes_less_indented(const Open& open, Span brace) const {
  return first_on_line(brace.begin) && indent_of(brace.begin) < open.indent;
}

void ParseState::close_block(Span brace) {
  expressions_.close();
  Open& open = statements_.back();
  bool is_missing = brace.begin == brace.end;
  left_open_ = is_missing;
  if (is_missing)
    report_open_block(open, brace.begin);
  else if (suspect_keyword_.empty() && closes_less_indented(open, brace)) {
    suspect_ = open.brace;
    suspect_keyword_ = open.statement.keyword.text;
  }
  open.in_block = false;
  bool is_else = open.statement.body.has_value();
  (is_else ? open.statement.else_body : open.statement.body) = std::move(open.children);
  open.children.clear();
  (is_else ? open.statement.else_span : open.statement.body_span) = cover(open.brace, brace);
}

void ParseState::report_open_block(const Open& open, std::size_t at) {
  bool at_end = at >= text_.size();
  if (stopped_ || (at_end && end_reported_)) return;
  bool has_suspect = !suspect_keyword_.empty();
  std::string keyword = has_suspect ? suspect_keyword_ : open.statement.keyword.text;
  SyntaxError error;
  error.diagnostic = {"G0204",
                      Severity::error,
                      fmt::format("the block of `{}` is not closed", keyword),
                      {{has_suspect ? suspect_ : open.brace, "opened here"}},
                      "add the missing `}`"};
  if (!at_end) error.diagnostic.labels.push_back({found_span(at), "belongs outside"});
  error.incomplete = at_end;
  suspect_keyword_.clear();
  end_reported_ = end_reported_ || at_end;
  report(std::move(error));
  if (!at_end) lose_nesting(line_of(at) - 1);  // the statement there may already be whole
}

void ParseState::end_else() {
  Open& open = statements_.back();
  if (!open.children.empty())
    open.statement.else_body = std::move(open.children);  // else if: the nested statement
  open.children.clear();
}

void ParseState::end_both() {
  Open& open = statements_.back();
  std::uint32_t end = open.children.empty() ? open.statement.span.end : open.children.back().span.end;
  open.statement.body = std::move(open.children);
  open.children.clear();
  end_statement(end);
}

void ParseState::end_statement(std::uint32_t end) {
  Open open = std::move(statements_.back());
  statements_.pop_back();
  Statement& statement = open.statement;
  while (end > statement.span.begin && (is_blank(text_[end - 1]) || text_[end - 1] == '\n')) --end;
  statement.span.end = end;
  bool names_itself = open.keyword && open.keyword->info->declares_name && !statement.name;
  if (names_itself && !statement.operands.empty() && statement.operands[0].kind == ExprKind::call) {
    const Expr& callee = statement.operands[0].children[0];  // fn half(x) = ...
    if (callee.kind == ExprKind::name) statement.name = Name{callee.text, callee.span, callee.children};
  }
  sink().push_back(std::move(statement));
  if (statements_.empty() && !lost_) fresh_ = false;
}

void ParseState::break_statement(SyntaxError error, std::size_t begin, std::size_t end, std::size_t depth) {
  Statement statement;
  bool block_expected = false;
  if (statements_.size() > depth) {
    const Keyword* keyword = statements_[depth].keyword;
    block_expected = keyword && keyword->info->has_body && !statements_[depth].statement.body;
    statement = std::move(statements_[depth].statement);
  }
  while (statements_.size() > depth) statements_.pop_back();
  while (end > begin && (is_blank(text_[end - 1]) || text_[end - 1] == '\n')) --end;
  statement.span = span(begin, end);
  statement.broken = true;
  sink().push_back(std::move(statement));
  const SyntaxError judged = error;
  report(std::move(error));
  judge_nesting(judged, begin, end, block_expected);
  broken_end_ = end;
}

void ParseState::report(SyntaxError error) {
  if (stopped_) return;
  (error.incomplete ? incomplete_ : final_) = true;
  if (follows_from_earlier(error)) return;
  fresh_ = true;
  Span place = error.diagnostic.labels.empty() ? Span{source_, 0, 0} : error.diagnostic.labels[0].span;
  diagnostics_.push_back(std::move(error.diagnostic));
  stopped_ = error.fatal || diagnostics_.size() >= kMaxErrors;
  if (!stopped_ || error.fatal) return;
  diagnostics_.push_back({"G0218",
                          Severity::error,
                          fmt::format("too many errors: reading stopped after {}", kMaxErrors),
                          {{place, "the last one"}},
                          "correct the first errors and try again"});
}

void ParseState::report_stray_brace(Span brace) {
  SyntaxError error;
  error.diagnostic = {"G0205",
                      Severity::error,
                      "`}` closes nothing: no block is open here",
                      {{brace, "one too many"}},
                      "remove it, or look for a missing `{` above"};
  report(std::move(error));
  broken_end_ = brace.end;
}

}  // namespace garment::grammar
