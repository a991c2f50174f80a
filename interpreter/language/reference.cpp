// The reference page, made from the tables, so that it never says less or more than the program knows.
#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/function_table.hpp"

namespace garment::interpreter {
namespace {

std::string cell(std::string_view text) {
  std::string out;
  for (char c : text) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out;
}

std::string code(std::string_view text) { return text.empty() ? "" : '`' + cell(text) + '`'; }

std::string bounds(const ClauseRecord& clause) {
  if (clause.min > clause.max) return "";
  const bool percent = clause.takes.find('%') != std::string_view::npos;
  return format_quantity(clause.min, clause.dimension, percent) + " .. " +
         format_quantity(clause.max, clause.dimension, percent);
}

std::string construct_text(const ConstructRecord& record) {
  std::string text =
      "### " + std::string(record.keyword) + "\n\n```\n" + std::string(record.form) + "\n```\n\n";
  std::string doc(record.doc);
  doc[0] = static_cast<char>(doc[0] >= 'a' && doc[0] <= 'z' ? doc[0] - 32 : doc[0]);
  text += doc + ".\n\n";
  bool table = false;
  for (const ClauseRecord& clause : record.clauses) {
    if (clause.doc.empty() || clause.word == "=") continue;
    if (!table) text += "| clause | takes | meaning | range | default |\n|---|---|---|---|---|\n";
    table = true;
    text += "| " + code(clause.word) + " | " + cell(clause.takes) + " | " + cell(clause.doc) + " | " +
            bounds(clause) + " | " + cell(clause.standard) + " |\n";
  }
  if (table) text += '\n';
  return text + "```garment\n" + std::string(record.example) + "\n```\n\n";
}

}  // namespace

std::string reference_markdown() {
  std::string text;
  for (const ConstructRecord& record : construct_table())
    if (record.supported) text += construct_text(record);
  text += "### Functions and constants\n\n| form | value | example |\n|---|---|---|\n";
  for (const FunctionRecord& function : function_table())
    text += "| " + code(function.form) + " | " + cell(function.doc) + " | " + code(function.example) + " |\n";
  text += "\n### Units\n\n";
  for (const Unit& unit : unit_table())
    text += (&unit == &unit_table().front() ? "`" : " `") + std::string(unit.name) + '`';
  text += "\n\n### Words whose meaning is still to come\n\n";
  bool first = true;
  for (const ConstructRecord& record : construct_table()) {
    if (record.supported) continue;
    text += (first ? "`" : " `") + std::string(record.keyword) + '`';
    first = false;
  }
  return text + "\n";
}

}  // namespace garment::interpreter
