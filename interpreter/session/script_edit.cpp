#include "interpreter/session/script_edit.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "grammar/text.hpp"
#include "interpreter/language/construct_table.hpp"

namespace garment::session {
namespace {

using grammar::Block;
using grammar::Clause;
using grammar::Expr;
using grammar::ExprKind;
using grammar::Span;
using grammar::Statement;
using Words = std::vector<std::string>;

Bytes bytes_of(Span span) { return {span.begin, span.end}; }

bool one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::string_view slice(std::string_view text, Bytes place) {
  return text.substr(place.begin, place.end - place.begin);
}

std::string joined(const Words& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ".") + word;
  return text;
}

Words tail(const Words& words) { return {words.begin() + 1, words.end()}; }

/// The field of a record, or of the record after `with`.
std::optional<Bytes> field_place(const Expr& expr, const std::string& field) {
  if (expr.kind == ExprKind::with && expr.children.size() > 1) return field_place(expr.children[1], field);
  if (expr.kind != ExprKind::record) return std::nullopt;
  for (std::size_t k = 0; k < expr.labels.size() && k < expr.children.size(); ++k)
    if (expr.labels[k].text == field) return bytes_of(expr.children[k].span);
  return std::nullopt;
}

std::optional<Bytes> clause_place(const Statement& statement, const std::string& word) {
  for (const Clause& clause : statement.clauses) {
    if (clause.values.empty()) continue;
    if (clause.word.text == word)
      return Bytes{clause.values.front().span.begin, clause.values.back().span.end};
    if (clause.word.text != "=") continue;
    if (const auto field = field_place(clause.values[0], word)) return field;
  }
  return std::nullopt;
}

std::optional<Bytes> assigned_place(const Block& block, const Words& path) {
  for (const Statement& statement : block)
    if (statement.keyword.text == "=" && statement.operands.size() == 2 &&
        path_of(statement.operands[0]) == path)
      return bytes_of(statement.operands[1].span);
  return std::nullopt;
}

/// Where the value of `path` (seen from the statement) stands.
std::optional<Bytes> value_place(const Statement& statement, const Words& path) {
  if (statement.broken) return std::nullopt;
  if (path.empty()) {
    if (!one_of(statement.keyword.text, {"param", "let", "measure"})) return std::nullopt;
    for (const Clause& clause : statement.clauses)
      if (clause.word.text == "=" && !clause.values.empty()) return bytes_of(clause.values[0].span);
    return std::nullopt;
  }
  if (path.size() == 1)
    if (const auto place = clause_place(statement, path[0])) return place;
  if (!statement.body) return std::nullopt;
  if (const auto place = assigned_place(*statement.body, path)) return place;
  for (const Statement& inner : *statement.body) {
    // `resolution 2 cm`, `grain +y`: a statement that is nothing but its value.
    if (path.size() == 1 && inner.keyword.text == path[0] && !inner.name && !inner.operands.empty())
      return Bytes{inner.operands.front().span.begin, inner.operands.back().span.end};
    if (inner.keyword.text == "outline")
      if (const auto place = value_place(inner, path)) return place;
    if (path.size() > 1 && inner.name && inner.name->parts.empty() && inner.name->text == path[0])
      if (const auto place = value_place(inner, tail(path))) return place;
  }
  return std::nullopt;
}

std::optional<Bytes> find_value(const Block& script, const Words& path) {
  if (const auto place = assigned_place(script, path)) return place;
  for (const Statement& statement : script)
    if (declared_name(statement) == path[0]) return value_place(statement, tail(path));
  for (const Statement& statement : script)  // of the left and the right at once
    if (declared_name(statement) == "both " + path[0] && statement.body && statement.body->size() == 1)
      return value_place(statement.body->front(), tail(path));
  return std::nullopt;
}

/// From the first `##` or `#` line right above the statement to its end.
Bytes with_comments(std::string_view text, Bytes statement, bool docs_only) {
  std::uint32_t begin = statement.begin;
  while (begin > 0 && text[begin - 1] != '\n') --begin;
  if (text.substr(begin, statement.begin - begin).find_first_not_of(" \t") != std::string_view::npos)
    return statement;  // another statement stands before it on the line
  const std::uint32_t line = begin;
  while (begin > 0) {
    std::uint32_t above = begin - 1;
    while (above > 0 && text[above - 1] != '\n') --above;
    const std::string_view content = text.substr(above, begin - 1 - above);
    const std::size_t first = content.find_first_not_of(" \t");
    if (first == std::string_view::npos || content[first] != '#') break;
    if (docs_only && content.substr(first, 2) != "##") break;
    begin = above;
  }
  return {begin == line ? statement.begin : begin, statement.end};
}

/// Same name, or same keyword and operands for statements that hold once.
const Statement* find_same(const Block& script, const Statement& typed, std::string_view text,
                           std::string_view entry) {
  const std::string name = declared_name(typed);
  for (const Statement& statement : script) {
    if (!name.empty()) {
      if (declared_name(statement) == name) return &statement;
      continue;
    }
    if (statement.keyword.text != typed.keyword.text) continue;
    if (one_of(typed.keyword.text, {"garment", "gravity", "wind", "drag", "solver"})) return &statement;
    if (!one_of(typed.keyword.text, {"place", "attach"}) ||
        statement.operands.size() != typed.operands.size())
      continue;
    bool same = true;
    for (std::size_t k = 0; k < typed.operands.size(); ++k)
      same = same && slice(text, bytes_of(statement.operands[k].span)) ==
                         slice(entry, bytes_of(typed.operands[k].span));
    if (same) return &statement;
  }
  return nullptr;
}

std::uint32_t line_end(std::string_view text, std::uint32_t at) {
  while (at < text.size() && text[at] != '\n') ++at;
  return at;
}

void add(Patch& patch, const Block& script, const TypedStatement& typed, bool last) {
  const std::string& text = patch.text();
  const Statement* before = nullptr;
  for (const Statement& statement : script)
    if (last || !is_act(statement)) before = &statement;
  if (before == nullptr) {
    const std::uint32_t at = script.empty() ? static_cast<std::uint32_t>(text.size()) : script[0].span.begin;
    const bool open = at > 0 && text[at - 1] != '\n';
    patch.insert(at, open ? "\n" : "", typed.typed, script.empty() ? "\n" : "\n\n");
    return;
  }
  const bool block = before->body.has_value() || typed.statement->body.has_value();
  const bool apart = block || before->keyword.text != typed.statement->keyword.text;
  const std::uint32_t at = line_end(text, before->span.end);
  patch.insert(at, apart ? "\n\n" : "\n", typed.typed, at == text.size() ? "\n" : "");
}

std::string title_of(const Statement& statement) {
  const std::string name = declared_name(statement);
  if (!name.empty()) return statement.keyword.text == "both" ? name : statement.keyword.text + ' ' + name;
  std::string title = statement.keyword.text;
  for (std::size_t k = 0; k < statement.operands.size(); ++k)
    title += (k > 0 ? ", " : " ") + joined(path_of(statement.operands[k]));
  return title;
}

Block parse_text(const std::string& text) {
  grammar::Sources sources;
  const grammar::SourceId id = sources.add("", text);
  return grammar::parse(sources, id, interpreter::vocabulary()).script.statements;
}

}  // namespace

