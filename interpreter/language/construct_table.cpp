#include "interpreter/language/construct_table.hpp"

#include <algorithm>

#include "interpreter/language/construct_families.hpp"
#include "interpreter/language/function_table.hpp"

namespace garment::interpreter {
namespace {

/// Insertions, deletions, replacements and swaps of neighbours.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) above[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = above;
    above = row;
  }
  return above[b.size()];
}

std::string range_text(const ClauseRecord& clause) {
  if (clause.min > clause.max) return "";
  const bool percent = clause.takes.find('%') != std::string_view::npos;
  return format_quantity(clause.min, clause.dimension, percent) + " .. " +
         format_quantity(clause.max, clause.dimension, percent);
}

std::string construct_help(const ConstructRecord& record) {
  std::string text = std::string(record.form) + "\n  " + std::string(record.doc) + '\n';
  if (!record.supported) text += "  (not supported yet)\n";
  for (const ClauseRecord& clause : record.clauses) {
    if (clause.doc.empty()) continue;
    text += "  " + std::string(clause.word);
    if (!clause.takes.empty()) text += ' ' + std::string(clause.takes);
    text += ": " + std::string(clause.doc);
    if (const std::string range = range_text(clause); !range.empty()) text += ", " + range;
    if (!clause.standard.empty()) text += ", default " + std::string(clause.standard);
    text += '\n';
  }
  if (!record.example.empty()) text += "  example: " + std::string(record.example) + '\n';
  return text;
}

grammar::Vocabulary make_vocabulary() {
  grammar::Vocabulary words;
  for (const ConstructRecord& record : construct_table()) {
    grammar::KeywordInfo info;
    info.keyword = record.keyword;
    info.declares_name = record.declares_name;
    info.has_body = record.has_body;
    for (const ClauseRecord& clause : record.clauses) info.clauses.emplace_back(clause.word);
    for (std::string_view word : record.body_keywords) info.body_keywords.emplace_back(word);
    words.keywords.push_back(std::move(info));
    if (record.top) words.top.emplace_back(record.keyword);
  }
  words.units = unit_names();
  return words;
}

}  // namespace

const std::vector<ConstructRecord>& construct_table() {
  static const std::vector<ConstructRecord> table = [] {
    std::vector<ConstructRecord> all;
    for (const ConstructFamily& family : kConstructFamilies)
      for (ConstructRecord& record : family.records()) all.push_back(std::move(record));
    return all;
  }();
  return table;
}

const ConstructRecord* find_construct(std::string_view keyword) {
  for (const ConstructRecord& record : construct_table())
    if (record.keyword == keyword) return &record;
  return nullptr;
}

const ClauseRecord* find_clause(const ConstructRecord& construct, std::string_view word) {
  for (const ClauseRecord& clause : construct.clauses)
    if (clause.word == word) return &clause;
  return nullptr;
}

const grammar::Vocabulary& vocabulary() {
  static const grammar::Vocabulary words = make_vocabulary();
  return words;
}

std::string help_text(std::string_view name) {
  std::string text;
  if (const ConstructRecord* record = find_construct(name)) text += construct_help(*record);
  if (const FunctionRecord* function = find_function(name)) {
    text += std::string(function->form) + "\n  " + std::string(function->doc) + '\n';
    if (!function->example.empty()) text += "  example: " + std::string(function->example) + '\n';
  }
  return text;
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  const std::size_t limit = name.size() < 3 ? 1 : std::min<std::size_t>(3, (name.size() + 2) / 3);
  std::size_t best = limit + 1, common = 0;  // of names as near, the one that begins alike for longer
  std::string found;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > name.size() + limit || name.size() > candidate.size() + limit) continue;
    const std::size_t d = edit_distance(name, candidate);
    // A name of one or two letters is no slip of another of one or two letters.
    const std::size_t alike = static_cast<std::size_t>(
        std::mismatch(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(std::min(name.size(), candidate.size())), candidate.begin()).first -
        name.begin());
    if ((d < best || (d == best && alike > common && !found.empty())) && d < std::max(name.size(), candidate.size())) {
      best = d;
      common = alike;
      found = candidate;
    }
  }
  return found;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string found = nearest_name(name, candidates);
  return found.empty() ? "" : "did you mean `" + found + "`?";
}

std::string words_hint(const ConstructRecord& construct, std::string_view word) {
  std::vector<std::string> words;
  std::string list;
  for (const ClauseRecord& clause : construct.clauses) {
    if (clause.word == ":" || clause.word == "=") continue;
    words.emplace_back(clause.word);
    list += (list.empty() ? "`" : ", `") + words.back() + '`';
  }
  const std::string near = did_you_mean(word, words);
  if (!near.empty() || list.empty()) return near;
  return "`" + std::string(word) + "` is no word of `" + std::string(construct.keyword) + "`; its words are " + list;
}

}  // namespace garment::interpreter
