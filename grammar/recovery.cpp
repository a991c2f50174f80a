// Where reading goes on after a mistake: at the end of the broken statement, so that one mistake gives one
// message.
#include <algorithm>

#include "grammar/parse_state.hpp"
#include "grammar/text.hpp"

namespace garment::grammar {

/// `next` is the first word after a line end inside the broken statement; `open` the brackets open there.
bool ParseState::ends_before(std::size_t next, std::size_t position, int indent,
                             const std::vector<char>& open) const {
  if (next >= text_.size()) return true;
  bool deeper = indent_of(next) > indent;
  char c = text_[next];
  bool closes = c == ')' || c == ']' || c == '}';
  bool in_braces = std::find(open.begin(), open.end(), '{') != open.end();
  if (in_braces) return !deeper && next > position && statement_begins(next);
  if (statement_begins(next) || (!deeper && assignment_begins(next))) return true;
  if (next < position) return false;
  if (!deeper) return !closes || open.empty();
  return open.empty() && (keywords_.match(text_, next).keyword || assignment_begins(next));
}

std::size_t ParseState::resume(std::size_t begin, std::size_t position) const {
  std::vector<char> open;
  const int indent = indent_of(begin);
  std::size_t i = begin;
  while (i < text_.size()) {
    char c = text_[i];
    if (c == '#') {
      i = std::min(text_.find('\n', i), text_.size());
      continue;
    }
    if (c == '"') {
      i = end_of_string(text_, i);
      continue;
    }
    if (c == '(' || c == '[' || c == '{') open.push_back(c);
    if ((c == ')' || c == ']') && !open.empty() && open.back() != '{') open.pop_back();
    if (c == '}') {
      while (!open.empty() && open.back() != '{') open.pop_back();
      if (open.empty()) return std::max(i, begin + 1);
      open.pop_back();
    }
    if (c == ';' && open.empty() && i >= position && i > begin) return i;
    if (c == '\n' && i > begin) {
      std::size_t next = next_word_line(i);
      if (ends_before(next, position, indent, open)) return i;
      i = next;
      continue;
    }
    ++i;
  }
  return text_.size();
}

}  // namespace garment::grammar