std::vector<std::string> path_of(const Expr& expr) {
  if (expr.kind == ExprKind::name && expr.children.empty()) return {expr.text};
  if (expr.kind != ExprKind::member || expr.children.size() != 1) return {};
  Words path = path_of(expr.children[0]);
  if (!path.empty()) path.push_back(expr.text);
  return path;
}

std::string declared_name(const Statement& statement) {
  if (statement.keyword.text == "both") {
    const std::string name =
        statement.body && !statement.body->empty() ? declared_name(statement.body->front()) : "";
    return name.empty() ? "" : "both " + name;
  }
  if (statement.name) return statement.name->parts.empty() ? statement.name->text : "";
  const bool called = statement.keyword.text == "fn" || statement.keyword.text == "component";
  if (called && !statement.operands.empty()) {
    const Expr& head = statement.operands[0];
    const Expr& name = head.kind == ExprKind::call && !head.children.empty() ? head.children[0] : head;
    return name.kind == ExprKind::name ? name.text : "";
  }
  if (statement.keyword.text == "pair" && statement.operands.size() > 1 &&
      statement.operands[1].kind == ExprKind::name)
    return statement.operands[1].text;
  return "";
}

bool is_act(const Statement& statement) {
  return one_of(statement.keyword.text, {"drape", "release", "record", "expect", "save", "vary", "assert"});
}

