#include "interpreter/cli/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "grammar/diagnostic.hpp"
#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/function_table.hpp"

namespace garment::cli {
namespace {

using nlohmann::ordered_json;

/// "g312" and "312" as the table writes them, "G0312"; other texts stay.
std::string as_code(const std::string& topic) {
  const std::size_t first = !topic.empty() && (topic[0] == 'g' || topic[0] == 'G') ? 1 : 0;
  const std::string digits = topic.substr(first);
  if (digits.empty() || digits.size() > 4 || digits.find_first_not_of("0123456789") != std::string::npos) return topic;
  return "G" + std::string(4 - digits.size(), '0') + digits;
}

bool looks_like_code(const std::string& topic) { return topic.size() == 5 && topic[0] == 'G' && as_code(topic) == topic; }

/// Of a clause word: the statements that know it, each with what it says there.
std::string clause_text(const std::string& word) {
  std::string text;
  for (const interpreter::ConstructRecord& record : interpreter::construct_table())
    if (const interpreter::ClauseRecord* clause = interpreter::find_clause(record, word))
      text += fmt::format("  {}: `{}{}{}` {}\n", record.keyword, clause->word, clause->takes.empty() ? "" : " ",
                          clause->takes, clause->doc);
  return text.empty() ? "" : fmt::format("`{}` is a clause of\n{}", word, text);
}

std::vector<std::string> topics_like(const std::string& topic) {
  std::vector<std::string> all;
  if (looks_like_code(topic)) {
    for (const grammar::CodeInfo& row : grammar::code_table()) all.emplace_back(row.code);
    // The slip is in the last digits more often than in those of the family.
    std::stable_partition(all.begin(), all.end(), [&](const std::string& code) { return code.compare(0, 3, topic, 0, 3) == 0; });
    return all;
  }
  for (const interpreter::ConstructRecord& record : interpreter::construct_table()) {
    all.emplace_back(record.keyword);
    for (const interpreter::ClauseRecord& clause : record.clauses) all.emplace_back(clause.word);
  }
  for (const interpreter::FunctionRecord& record : interpreter::function_table()) all.emplace_back(record.name);
  return all;
}

std::string unknown_text(const std::string& topic) {
  const std::string meant = interpreter::did_you_mean(topic, topics_like(topic));
  return fmt::format("`{}` is no diagnostic code{}; {}`garment explain --list` names all codes", topic,
                     looks_like_code(topic) ? "" : " and no word of the language", meant.empty() ? "" : meant + " ");
}

}  // namespace

ExitCode explain(const std::vector<std::string>& topics, Terminal& terminal) {
  ExitCode code = kOk;
  ordered_json all = ordered_json::array();
  std::string text;
  for (const std::string& asked : topics) {
    const std::string topic = as_code(asked);
    std::string one;
    if (const grammar::CodeInfo* info = grammar::find_code(topic)) {
      one = fmt::format("{}: {}\n\n{}\n", info->code, info->title, info->explanation);
      all.push_back({{"code", info->code}, {"title", info->title}, {"explanation", info->explanation}});
    } else {
      one = interpreter::help_text(topic);
      if (one.empty()) one = clause_text(topic);
      if (!one.empty()) all.push_back({{"word", topic}, {"explanation", one}});
    }
    if (one.empty()) {
      terminal.error(unknown_text(topic));
      code = kUsage;
      continue;
    }
    text += (text.empty() ? "" : "\n") + one;
  }
  if (terminal.options().json)
    terminal.result(all.dump(2));
  else
    terminal.result(text);
  return code;
}

ExitCode list_codes(Terminal& terminal) {
  ordered_json all = ordered_json::array();
  std::string text;
  for (const grammar::CodeInfo& row : grammar::code_table()) {
    all.push_back({{"code", row.code}, {"title", row.title}});
    text += fmt::format("{}  {}\n", row.code, row.title);
  }
  terminal.result(terminal.options().json ? all.dump(2) : text);
  return kOk;
}

}  // namespace garment::cli
