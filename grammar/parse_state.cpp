#include "grammar/parse_state.hpp"

#include <algorithm>

#include "grammar/text.hpp"

namespace garment::grammar {
namespace {

bool joins_values(std::string_view word) {
  return word == "and" || word == "or" || word == "minus" || word == "is" || word == "with" ||
         word == "not" || word == "else";
}

}  // namespace

std::size_t ParseState::line_of(std::size_t at) const {
  auto next = std::upper_bound(line_begin_.begin(), line_begin_.end(), static_cast<std::uint32_t>(at));
  return static_cast<std::size_t>(next - line_begin_.begin()) - 1;
}

int ParseState::indent_of(std::size_t at) const {
  std::size_t line = line_of(at);
  if (indent_ >= 0 && line == indent_line_) return indent_;
  int indent = 0;
  for (std::size_t i = line_begin_[line]; is_blank(this->at(i)); ++i)
    indent += text_[i] == '\t' ? kTabStop - indent % kTabStop : 1;
  indent_line_ = line;
  indent_ = indent;
  return indent;
}

bool ParseState::first_on_line(std::size_t at) const {
  while (at > 0 && is_blank(text_[at - 1])) --at;
  return at == 0 || text_[at - 1] == '\n';
}

std::size_t ParseState::clause_word(std::size_t at) const {
  if (expressions_.mode() != Mode::items || statements_.empty() || !statements_.back().keyword) return 0;
  std::string_view word = word_at(text_, at);
  if (word.empty() || !statements_.back().keyword->clauses.count(word)) return 0;
  char next = this->at(at + word.size());
  bool is_member = next == '.' && this->at(at + word.size() + 1) != '.';
  bool is_hole = next == '{' && word != "with";  // with{ is a record, never a name
  return is_member || is_hole || next == '(' || next == '[' ? 0 : word.size();
}

std::size_t ParseState::clause_sign(std::size_t at) const {
  if (expressions_.mode() != Mode::items || statements_.empty() || !statements_.back().keyword) return 0;
  char c = this->at(at);
  if ((c != '=' && c != ':') || this->at(at + 1) == '=') return 0;
  return statements_.back().keyword->clauses.count(text_.substr(at, 1));
}

std::size_t ParseState::next_word_line(std::size_t at) const {
  while (at < text_.size()) {
    char c = text_[at];
    if (c == '#')
      at = std::min(text_.find('\n', at), text_.size());
    else if (is_blank(c) || c == '\n')
      ++at;
    else
      break;
  }
  return at;
}

std::size_t ParseState::continuation(std::size_t at) const {
  if (this->at(at) != '\n' || expressions_.mode() != Mode::items) return 0;
  if (statements_.empty() || !statements_.back().keyword) return 0;
  std::size_t next = next_word_line(at);
  if (next >= text_.size() || (clause_word(next) == 0 && clause_sign(next) == 0)) return 0;
  return indent_of(next) > statements_.back().indent ? next - at : 0;
}

bool ParseState::sign_begins_value(std::size_t at) const {
  if (expressions_.mode() != Mode::items || statements_.empty()) return false;
  char c = this->at(at);
  if ((c != '+' && c != '-') || at == 0 || !is_blank(text_[at - 1])) return false;
  char next = this->at(at + 1);
  return next != '\0' && next != '\n' && !is_blank(next);
}

bool ParseState::statement_begins(std::size_t at) const {
  if (statements_.empty() || !is_word_start(this->at(at)) || !first_on_line(at)) return false;
  std::string_view word = word_at(text_, at);
  std::size_t length = keywords_.match(text_, at).length;
  if (word == "for" || word == "both") length = word.size();
  if (length == 0) return false;
  std::size_t next = at + length;
  while (is_blank(this->at(next))) ++next;
  if (next == at + length) return false;
  char c = this->at(next);
  return c == '"' || is_digit(c) || (is_word_start(c) && !joins_values(word_at(text_, next)));
}

bool ParseState::assignment_begins(std::size_t at) const {
  if (!is_word_start(this->at(at))) return false;
  const std::size_t begin = at;
  while (true) {
    while (is_word_char(this->at(at))) ++at;
    if (this->at(at) == '{') {
      int open = 0;
      for (; at < text_.size() && text_[at] != '\n'; ++at) {
        if (text_[at] == '{') ++open;
        if (text_[at] == '}' && --open == 0) break;
      }
      if (this->at(at) != '}') return false;
      ++at;
    } else if (this->at(at) == '.' && is_word_start(this->at(at + 1))) {
      ++at;
    } else {
      break;
    }
  }
  std::string_view target = text_.substr(begin, at - begin);
  while (is_blank(this->at(at))) ++at;
  if (this->at(at) != '=' || this->at(at + 1) == '=') return false;
  Keywords::Match match = allowed_keyword(begin);  // `let = 3` lacks its name
  bool lacks_name = match.length == target.size() && match.keyword->info->declares_name &&
                    match.keyword->clauses.count("=");
  return !lacks_name;
}

const WordSet& ParseState::allowed_words() const {
  return statements_.empty() ? keywords_.top() : *statements_.back().allowed;
}

Keywords::Match ParseState::allowed_keyword(std::size_t at) const {
  Keywords::Match match = keywords_.match(text_, at);
  if (match.keyword && !allowed_words().count(match.keyword->info->keyword)) return {};
  return match;
}

bool ParseState::outer_statement_begins(std::size_t at) const {
  if (statements_.empty() || !statements_.back().in_block || !first_on_line(at)) return false;
  std::size_t word_begin = at;
  if (word_at(text_, at) == "both")
    for (word_begin += 4; is_blank(this->at(word_begin));) ++word_begin;
  const Keyword* keyword = keywords_.match(text_, word_begin).keyword;
  if (!keyword || assignment_begins(at)) return false;
  std::string_view word = keyword->info->keyword;
  if (allowed_words().count(word) || indent_of(at) > statements_.back().indent) return false;
  if (keywords_.top().count(word)) return true;
  return std::any_of(statements_.begin(), statements_.end() - 1,
                     [&](const Open& open) { return open.allowed->count(word) > 0; });
}

bool ParseState::block_begins_below(std::size_t at) const {
  const Open& open = statements_.back();
  if (this->at(at) != '\n' || !open.keyword || !open.keyword->info->has_body) return false;
  std::size_t next = next_word_line(at);
  const Keyword* keyword = keywords_.match(text_, next).keyword;
  if (!keyword || indent_of(next) <= open.indent || assignment_begins(next)) return false;
  const WordSet& around =
      statements_.size() > 1 ? *statements_[statements_.size() - 2].allowed : keywords_.top();
  std::string_view word = keyword->info->keyword;
  return open.allowed->count(word) > 0 && around.count(word) == 0;
}

bool ParseState::declares_name() const { return statements_.back().keyword->info->declares_name; }

bool ParseState::has_body() const { return statements_.back().keyword->info->has_body; }

}  // namespace garment::grammar