std::vector<TypedStatement> cut_entry(const Block& statements, std::string_view entry) {
  std::vector<TypedStatement> cut;
  std::uint32_t from = 0;
  for (std::size_t k = 0; k < statements.size(); ++k) {
    std::uint32_t end = statements[k].span.end;
    if (k + 1 == statements.size()) end = static_cast<std::uint32_t>(entry.size());
    while (from < end && (grammar::is_blank(entry[from]) || entry[from] == '\n' || entry[from] == ';'))
      ++from;
    std::uint32_t to = end;
    while (to > from && (grammar::is_blank(entry[to - 1]) || entry[to - 1] == '\n' || entry[to - 1] == ';'))
      --to;
    cut.push_back({&statements[k], {entry.substr(from, to - from), from}});
    from = end;
  }
  return cut;
}

ScriptEdit write_statement(Patch& patch, const TypedStatement& typed, std::string_view entry, bool last) {
  const Statement& statement = *typed.statement;
  const Block script = parse_text(patch.text());
  ScriptEdit edit;
  if (statement.keyword.text == "=" && statement.operands.size() == 2) {
    const Words path = path_of(statement.operands[0]);
    const Bytes value = bytes_of(statement.operands[1].span);
    edit.name = path.empty() ? std::string(slice(entry, bytes_of(statement.operands[0].span))) : joined(path);
    edit.after = slice(entry, value);
    const auto place = path.empty() ? std::nullopt : find_value(script, path);
    if (place) {
      edit.kind = EditKind::value;
      edit.before = slice(patch.text(), *place);
      patch.replace(*place, "", {slice(entry, value), value.begin}, "");
    } else {
      add(patch, script, typed, last);
    }
    return edit;
  }
  edit.declares = true;
  edit.name = title_of(statement);
  edit.after = typed.typed.text;
  if (const Statement* same = find_same(script, statement, patch.text(), entry)) {
    edit.kind = EditKind::replaced;
    const bool documented = typed.typed.text.substr(0, 1) == "#";
    const Bytes place =
        documented ? with_comments(patch.text(), bytes_of(same->span), true) : bytes_of(same->span);
    edit.before = slice(patch.text(), place);
    patch.replace(place, "", typed.typed, "");
  } else {
    add(patch, script, typed, last);
  }
  return edit;
}

bool remove_statement(Patch& patch, const std::string& name) {
  bool found = false;
  // From the last to the first, so that the places stay true.
  const Block script = parse_text(patch.text());
  for (std::size_t k = script.size(); k-- > 0;) {
    const Statement& statement = script[k];
    const std::string declared = declared_name(statement);
    const bool declares = declared == name || declared == "both " + name;
    const bool assigns = statement.keyword.text == "=" && !statement.operands.empty() &&
                         !path_of(statement.operands[0]).empty() && path_of(statement.operands[0])[0] == name;
    if (!declares && !assigns) continue;
    found = found || declares;
    Bytes place = with_comments(patch.text(), bytes_of(statement.span), false);
    place.end = line_end(patch.text(), place.end);
    if (place.end < patch.text().size()) ++place.end;
    // Of the blank lines above and below one is enough.
    const std::string& text = patch.text();
    const bool blank_above = place.begin == 0 || (place.begin > 1 && text[place.begin - 1] == '\n' &&
                                                  text[place.begin - 2] == '\n');
    if (blank_above && place.end < text.size() && text[place.end] == '\n') ++place.end;
    patch.remove(place);
  }
  return found;
}

}  // namespace garment::session
