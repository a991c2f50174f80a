// Which mistakes only follow from an earlier one. One slip is told once: where brackets or blocks no longer
// match, what stands below is misread until a statement of the top level begins anew.
#include <algorithm>

#include "grammar/parse_state.hpp"
#include "grammar/text.hpp"

namespace garment::grammar {
namespace {

bool is_brace(char c) { return c == '{' || c == '}'; }

}  // namespace

bool ParseState::only_blanks_since_broken(std::size_t at) const {
  if (broken_end_ == 0 || at < broken_end_) return false;
  return std::all_of(text_.begin() + static_cast<std::ptrdiff_t>(broken_end_),
                     text_.begin() + static_cast<std::ptrdiff_t>(std::min(at, text_.size())),
                     [](char c) { return is_blank(c) || c == '\n' || c == ';'; });
}

bool ParseState::follows_from_earlier(const SyntaxError& error) const {
  const Diagnostic& d = error.diagnostic;
  if (diagnostics_.empty() || error.fatal || d.labels.empty()) return false;
  if (lost_) return true;
  const std::size_t place = d.labels[0].span.begin;
  const auto stands_at = [&](const Diagnostic& old) {
    return !old.labels.empty() && (old.labels[0].span.begin == place);
  };
  if (std::any_of(diagnostics_.begin(), diagnostics_.end(), stands_at)) return true;
  // One line, one slip: what follows a mistake is read on as well as may be, up to a `;`.
  const auto in_line = [&](const Label& old) {
    if (old.span.begin > place || line_of(old.span.begin) != line_of(place)) return false;
    return text_.substr(old.span.begin, place - old.span.begin).find(';') == std::string_view::npos;
  };
  // What ends a line by mistake may belong to the next one, which is misread then.
  const auto ends_line_before = [&](const Label& old) {
    if (line_of(old.span.begin) + 1 != line_of(place)) return false;
    std::size_t end = old.span.end;
    while (end < text_.size() && is_blank(text_[end])) ++end;
    return end >= text_.size() || text_[end] == '\n';
  };
  const auto covers = [&](const Diagnostic& old) {
    const std::size_t n = old.code == "G0204" ? old.labels.size() : std::min<std::size_t>(1, old.labels.size());
    return std::any_of(old.labels.begin(), old.labels.begin() + static_cast<std::ptrdiff_t>(n), in_line) ||
           (old.code != "G0206" && n > 0 && ends_line_before(old.labels[0]));
  };
  if (std::any_of(diagnostics_.begin(), diagnostics_.end(), covers)) return true;
  // A block whose { is missing has its } all the same.
  const auto lacks_brace = [](const Diagnostic& old) { return old.code == "G0212"; };
  if (d.code == "G0205" && at(place) == '}' && std::any_of(diagnostics_.begin(), diagnostics_.end(), lacks_brace)) return true;
  if (d.code == "G0205") return fresh_;
  if ((d.code == "G0208" || d.code == "G0209") && statements_.empty() && indent_of(place) > 0) return fresh_;
  if (d.code == "G0202") return !is_word_start(at(place)) && only_blanks_since_broken(place);
  // A block with a mistake inside: its } may be what was mistaken.
  if (d.code == "G0204")
    return std::any_of(diagnostics_.begin(), diagnostics_.end(), [&](const Diagnostic& old) {
      return !old.labels.empty() && old.labels[0].span.begin >= place;
    });
  return false;
}

void ParseState::lose_nesting(std::size_t line) {
  lost_ = true;
  lost_line_ = line;
}

void ParseState::judge_nesting(const SyntaxError& error, std::size_t begin, std::size_t end,
                               bool block_expected) {
  int open = 0;
  bool unbalanced = false, any = false;
  for (std::size_t i = begin; i < end;) {
    if (text_[i] == '"') {
      i = end_of_string(text_, i);
      continue;
    }
    if (text_[i] == '#') {
      i = std::min(text_.find('\n', i), end);
      continue;
    }
    if (text_[i] == '{') ++open, any = true;
    if (text_[i] == '}' && --open < 0) unbalanced = true;
    ++i;
  }
  const bool misplaced = error.diagnostic.code == "G0209";
  const bool stray = statements_.empty() && indent_of(begin) > 0;
  // A } in the middle of a line closes more than its writer meant.
  std::size_t before = error.position;
  while (before > begin && is_blank(text_[before - 1])) --before;
  const bool closed_early = error.diagnostic.code == "G0208" && before > begin && text_[before - 1] == '}' &&
                            (!first_on_line(before - 1) || keywords_.match(text_, error.position).keyword == nullptr);
  if (unbalanced || open != 0 || misplaced || stray || closed_early || is_brace(at(error.position)) ||
      (block_expected && !any))
    lose_nesting(line_of(std::max<std::size_t>(error.position, begin)));
}

void ParseState::find_footing(std::size_t at) {
  if (lost_ && statements_.empty() && first_on_line(at) && indent_of(at) == 0 && line_of(at) > lost_line_)
    lost_ = false;
}

}  // namespace garment::grammar
