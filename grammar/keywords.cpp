#include "grammar/keywords.hpp"

#include <algorithm>

#include "grammar/text.hpp"

namespace garment::grammar {

Keywords::Keywords(const Vocabulary& vocabulary) : vocabulary_(vocabulary) {
  for (const KeywordInfo& info : vocabulary.keywords) {
    Keyword keyword{&info, {}, {}};
    keyword.clauses.insert(info.clauses.begin(), info.clauses.end());
    keyword.body.insert(info.body_keywords.begin(), info.body_keywords.end());
    keywords_.emplace(info.keyword, std::move(keyword));
    std::size_t blank = info.keyword.find(' ');
    if (blank != std::string::npos) first_words_.insert(std::string_view(info.keyword).substr(0, blank));
  }
  top_.insert(vocabulary.top.begin(), vocabulary.top.end());
  units_.insert(vocabulary.units.begin(), vocabulary.units.end());
  for (const std::string& unit : vocabulary.units)
    if (!unit.empty() && !is_word_start(unit[0])) longest_sign_ = std::max(longest_sign_, unit.size());
}

Keywords::Match Keywords::match(std::string_view text, std::size_t at) const {
  std::string_view word = word_at(text, at);
  if (word.empty()) return {};
  auto found = [&](std::string_view name, std::size_t length) -> Match {
    auto row = keywords_.find(name);
    if (row == keywords_.end()) return {};
    bool touches = at + length < text.size() && (text[at + length] == '.' || text[at + length] == '{');
    return touches ? Match{} : Match{&row->second, length};
  };
  if (first_words_.count(word)) {
    std::size_t next = at + word.size();
    while (next < text.size() && is_blank(text[next])) ++next;
    std::string_view second = word_at(text, next);
    std::string both = std::string(word) + ' ' + std::string(second);
    if (Match match = found(both, next + second.size() - at); match.keyword) return match;
  }
  return found(word, word.size());
}

std::size_t Keywords::unit_length(std::string_view text, std::size_t at) const {
  if (at >= text.size()) return 0;
  if (std::string_view word = word_at(text, at); !word.empty()) return units_.count(word) ? word.size() : 0;
  for (std::size_t length = std::min(longest_sign_, text.size() - at); length > 0; --length) {
    bool ends_inside_word =
        is_word_char(text[at + length - 1]) && at + length < text.size() && is_word_char(text[at + length]);
    if (!ends_inside_word && units_.count(text.substr(at, length))) return length;
  }
  return 0;
}

std::string Keywords::suggest_keyword(std::string_view word, const WordSet& allowed) const {
  std::vector<std::string_view> candidates;
  for (const KeywordInfo& info : vocabulary_.keywords)
    if (allowed.count(info.keyword)) candidates.push_back(info.keyword);
  for (std::string_view own : {"if", "for", "both"}) candidates.push_back(own);
  return closest_word(word, candidates);
}

std::string Keywords::suggest_unit(std::string_view word) const {
  return closest_word(word, {vocabulary_.units.begin(), vocabulary_.units.end()});
}

std::vector<std::string> Keywords::places_of(std::string_view keyword) const {
  std::vector<std::string> places;
  if (top_.count(keyword)) places.push_back("the top level");
  for (const KeywordInfo& info : vocabulary_.keywords)
    if (keywords_.at(info.keyword).body.count(keyword)) places.push_back("`" + info.keyword + "`");
  return places;
}

}  // namespace garment::grammar
