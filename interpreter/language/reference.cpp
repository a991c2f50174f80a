// The reference page, made from the tables, so that it never says less or more than the program knows.
#include <algorithm>

#include "grammar/diagnostic.hpp"
#include "interpreter/language/construct_families.hpp"
#include "interpreter/language/function_table.hpp"
#include "runtime/base/number.hpp"

namespace garment::interpreter {
namespace {

constexpr const char* kHead = R"(# The Garment language: reference

<!-- made by `garment reference > docs/reference.md`; a test holds it against the tables of the program -->

All words of the language. [language.md](language.md) is the guide and says what a script means; `garment explain WORD` and
`:help WORD` at the prompt print the same records as this page, `garment explain CODE` the long text of a diagnostic.

In a form, CAPITALS stand for what you fill in, `[ ]` for what may be left out, `|` for a choice, `...` for more of the
same. Clauses may come in any order.

)";

/// Titles of the families of codes, by the first two digits.
constexpr std::pair<std::string_view, std::string_view> kCodeFamilies[] = {
    {"G01", "How a text is read"},
    {"G02", "How statements are put together"},
    {"G03", "Names, values, and what a script means"},
    {"G04", "Panels, darts, and the particle model"},
    {"G05", "Seams"},
    {"G06", "Placement"},
    {"G07", "Bodies"},
    {"G08", "The drape"},
    {"G09", "Files"},
    {"G10", "The command line"},
    {"G11", "Cloth"},
    {"G12", "Components and parts"},
    {"G13", "The scene"},
    {"G14", "Closures"},
    {"G15", "The prompt, the editor service, golden tests"},
    {"G16", "Budgets and access"},
};

std::string cell(std::string_view text) {
  std::string out;
  for (char c : text) {
    if (c == '|') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

std::string code(std::string_view text) { return text.empty() ? "" : '`' + cell(text) + '`'; }

std::string sentence(std::string_view text) {
  std::string out(text);
  if (!out.empty() && out[0] >= 'a' && out[0] <= 'z') out[0] = static_cast<char>(out[0] - 32);
  return out.empty() || out.back() == '.' ? out : out + '.';
}

std::string bounds(const ClauseRecord& clause) {
  if (clause.min > clause.max) return "";
  const bool percent = clause.takes.find('%') != std::string_view::npos;
  return format_quantity(clause.min, clause.dimension, percent) + " .. " +
         format_quantity(clause.max, clause.dimension, percent);
}

/// "At the top level; in the block of `panel`."
std::string places(const ConstructRecord& record) {
  std::string blocks;
  for (const ConstructRecord& other : construct_table())
    if (std::find(other.body_keywords.begin(), other.body_keywords.end(), record.keyword) !=
        other.body_keywords.end())
      blocks += (blocks.empty() ? "`" : ", `") + std::string(other.keyword) + '`';
  std::string text;
  if (record.top) text = "at the top level";
  if (!blocks.empty()) text += (text.empty() ? "in the block of " : ", in the block of ") + blocks;
  if (record.in_library) text += ", in a library";
  return text.empty() ? "" : "Stands " + text + ".";
}

std::string clause_rows(const ConstructRecord& record) {
  std::string text;
  for (const ClauseRecord& clause : record.clauses) {
    if (clause.doc.empty() || clause.word == "=") continue;
    if (text.empty()) text = "| clause | takes | meaning | range | default |\n|---|---|---|---|---|\n";
    text += "| " + code(clause.word) + " | " + cell(clause.takes) + " | " + cell(clause.doc) + " | " +
            bounds(clause) + " | " + cell(clause.standard) + " |\n";
  }
  return text.empty() ? "" : text + '\n';
}

/// Where its example stands, for those who try it: `in=panel`, nothing at the top level.
std::string fence_tag(const ConstructRecord& record) {
  if (record.top) return "";
  for (const ConstructRecord& other : construct_table())
    if (std::find(other.body_keywords.begin(), other.body_keywords.end(), record.keyword) !=
        other.body_keywords.end())
      return " in=" + std::string(other.keyword);
  return "";
}

std::string construct_text(const ConstructRecord& record) {
  std::string text =
      "### " + std::string(record.keyword) + "\n\n```\n" + std::string(record.form) + "\n```\n\n";
  text += sentence(record.doc) + ' ' + places(record) + "\n\n" + clause_rows(record);
  if (record.example.empty()) return text;
  return text + "```garment" + fence_tag(record) + '\n' + std::string(record.example) + "\n```\n\n";
}

std::string constructs_text() {
  std::string text, waiting;
  for (const ConstructFamily& family : kConstructFamilies) {
    std::string chapter;
    for (const ConstructRecord& record : family.records()) {
      if (record.supported)
        chapter += construct_text(record);
      else
        waiting += (waiting.empty() ? "`" : " `") + std::string(record.keyword) + '`';
    }
    if (!chapter.empty()) text += "## " + std::string(family.title) + "\n\n" + chapter;
  }
  if (!waiting.empty()) text += "## Words whose meaning is still to come\n\n" + waiting + "\n\n";
  return text;
}

std::string functions_text() {
  std::string text = "## Functions and constants\n\n| form | value | example |\n|---|---|---|\n";
  for (const FunctionRecord& function : function_table())
    text += "| " + code(function.form) + " | " + cell(function.doc) + " | " + code(function.example) + " |\n";
  return text + '\n';
}

std::string units_text() {
  std::string text =
      "## Units\n\nProducts are joined by `*`, `/` and `^`: `0.12 gf*cm^2/cm`.\n\n| unit | measures | in SI "
      "|\n|---|---|---|\n";
  for (const Unit& unit : unit_table()) {
    std::string base = example_unit(unit.dimension);
    text += "| `" + std::string(unit.name) + "` | " + describe(unit.dimension) + " | " +
            format_number(unit.factor, 10);
    for (const Unit& other : unit_table())
      if (other.dimension == unit.dimension && other.factor == 1) {
        text += ' ' + std::string(other.name);
        break;
      }
    text += " |\n";
  }
  return text + '\n';
}

std::string codes_text() {
  std::string text = "## Diagnostic codes\n\n`garment explain CODE` says more about each.\n\n";
  for (const auto& [prefix, title] : kCodeFamilies) {
    std::string rows;
    for (const grammar::CodeInfo& info : grammar::code_table())
      if (info.code.substr(0, 3) == prefix)
        rows += "| " + std::string(info.code) + " | " + cell(info.title) + " |\n";
    if (!rows.empty())
      text += "### " + std::string(title) + "\n\n| code | title |\n|---|---|\n" + rows + '\n';
  }
  return text;
}

}  // namespace

std::string reference_markdown() {
  return kHead + constructs_text() + functions_text() + units_text() + codes_text();
}

}  // namespace garment::interpreter
