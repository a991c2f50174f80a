#include "interpreter/service/textmate.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/function_table.hpp"
#include "interpreter/language/units.hpp"
#include "interpreter/service/documentation.hpp"

namespace garment::service {
namespace {

using namespace interpreter;
using Json = nlohmann::ordered_json;

const std::string kWord = "[A-Za-z_][A-Za-z_0-9]*";
/// Not part of a longer value: `edge.at(...)`, `front.side`, `length(...)`.
const std::string kAlone = "(?![A-Za-z_0-9.(\\[{])";
/// Where a statement begins: a line, or behind `;` and braces.
const std::string kBegins = "(?:^|(?<=[;{}]))[ \\t]*";

Json match(const std::string& name, const std::string& regex) {
  return Json{{"name", name + ".garment"}, {"match", regex}};
}

Json include(const std::string& rule) { return Json{{"include", "#" + rule}}; }

Json captures(std::initializer_list<std::pair<const char*, std::string>> names) {
  Json json = Json::object();
  for (const auto& [group, name] : names) json[group] = Json{{"name", name + ".garment"}};
  return json;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (std::string_view("\\^$.|?*+()[]{}").find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

/// The longest first, so that `cm` is not read as `c`.
std::string any_of(std::vector<std::string> words) {
  std::sort(words.begin(), words.end(), [](const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() > b.size() : a < b;
  });
  words.erase(std::unique(words.begin(), words.end()), words.end());
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : "|") + escaped(word);
  return "(?:" + out + ")";
}

std::string unit_regex() {
  std::vector<std::string> words, signs;
  for (const std::string& unit : unit_names())
    ((unit[0] >= 'a' && unit[0] <= 'z') || (unit[0] >= 'A' && unit[0] <= 'Z') ? words : signs)
        .push_back(unit);
  const std::string one =
      "(?:" + any_of(words) + "(?![A-Za-z_0-9])" + (signs.empty() ? "" : "|" + any_of(signs)) + ")";
  const std::string factor = one + "(?:\\^-?[0-9]+(?![A-Za-z_0-9.]))?";
  return factor + "(?:[*/]" + factor + ")*";
}

Json number_rule() {
  return Json{{"match", "(?<![A-Za-z_0-9.])([0-9]+(?:\\.[0-9]+)?(?:[eE][+-]?[0-9]+)?)(?:[ \\t]*(" +
                            unit_regex() + "))?"},
              {"captures", captures({{"1", "constant.numeric"}, {"2", "keyword.other.unit"}})}};
}

Json string_rule() {
  const Json hole{{"name", "meta.interpolation.garment"},
                  {"begin", "\\{"},
                  {"end", "\\}|$"},
                  {"beginCaptures", captures({{"0", "punctuation.section.interpolation.begin"}})},
                  {"endCaptures", captures({{"0", "punctuation.section.interpolation.end"}})},
                  {"patterns", {include("expression")}}};
  return Json{{"name", "string.quoted.double.garment"},
              {"begin", "\""},
              {"end", "\"|$"},
              {"patterns", {match("constant.character.escape", "\\\\[\"\\\\n{]"), hole}}};
}

Json comment_rule() {
  return Json{
      {"patterns",
       {match("comment.block.documentation", "##(?!#).*$"), match("comment.line.number-sign", "#.*$")}}};
}

/// Brackets: in them no clause word counts, and lines go on.
Json bracket_rule(const char* open, const char* close, std::vector<Json> first) {
  Json patterns = Json::array();
  for (Json& rule : first) patterns.push_back(std::move(rule));
  patterns.push_back(include("expression"));
  return Json{{"begin", open},
              {"end", close},
              {"beginCaptures", captures({{"0", "punctuation.section.brackets.begin"}})},
              {"endCaptures", captures({{"0", "punctuation.section.brackets.end"}})},
              {"patterns", patterns}};
}

Json label_rule(const std::string& sign) {
  return Json{{"match", "(" + kWord + ")[ \\t]*(" + sign + ")"},
              {"captures", captures({{"1", "variable.parameter"}, {"2", "punctuation.separator"}})}};
}

Json expression_rule() {
  std::vector<std::string> functions;
  for (const FunctionRecord& function : function_table())
    if (function.name.find('.') == std::string_view::npos) functions.emplace_back(function.name);
  Json patterns = Json::array(
      {include("comment"), include("string"), include("number"), include("hole"),
       match("constant.language.boolean", "\\b(?:true|false)\\b(?!\\.)"),
       match("keyword.operator.word", "\\b(?:and|or|not|minus|is|with|if|else)\\b(?![.(])"),
       Json{{"match", "(\\.)(" + kWord + ")(?=\\()"},
            {"captures", captures({{"1", "punctuation.accessor"}, {"2", "entity.name.function"}})}},
       Json{{"match", "(?<!\\.)(\\.)(" + kWord + ")"},
            {"captures", captures({{"1", "punctuation.accessor"}, {"2", "variable.other.member"}})}},
       match("support.function", "(?<![.A-Za-z_0-9])" + any_of(functions) + "(?![A-Za-z_0-9.])"),
       match("entity.name.function", kWord + "(?=\\()"), match("variable.other", kWord),
       match("keyword.operator", "\\.\\.|==|!=|<=|>=|[-+*/^<>=:]"), match("punctuation.separator", "[,;.]")});
  patterns.push_back(bracket_rule("\\(", "\\)", {label_rule(":")}));
  patterns.push_back(bracket_rule("\\[", "\\]", {}));
  return Json{{"patterns", patterns}};
}

/// `h_{i}`: the brace touches the word and what it holds.
Json hole_rule() {
  return Json{{"name", "meta.interpolation.garment"},
              {"begin", "(?<=[A-Za-z_0-9}])(?<!\\bwith)(?<!\\belse)\\{(?=[^ \\t}#])"},
              {"end", "\\}|$"},
              {"patterns", {include("expression")}}};
}

Json record_rule() {
  return Json{{"begin", "(?:((?<![=<>!])=(?!=))|\\b(with))[ \\t]*(\\{)"},
              {"end", "\\}"},
              {"beginCaptures", captures({{"1", "keyword.operator"},
                                          {"2", "keyword.operator.word"},
                                          {"3", "punctuation.section.record.begin"}})},
              {"patterns", {include("record"), label_rule("(?<![=<>!])=(?!=)"), include("expression")}}};
}

Json block_rule() {
  return Json{{"begin", "\\{"},
              {"end", "\\}"},
              {"beginCaptures", captures({{"0", "punctuation.section.block.begin"}})},
              {"endCaptures", captures({{"0", "punctuation.section.block.end"}})},
              {"patterns", {include("statements")}}};
}

/// What a statement holds behind its head, in the order in which its rules are tried.
Json statement_patterns(const std::vector<std::string>& clauses, const std::set<std::string>& fixed) {
  Json patterns = Json::array({include("comment"), include("string"), include("number"), include("record"),
                               include("hole"), include("block")});
  std::vector<std::string> words;
  for (const std::string& clause : clauses)
    if (clause != ":" && clause != "=") words.push_back(clause);
  if (!words.empty())
    patterns.push_back(match("keyword.other.clause", "(?<![A-Za-z_0-9.])" + any_of(words) + kAlone));
  std::vector<std::string> choices;
  for (const std::string& word : fixed)
    if (std::find(words.begin(), words.end(), word) == words.end()) choices.push_back(word);
  if (!choices.empty())
    patterns.push_back(match("support.constant", "(?<![A-Za-z_0-9.])" + any_of(choices) + kAlone));
  patterns.push_back(include("expression"));
  return patterns;
}

/// A statement ends at `;` and `}`, and at a line that does not go on with one of its clause words, deeper.
std::string statement_end(const std::vector<std::string>& clauses) {
  if (clauses.empty()) return "(?=[;}])|^";
  return "(?=[;}])|^(?![ \\t]+" + any_of(clauses) + "(?![A-Za-z_0-9.(\\[]))";
}

Json construct_rule(const ConstructRecord& record) {
  std::vector<std::string> clauses;
  std::set<std::string> fixed;
  for (const ClauseRecord& clause : record.clauses) {
    clauses.emplace_back(clause.word);
    for (std::string& word : fixed_words(clause.takes).words) fixed.insert(std::move(word));
  }
  // The second word of `pair panel`, `replace edge`.
  const std::string form(record.form);
  const std::size_t second = record.keyword.size() + 1;
  std::string word =
      form.size() > second
          ? form.substr(second, form.find_first_not_of("abcdefghijklmnopqrstuvwxyz", second) - second)
          : "";
  if (std::find(clauses.begin(), clauses.end(), word) != clauses.end() || find_construct(word) == nullptr)
    word.clear();
  const bool called = record.keyword == "fn" || record.keyword == "component";
  std::string keyword = escaped(record.keyword);
  if (const std::size_t blank = keyword.find(' '); blank != std::string::npos)
    keyword.replace(blank, 1, "[ \\t]+");
  std::string begin = kBegins + "(?:(both)[ \\t]+)?(" + keyword + ")(?![A-Za-z_0-9.{(\\[])(?![ \\t]*=(?!=))";
  if (!word.empty()) begin += "(?:[ \\t]+(" + word + ")(?![A-Za-z_0-9.]))?";
  const char* const group = word.empty() ? "3" : "4";
  if (record.declares_name || called || !word.empty()) begin += "(?:[ \\t]+(" + kWord + "))?";
  Json begin_captures = captures({{"1", "keyword.control"}, {"2", "keyword.other"}});
  if (!word.empty()) begin_captures["3"] = Json{{"name", "keyword.other.garment"}};
  begin_captures[group] = Json{{"name", called ? "entity.name.function.garment" : "entity.name.garment"}};
  return Json{{"name", "meta.statement." + std::string(record.keyword) + ".garment"},
              {"begin", begin},
              {"end", statement_end(clauses)},
              {"beginCaptures", begin_captures},
              {"patterns", statement_patterns(clauses, fixed)}};
}

Json control_rules() {
  const Json loop{
      {"begin", kBegins + "(for)(?![A-Za-z_0-9.(])[ \\t]+(" + kWord + ")[ \\t]+(in)(?![A-Za-z_0-9])"},
      {"end", "(?=[;}])|^"},
      {"beginCaptures",
       captures({{"1", "keyword.control"}, {"2", "entity.name"}, {"3", "keyword.other.clause"}})},
      {"patterns", statement_patterns({}, {})}};
  Json words = statement_patterns({}, {});
  words.insert(words.begin(), match("keyword.control", "(?<![A-Za-z_0-9.])(?:else|if)(?![A-Za-z_0-9.(])"));
  const Json choice{
      {"begin", kBegins + "(?:(else)(?:[ \\t]+(if))?|(if))(?![A-Za-z_0-9.(])"},
      {"end", "(?=[;}])|^"},
      {"beginCaptures",
       captures({{"1", "keyword.control"}, {"2", "keyword.control"}, {"3", "keyword.control"}})},
      {"patterns", words}};
  return Json::array({loop, choice});
}

Json statements_rule() {
  Json patterns = Json::array({include("comment")});
  for (const Json& rule : control_rules()) patterns.push_back(rule);
  for (const ConstructRecord& record : construct_table()) patterns.push_back(construct_rule(record));
  patterns.push_back(include("record"));
  patterns.push_back(include("expression"));
  return Json{{"patterns", patterns}};
}

}  // namespace

std::string textmate_grammar() {
  const Json grammar{
      {"$schema", "https://raw.githubusercontent.com/martinring/tmlanguage/master/tmlanguage.json"},
      {"comment", "Made from the tables of the language: garment reference --textmate"},
      {"name", "Garment"},
      {"scopeName", "source.garment"},
      {"patterns", {include("statements")}},
      {"repository",
       {{"statements", statements_rule()},
        {"block", block_rule()},
        {"record", record_rule()},
        {"hole", hole_rule()},
        {"expression", expression_rule()},
        {"number", number_rule()},
        {"string", string_rule()},
        {"comment", comment_rule()}}}};
  return grammar.dump(1) + "\n";
}

}  // namespace garment::service
