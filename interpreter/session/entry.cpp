#include "interpreter/session/entry.hpp"

#include <algorithm>

#include "grammar/text.hpp"
#include "interpreter/language/construct_table.hpp"

namespace garment::session {
namespace {

bool has_error(const grammar::Diagnostics& diagnostics) {
  return std::any_of(diagnostics.begin(), diagnostics.end(),
                     [](const grammar::Diagnostic& d) { return d.severity == Severity::error; });
}

/// Does it read as a statement: a keyword, two words in a row, or an assignment?
bool looks_like_statement(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size() && (grammar::is_blank(text[at]) || text[at] == '\n')) ++at;
  const std::string_view word = grammar::word_at(text, at);
  if (word.empty()) return false;
  if (interpreter::find_construct(word) != nullptr || word == "both" || word == "for") return true;
  at += word.size();
  while (at < text.size() && text[at] == '.') at += 1 + grammar::word_at(text, at + 1).size();
  while (at < text.size() && grammar::is_blank(text[at])) ++at;
  if (at >= text.size()) return false;
  if (text[at] == '=') return at + 1 >= text.size() || text[at + 1] != '=';
  const std::string_view next = grammar::word_at(text, at);
  static const std::string_view operators[] = {"and", "or", "not", "minus", "is", "with"};
  return !next.empty() && std::find(std::begin(operators), std::end(operators), next) == std::end(operators);
}

}  // namespace

Entry read_entry(const std::string& text) {
  Entry entry;
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return entry;
  entry.text = text;
  if (text[first] == ':') {
    entry.kind = EntryKind::command;
    entry.text = text.substr(first + 1);
    return entry;
  }
  const grammar::SourceId id = entry.sources.add("<prompt>", text);
  grammar::ParseResult parsed = grammar::parse(entry.sources, id, interpreter::vocabulary());
  if (!has_error(parsed.diagnostics)) {
    entry.kind = parsed.script.statements.empty() ? EntryKind::nothing : EntryKind::statements;
    entry.script = std::move(parsed.script);
    return entry;
  }
  grammar::ExpressionResult asked = grammar::parse_expression(entry.sources, id, interpreter::vocabulary());
  const bool statement = looks_like_statement(text);
  if (!has_error(asked.diagnostics) &&
      !(statement && interpreter::find_construct(asked.expr.text) != nullptr)) {
    entry.kind = EntryKind::expression;
    entry.expr = std::move(asked.expr);
    return entry;
  }
  entry.kind = EntryKind::broken;
  entry.incomplete = statement ? parsed.incomplete : asked.incomplete;
  entry.diagnostics = statement ? std::move(parsed.diagnostics) : std::move(asked.diagnostics);
  return entry;
}

std::string with_commas(std::size_t n) {
  std::string digits = std::to_string(n);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, ",");
  return digits;
}

}  // namespace garment::session
