#include "interpreter/service/documentation.hpp"

#include <algorithm>

#include "interpreter/language/program.hpp"
#include "interpreter/service/members.hpp"

namespace garment::service {
namespace {

using namespace interpreter;

std::string with_example(std::string_view doc, std::string_view example) {
  std::string text(doc);
  if (!example.empty()) text += "\n\n```garment\n" + std::string(example) + "\n```";
  return text;
}

bool is_lower(char c) { return (c >= 'a' && c <= 'z') || c == '_'; }

}  // namespace

const std::vector<ParserWord>& parser_words() {
  static const std::vector<ParserWord> words = {
      {"if", "if CONDITION { ... } else { ... }",
       "states what stands in its block where the condition holds"},
      {"for", "for NAME in RANGE { ... }",
       "states its block once for each value; names inside may hold `{NAME}`"},
      {"both", "both STATEMENT", "states it for the left and the right half"},
  };
  return words;
}

std::string construct_doc(const ConstructRecord& record) { return with_example(record.doc, record.example); }

std::string function_doc(const FunctionRecord& function) {
  return with_example(function.doc, function.example);
}

std::string clause_detail(const ClauseRecord& clause) {
  std::string text(clause.takes);
  auto append = [&](const std::string& more) { text += (text.empty() ? "" : ", ") + more; };
  const bool percent = clause.takes.find('%') != std::string_view::npos;
  if (clause.min <= clause.max)
    append(format_quantity(clause.min, clause.dimension, percent) + " .. " +
           format_quantity(clause.max, clause.dimension, percent));
  if (!clause.standard.empty()) append("default " + std::string(clause.standard));
  return text;
}

std::string operands_of(const ConstructRecord& record) {
  std::string_view form = record.form.substr(std::min(record.form.size(), record.keyword.size()));
  form = form.substr(0, form.find(" | " + std::string(record.keyword)));
  std::string text;
  std::size_t at = 0;
  while (at < form.size()) {
    std::size_t end = std::min(form.find(' ', at), form.size());
    const std::string_view word = form.substr(at, end - at);
    at = end + 1;
    std::string bare(word);
    std::erase_if(bare, [](char c) { return c == '[' || c == ']' || c == ','; });
    if (!bare.empty() && find_clause(record, bare) != nullptr) break;
    if (bare.find(':') != std::string::npos) break;
    if (bare != "NAME" || !record.declares_name) text += (text.empty() ? "" : " ") + std::string(word);
  }
  return text;
}

FixedWords fixed_words(std::string_view takes) {
  FixedWords found;
  found.only = true;
  std::size_t at = 0;
  while (at < takes.size()) {
    if (is_lower(takes[at])) {
      std::size_t end = at;
      while (end < takes.size() && is_lower(takes[end])) ++end;
      found.words.emplace_back(takes.substr(at, end - at));
      at = end;
      continue;
    }
    const char c = takes[at];
    if ((c >= 'A' && c <= 'Z') || c == '%' || c == '"' || c == '(') found.only = false;
    if (c == '"') at = std::min(takes.find('"', at + 1), takes.size() - 1);
    while (at < takes.size() && ((takes[at] >= 'A' && takes[at] <= 'Z') || takes[at] == '.')) ++at;
    if (at < takes.size() && !is_lower(takes[at])) ++at;
  }
  return found;
}

std::vector<Parameter> parameters_of_head(const Expr& head, const grammar::Sources& sources) {
  std::vector<Parameter> parameters;
  for (std::size_t k = 1; k < head.children.size(); ++k) {
    const Expr& child = head.children[k];
    const bool labelled = k - 1 < head.labels.size() && !head.labels[k - 1].text.empty();
    Parameter parameter;
    parameter.name = labelled ? head.labels[k - 1].text : child.text;
    parameter.text = (labelled ? parameter.name + ": " : "") + std::string(sources.text(child.span));
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

std::optional<Callable> find_callable(Program* program, std::string_view callee) {
  if (program != nullptr)
    if (const auto value = quiet_value(*program, callee))
      if (const auto* function = value->as<FunctionValue>()) {
        const Statement& statement = *function->declaration->statement;
        Callable callable{function->declaration->name, "", statement.doc, {}};
        if (!statement.operands.empty())
          callable.parameters = parameters_of_head(statement.operands[0], program->sources);
        callable.form = std::string(callee) + '(';
        for (std::size_t k = 0; k < callable.parameters.size(); ++k)
          callable.form += (k > 0 ? ", " : "") + callable.parameters[k].text;
        callable.form += ')';
        return callable;
      }
  const FunctionRecord* record = find_function(callee);
  if (record == nullptr) return std::nullopt;
  Callable callable{std::string(callee), std::string(record->form), function_doc(*record), {}};
  for (std::string_view name : record->parameters)
    callable.parameters.push_back({std::string(name), std::string(name)});
  return callable;
}

}  // namespace garment::service
