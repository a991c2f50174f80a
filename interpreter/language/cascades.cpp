#include "interpreter/language/cascades.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

namespace garment::interpreter {
namespace {

using grammar::Diagnostic;
using grammar::Diagnostics;
using grammar::Sources;

bool is_error(const Diagnostic& d) { return d.severity == Severity::error; }
bool is_syntax(const Diagnostic& d) {
  return is_error(d) && (d.code.compare(0, 3, "G01") == 0 || d.code.compare(0, 3, "G02") == 0);
}

/// Mistakes after which it is not known which statements there are, or where they stand.
bool hides_statements(const Diagnostic& d) {
  constexpr std::string_view kInside[] = {"G0103", "G0104", "G0105", "G0106", "G0107", "G0206",
                                          "G0208", "G0213", "G0214", "G0215", "G0217"};
  return is_syntax(d) && std::find(std::begin(kInside), std::end(kInside), d.code) == std::end(kInside);
}

bool tells_a_name(const Diagnostic& d) {
  return d.code == "G0301" || d.code == "G0311" || d.code == "G1220" || d.code == "G1224";
}

/// A statement that is not put together as it must be, though its syntax is right.
bool tells_a_form(const Diagnostic& d) { return d.code == "G0312" || d.code == "G0313"; }

/// Line and source of the primary place; line 0 where there is none.
std::pair<grammar::SourceId, std::uint32_t> line_of(const Diagnostic& d, const Sources& sources) {
  if (d.labels.empty()) return {0, 0};
  const grammar::Span& span = d.labels[0].span;
  return {span.source, sources.place(span.source, span.begin).line};
}

bool near(const Diagnostic& a, const Diagnostic& b, const Sources& sources) {
  const auto [source_a, line_a] = line_of(a, sources);
  const auto [source_b, line_b] = line_of(b, sources);
  return source_a == source_b && line_a != 0 && line_b != 0 && line_a <= line_b + 1 && line_b <= line_a + 1;
}

/// A statement that may not stand where it is read, in a file with a mistake in its syntax.
bool misread(const Diagnostic& d, const Diagnostic& syntax) {
  return d.code == "G0322" && !syntax.labels.empty() &&
         std::any_of(d.labels.begin(), d.labels.end(), [&](const grammar::Label& label) {
           return label.span.source == syntax.labels[0].span.source;
         });
}

bool is_word_char(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// The line of the primary place of `d` holds `word`.
bool line_holds(const Diagnostic& d, std::string_view word, const Sources& sources) {
  if (d.labels.empty() || word.empty()) return false;
  const grammar::Span& span = d.labels[0].span;
  const std::string& text = sources[span.source].text;
  constexpr std::size_t kFar = 500;  // lines are short; one of a megabyte is not searched
  const std::size_t last = std::min(text.size(), span.begin + kFar);
  std::size_t begin = span.begin, end = span.begin;
  while (begin > 0 && span.begin - begin < kFar && text[begin - 1] != '\n') --begin;
  while (end < last && text[end] != '\n') ++end;
  const std::string_view line = std::string_view(text).substr(begin, end - begin);
  for (std::size_t at = line.find(word); at != std::string_view::npos; at = line.find(word, at + 1)) {
    const bool opens = at == 0 || !is_word_char(line[at - 1]);
    const bool ends = at + word.size() == line.size() || !is_word_char(line[at + word.size()]);
    if (opens && ends) return true;
  }
  return false;
}

/// The name that `d` does not know stands in the lines at a mistake of syntax, whole or as part of a longer word: what
/// should have declared it was misread. A library with such a mistake may have lost anything.
bool lost_in_syntax(const Diagnostic& d, const Diagnostic& syntax, const Sources& sources) {
  if (syntax.labels.empty() || !(is_syntax(syntax) || tells_a_form(syntax))) return false;
  if (is_syntax(syntax) && !d.labels.empty() && syntax.labels[0].span.source > d.labels[0].span.source) return true;
  const grammar::Span& span = syntax.labels[0].span;
  const std::string& text = sources[span.source].text;
  constexpr std::size_t kFar = 500;
  std::size_t begin = std::min<std::size_t>(span.begin, text.size()), end = begin;
  const auto goes_on = [&](std::size_t at, int& breaks) { return text[at] != '\n' || --breaks > 0; };
  for (int breaks = 2; begin > 0 && span.begin - begin < kFar && goes_on(begin - 1, breaks);) --begin;
  for (int breaks = 2; end < text.size() && end - span.begin < kFar && goes_on(end, breaks);) ++end;
  const std::string_view lines = std::string_view(text).substr(begin, end - begin);
  return std::any_of(d.labels.begin(), d.labels.end(), [&](const grammar::Label& label) {
    const std::string_view name = sources.text(label.span);
    return !name.empty() && lines.find(name) != std::string_view::npos;
  });
}

bool same_place(const Diagnostic& a, const Diagnostic& b) {
  return !a.labels.empty() && !b.labels.empty() && a.labels[0].span == b.labels[0].span;
}

/// The name that is not there, where the message says `there is nothing named` or `has no edge` and its like: the last in ticks.
std::string lost_name(const Diagnostic& d) {
  const std::size_t end = d.message.rfind('`');
  if (end == std::string::npos || end + 1 != d.message.size() || end == 0) return "";
  const std::size_t begin = d.message.rfind('`', end - 1);
  return begin == std::string::npos ? "" : d.message.substr(begin + 1, end - begin - 1);
}

/// `later` says what `earlier`, above it in the text, has said.
bool repeats(const Diagnostic& earlier, const Diagnostic& later) {
  if (!is_error(earlier) || !is_error(later) || later.code == "G0218") return false;  // that reading stopped is news
  return same_place(earlier, later) || (tells_a_name(later) && earlier.code == later.code && earlier.message == later.message) ||
         (tells_a_name(later) && tells_a_name(earlier) && !lost_name(later).empty() && lost_name(earlier) == lost_name(later));
}

/// A name with a value in it, `piece_{n}`, was not made: the source of `d` has one that begins like the name it misses.
bool may_be_made(const Diagnostic& d, const Sources& sources) {
  const std::string_view name = sources.text(d.labels[0].span);
  const std::string& text = sources[d.labels[0].span.source].text;
  for (std::size_t n = 1; n < name.size(); ++n)
    if (text.find(std::string(name.substr(0, n)) + '{') != std::string::npos) return true;
  return false;
}

/// The line of `other`, also an unknown name, was to declare what `d` misses: the name stands in it before the mistake.
bool was_to_declare(const Diagnostic& other, const Diagnostic& d, const Sources& sources) {
  const std::string_view name = sources.text(d.labels[0].span);
  if (d.labels[0].span.source != other.labels[0].span.source || !line_holds(other, name, sources)) return false;
  const std::string& text = sources[other.labels[0].span.source].text;
  const std::size_t at = text.rfind(name, other.labels[0].span.begin);
  if (at == std::string::npos || at + name.size() >= other.labels[0].span.begin) return false;
  return text.find('\n', at) > other.labels[0].span.begin;
}

/// Said in a block where an earlier mistake of syntax leaves open which statements are in it.
bool in_misread_block(const Diagnostic& d, const Diagnostic& syntax, const Sources& sources) {
  if (!is_syntax(syntax) || syntax.labels.empty()) return false;
  if (d.code == "G0320") return true;  // an assignment may be lost
  const grammar::Span &place = d.labels[0].span, &mistake = syntax.labels[0].span;
  const bool indented = sources.place(place.source, place.begin).column > 1;
  return tells_a_form(d) && indented && place.source == mistake.source && mistake.begin < place.begin;
}

/// The argument that another error does not know is asked for again, as a property: "part `x` has no `wide`".
bool is_unknown_argument(const Diagnostic& d, const Diagnostic& other) {
  if (d.code != "G1224" || other.code != "G0307") return false;
  const std::size_t at = d.message.rfind(" `");
  return at != std::string::npos && other.message.ends_with(d.message.substr(at));
}

/// An unknown name stands in the line of another error, here or where a library speaks of it; or the name of
/// a refused declaration stands in the line of `d`.
bool lost_its_declaration(const Diagnostic& d, const Diagnostics& all, const Sources& sources) {
  if (!is_error(d) || is_syntax(d) || d.labels.empty() || d.code == "G0302") return false;
  return std::any_of(all.begin(), all.end(), [&](const Diagnostic& other) {
    if (!is_error(other) || other.labels.empty()) return false;
    if (in_misread_block(d, other, sources) || is_unknown_argument(d, other)) return true;
    if (tells_a_name(other)) return &other != &d && tells_a_name(d) && !same_place(other, d) && was_to_declare(other, d, sources);
    if (tells_a_name(d) && (lost_in_syntax(d, other, sources) || (is_syntax(other) && may_be_made(d, sources)))) return true;
    if (other.code == "G0302" || (other.code == "G0303" && d.code != "G0303"))
      return line_holds(d, sources.text(other.labels[0].span), sources);
    return tells_a_name(d) && std::any_of(d.labels.begin(), d.labels.end(), [&](const grammar::Label& label) {
             return line_holds(other, sources.text(label.span), sources);
           });
  });
}

/// A change of something that a part was given, where another mistake may have taken that away.
bool acts_on_nothing(const Diagnostic& d, const Diagnostics& all) {
  return d.code == "G0433" && d.labels.size() > 1 &&
         std::any_of(all.begin(), all.end(), [&](const Diagnostic& other) { return is_error(other) && other.code != d.code; });
}

/// A value that cannot be tried because of a mistake that is told at its own place.
bool tells_of_another(const Diagnostic& d, const Diagnostics& all) {
  return d.code == "G1205" && std::any_of(all.begin(), all.end(), [&](const Diagnostic& other) {
           return is_error(other) && other.code != d.code && d.message.ends_with(other.message);
         });
}

/// What makes errors of one code one mistake: nothing more for assertions, which have one cause more often than several;
/// the panel for points beside it, the difference for seams. Nothing for other codes.
std::optional<std::string_view> kind_of_mistake(const Diagnostic& d) {
  const std::string_view message = d.message;
  const auto from = [&](std::string_view lead) -> std::optional<std::string_view> {
    const std::size_t at = message.find(lead);
    if (at == std::string_view::npos) return std::nullopt;
    const std::string_view rest = message.substr(at);
    return rest.substr(0, rest.find(" on the "));
  };
  if (!is_error(d) || d.labels.empty()) return std::nullopt;
  if (d.code == "G0320") return "";
  if (d.code == "G0613") return from(" lies outside");
  return d.code == "G0501" ? from("` is ") : std::nullopt;
}

/// The first of such errors shows the others.
void join_alike(Diagnostics& diagnostics) {
  Diagnostics joined;
  for (Diagnostic& d : diagnostics) {
    const auto kind = kind_of_mistake(d);
    const auto first = std::find_if(joined.begin(), joined.end(), [&](const Diagnostic& other) {
      return kind && other.code == d.code && kind_of_mistake(other) == kind;
    });
    if (first == joined.end())
      joined.push_back(std::move(d));
    else
      first->labels.push_back({d.labels[0].span, d.code == "G0320" ? "nor this: " + d.labels[0].text : "the same here"});
  }
  diagnostics = std::move(joined);
}

/// A figure that goes wrong below an assertion that does not hold: the assertion says why.
bool is_asserted(const Diagnostic& d, const Diagnostics& all) {
  constexpr std::string_view kFigures[] = {"G0309", "G0346", "G0402", "G0403", "G0407", "G0408", "G0413", "G0501"};
  if (d.labels.empty() || std::find(std::begin(kFigures), std::end(kFigures), d.code) == std::end(kFigures)) return false;
  return std::any_of(all.begin(), all.end(), [&](const Diagnostic& other) {
    return is_error(other) && other.code == "G0320" && !other.labels.empty() &&
           other.labels[0].span.source == d.labels[0].span.source && other.labels[0].span.begin < d.labels[0].span.begin;
  });
}

}  // namespace

void drop_cascades(Diagnostics& diagnostics, const Sources& sources) {
  const Diagnostics all = diagnostics;
  const bool hidden = std::any_of(all.begin(), all.end(), hides_statements);
  const auto follows_syntax = [&](const Diagnostic& d) {
    if (is_syntax(d)) return false;
    if (hidden) return true;
    return is_error(d) && std::any_of(all.begin(), all.end(), [&](const Diagnostic& other) {
             return is_syntax(other) && (near(d, other, sources) || misread(d, other));
           });
  };
  diagnostics.clear();
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool repeated = std::any_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(k),
                                      [&](const Diagnostic& earlier) { return repeats(earlier, all[k]); });
    if (!follows_syntax(all[k]) && !repeated && !tells_of_another(all[k], all) && !acts_on_nothing(all[k], all) && !is_asserted(all[k], all) &&
        !lost_its_declaration(all[k], all, sources))
      diagnostics.push_back(all[k]);
  }
  join_alike(diagnostics);
}

}  // namespace garment::interpreter
