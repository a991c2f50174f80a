// Where reading goes on after a mistake: at the end of the broken statement, so that one mistake gives one
// message.
#include <algorithm>

#include "grammar/parse_state.hpp"
#include "grammar/text.hpp"

namespace garment::grammar {

/// `next` is the first word after a line end inside the broken statement. `open` are the brackets open there;
/// the statement's own block is `skipped`: its { comes after the mistake.
bool ParseState::ends_before(std::size_t next, std::size_t position, int indent, bool open,
                             bool skipped) const {
  if (next >= text_.size()) return true;
  bool deeper = indent_of(next) > indent;
  if (skipped) return !deeper && statement_begins(next);
  if (!deeper && assignment_begins(next)) return true;
  if (next < position) return false;
  if (statement_begins(next)) return true;
  char c = text_[next];
  bool closes = c == ')' || c == ']' || c == '}';
  if (!deeper) return !closes || !open;
  return !open && (keywords_.match(text_, next).keyword || assignment_begins(next));
}

std::size_t ParseState::resume(std::size_t begin, std::size_t position) const {
  std::vector<std::size_t> open;  // offsets of brackets
  const int indent = indent_of(begin);
  std::size_t n_braces = 0, n_skipped = 0;  // { among them, and { behind the mistake
  auto in_brace = [&] { return !open.empty() && text_[open.back()] == '{'; };
  auto close = [&] {
    if (in_brace()) --n_braces;
    if (in_brace() && open.back() >= position) --n_skipped;
    open.pop_back();
  };
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
    if (c == '(' || c == '[' || c == '{') open.push_back(i);
    if (c == '{') ++n_braces;
    if (c == '{' && i >= position) ++n_skipped;
    if ((c == ')' || c == ']') && !open.empty() && !in_brace()) close();
    if (c == '}') {
      while (!open.empty() && !in_brace()) close();
      if (open.empty()) return std::max(i, begin + 1);
      close();
    }
    if (c == ';' && open.empty() && i >= position && i > begin) return i;
    if (c == '\n' && i > begin) {
      std::size_t next = next_word_line(i);
      bool whole = n_braces > 0 && next < position;  // in a block that was read before the mistake
      if (!whole && ends_before(next, position, indent, !open.empty(), n_skipped > 0)) return i;
      i = next;
      continue;
    }
    ++i;
  }
  return text_.size();
}

}  // namespace garment::grammar
