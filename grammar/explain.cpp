// The words for every mistake: what was found, what was expected, and the remedy.
#include <fmt/format.h>

#include <array>

#include "grammar/parse_state.hpp"
#include "grammar/text.hpp"

namespace garment::grammar {
namespace {

constexpr std::string_view kSigns = "()[]{},;:=+-*/^<>.\"#%_\n";

bool is_known(char c) { return is_word_char(c) || is_blank(c) || kSigns.find(c) != std::string_view::npos; }

struct Lookalike {
  std::uint32_t code;
  std::string_view help;
};

constexpr std::array<Lookalike, 16> kLookalikes = {
    {{0x201C, "a string stands in straight quotes: \"text\""},
     {0x201D, "a string stands in straight quotes: \"text\""},
     {0x201E, "a string stands in straight quotes: \"text\""},
     {0x2018, "a string stands in straight quotes: \"text\""},
     {0x2019, "a string stands in straight quotes: \"text\""},
     {'\'', "a string stands in double quotes: \"text\""},
     {0x2013, "the minus sign is `-`"},
     {0x2014, "the minus sign is `-`"},
     {0x2212, "the minus sign is `-`"},
     {0xD7, "to multiply, write `*`"},
     {0xF7, "to divide, write `/`"},
     {0xB0, "an angle is written `45 deg`"},
     {0xA0, "a non-breaking blank: type an ordinary blank"},
     {'!', "a condition is turned round by `not`; `!=` compares"},
     {'&', "two conditions are joined by `and`"},
     {'|', "two conditions are joined by `or`"}}};

/// Source text as a message shows it: a mistake may be a megabyte long.
std::string shorten(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  return text.size() <= kLongest ? std::string(text) : std::string(text.substr(0, kLongest)) + "...";
}

std::string join(const std::vector<std::string>& parts) {
  std::string out;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) out += i + 1 == parts.size() ? " or " : ", ";
    out += parts[i];
  }
  return out;
}

SyntaxError error_at(Span span, std::string_view code, std::string message, std::string label,
                     std::string help = "") {
  SyntaxError error;
  error.diagnostic = {
      std::string(code), Severity::error, std::move(message), {{span, std::move(label)}}, std::move(help)};
  error.position = span.begin;
  return error;
}

}  // namespace

Span ParseState::found_span(std::size_t at) const {
  if (at >= text_.size() || text_[at] == '\n') return span(at, at);
  if (text_[at] == '"') return span(at, end_of_string(text_, at));
  std::size_t end = at;
  while (end < text_.size() && is_word_char(text_[end])) ++end;
  if (end == at) end += decode_utf8(text_, at).length;
  if (end == at + 1 && end < text_.size() && text_[end] == text_[at] && text_[at] == '.') ++end;
  return span(at, end);
}

std::string ParseState::found(std::size_t at) const {
  if (at >= text_.size()) return "the end of the text";
  char c = text_[at];
  if (c == '\n' || c == '#') return "the end of the line";
  if (c == '"') return "a string";
  Span token = found_span(at);
  std::string_view text = text_.substr(token.begin, token.end - token.begin);
  return fmt::format("{}`{}`", is_digit(c) ? "the number " : "", shorten(text));
}

void ParseState::fail(const Problem& problem, std::size_t at) const {
  bool in_text = problem.kind == ProblemKind::quote;
  while (!in_text && is_blank(this->at(at))) ++at;
  bool known = at >= text_.size() || is_known(text_[at]);
  if (!known && !in_text) throw unknown_character(at);
  switch (problem.kind) {
    case ProblemKind::value:
      throw missing_value(problem, at);
    case ProblemKind::closing:
      throw unclosed(problem, at);
    case ProblemKind::statement:
      throw unknown_statement(at);
    case ProblemKind::leftover:
      throw leftover(at);
    case ProblemKind::quote: {
      const Opener& string = expressions_.openers().back();
      if (problem.code == "G0103")
        throw error_at(span(string.span.begin, at), "G0103", "the string is not closed", "begins here",
                       "add a `\"` at its end; a quotation mark inside a string is written \\\"");
      std::size_t end = at < text_.size() && text_[at] != '\n' ? at + decode_utf8(text_, at).length : at;
      throw error_at(span(at - 1, end), "G0104",
                     fmt::format("`{}` is no escape", text_.substr(at - 1, end - at + 1)), "unknown",
                     "a string knows \\\" \\\\ \\n and \\{; a backslash is written \\\\");
    }
    case ProblemKind::number:
      if (is_word_start(this->at(at)) && at > 0 && is_word_char(text_[at - 1])) throw unknown_unit(at, at);
      if (this->at(at) == '.')
        throw error_at(found_span(at), problem.code, "a point at the end of a number", "unexpected",
                       "a number has digits on both sides of its point; a range is written `0 .. 1`");
      throw error_at(found_span(at), problem.code, fmt::format("the number runs into {}", found(at)),
                     "unexpected", "put an operator or a blank between them");
    case ProblemKind::missing:
      break;
  }
  SyntaxError error = error_at(found_span(at), problem.code,
                               fmt::format("expected {}, found {}", problem.expected, found(at)),
                               "expected here", std::string(problem.help));
  error.incomplete = at >= text_.size();
  throw error;
}

SyntaxError ParseState::unknown_character(std::size_t at) const {
  Character c = decode_utf8(text_, at);
  std::string shown = is_control(c.code) ? escape_character(c.code) : std::string(text_.substr(at, c.length));
  std::string help = "letters beyond a-z, and other signs, stand only in strings and comments";
  for (const Lookalike& lookalike : kLookalikes)
    if (lookalike.code == c.code) help = lookalike.help;
  return error_at(span(at, at + c.length), "G0102", fmt::format("unknown character `{}`", shown), "here",
                  help);
}

SyntaxError ParseState::missing_value(const Problem& problem, std::size_t at) const {
  std::string_view sign = text_.substr(expecting_.begin, expecting_.end - expecting_.begin);
  std::string message = fmt::format("expected {} after `{}`, found {}", problem.expected, sign, found(at));
  std::string help;
  if (this->at(at) == '.' && is_digit(this->at(at + 1))) help = "write the digit before the point: 0.5";
  if (clause_word(at) > 0) help = fmt::format("`{}` begins a clause here", shorten(word_at(text_, at)));
  bool is_elsewhere = at >= text_.size() || text_[at] == '\n' || text_[at] == '#' || first_on_line(at);
  if (is_elsewhere && first_on_line(at) && statement_begins(at))
    message = fmt::format("expected {} after `{}`, but the next line begins a new statement",
                          problem.expected, sign);
  SyntaxError error = error_at(is_elsewhere ? expecting_ : found_span(at), problem.code, message,
                               is_elsewhere ? "nothing follows" : "expected a value", help);
  error.position = static_cast<std::uint32_t>(at);
  error.incomplete = at >= text_.size();
  return error;
}

SyntaxError ParseState::unknown_unit(std::size_t number_end, std::size_t at) const {
  std::string_view word = word_at(text_, at);
  std::string meant = keywords_.suggest_unit(word);
  std::string help =
      meant.empty() ? "to multiply, write the sign: 2 * width" : fmt::format("did you mean `{}`?", meant);
  std::size_t begin = number_end;
  while (begin > 0 && (is_word_char(text_[begin - 1]) || text_[begin - 1] == '.')) --begin;
  SyntaxError error = error_at(span(at, at + word.size()), "G0105",
                               fmt::format("unknown unit `{}`", shorten(word)), "", help);
  error.diagnostic.labels[0].text =
      fmt::format("after the number {}", shorten(text_.substr(begin, number_end - begin)));
  return error;
}

SyntaxError ParseState::unclosed(const Problem& problem, std::size_t at) const {
  std::size_t before = at;
  while (before > 0 && is_blank(text_[before - 1])) --before;
  std::size_t word = before;
  while (word > 0 && (is_word_char(text_[word - 1]) || text_[word - 1] == '.')) --word;
  const std::vector<Opener>& openers = expressions_.openers();
  const Opener& opener = openers.back();
  bool is_entry = problem.code == "G0216" && is_word_start(this->at(at));
  bool follows_number = word < before && is_digit(text_[word]);
  if (follows_number && !is_entry && is_word_start(this->at(at))) return unknown_unit(before, at);

  bool at_end = at >= text_.size();
  bool ends_string = this->at(at) == '"' && openers.size() > 1 && openers[openers.size() - 2].sign == '"';
  if (at_end || text_[at] == '\n' || ends_string || statement_begins(at)) {
    std::string message = fmt::format("`{}` is not closed", opener.sign);
    if (!at_end) message += ": expected " + std::string(problem.expected);
    SyntaxError error = error_at(opener.span, "G0203", message, "opened here");
    error.position = static_cast<std::uint32_t>(at);
    error.incomplete = at_end;
    return error;
  }
  std::string_view expected = this->at(at) == ',' ? "a value" : problem.expected;
  SyntaxError error = error_at(found_span(at), is_entry ? "G0216" : "G0203",
                               fmt::format("expected {}, found {}", expected, found(at)), "unexpected");
  error.diagnostic.labels.push_back({opener.span, "opened here"});
  if (is_entry) error.diagnostic.help = "write `key = value`, with commas or line ends between the entries";
  if (this->at(at) == '=' && this->at(at + 1) != '=')
    error.diagnostic.help = "`==` compares; a named argument is written `key: value`";
  return error;
}

SyntaxError ParseState::unknown_statement(std::size_t at) const {
  char c = this->at(at);
  if (c == ')' || c == ']')
    return error_at(found_span(at), "G0205", fmt::format("`{}` closes nothing", c), "one too many",
                    "remove it");
  if (c == '\n')
    return error_at(found_span(at), "G0202", "expected a statement after `both`, found the end of the line",
                    "expected here");
  std::string_view word = word_at(text_, at);
  if (c == '{')
    return error_at(found_span(at), "G0202", "a statement cannot begin with `{`",
                    "expected a keyword or a name", "the `{` of a block stands on the line of its keyword");
  if (c == '/' && (this->at(at + 1) == '/' || this->at(at + 1) == '*'))
    return error_at(found_span(at), "G0202", fmt::format("a statement cannot begin with {}", found(at)),
                    "expected a keyword or a name", "a comment begins with `#`");
  if (word.empty())
    return error_at(
        found_span(at), "G0202", fmt::format("a statement cannot begin with {}", found(at)),
        "expected a keyword or a name",
        "a statement goes on in the next line only after an operator or comma, inside ( or [, or indented "
        "before a clause word");
  if (word == "else")
    return error_at(found_span(at), "G0202", "`else` without an `if` before it", "unexpected",
                    "`else` follows the `}` of an `if`");
  if (const Keyword* keyword = keywords_.match(text_, at).keyword) {
    const std::string& name = keyword->info->keyword;
    std::string here = statements_.empty() ? "at the top level" : "here";
    for (const Open& open : statements_)
      if (open.in_block && open.keyword) here = fmt::format("inside `{}`", open.keyword->info->keyword);
    std::vector<std::string> places = keywords_.places_of(name);
    std::string help = places.empty() ? "" : fmt::format("its place is {}", join(places));
    return error_at(found_span(at), "G0209", fmt::format("`{}` cannot stand {}", name, here), "wrong place",
                    help);
  }
  std::size_t end = at;
  while (is_word_char(this->at(end)) || (this->at(end) == '.' && is_word_start(this->at(end + 1)))) ++end;
  if (end > at + word.size())
    return error_at(span(at, end), "G0202",
                    fmt::format("`{}` alone is no statement", shorten(text_.substr(at, end - at))),
                    "expected `=` after it", "to set a value: name = value");
  std::string meant = keywords_.suggest_keyword(word, allowed_words());
  std::string help = meant.empty() ? "a statement begins with a keyword, or sets a value: name = value"
                                   : fmt::format("did you mean `{}`?", meant);
  if (this->at(end) == '{') help = "before the `{` of a block stands a blank";
  return error_at(found_span(at), "G0201", fmt::format("unknown statement `{}`", shorten(word)),
                  "unknown keyword", help);
}

SyntaxError ParseState::leftover(std::size_t at) const {
  char c = this->at(at);
  if (c == ')' || c == ']')
    return error_at(found_span(at), "G0205", fmt::format("`{}` closes nothing", c), "one too many",
                    "remove it");
  std::string keyword = statements_.empty() ? "" : statements_.back().statement.keyword.text;
  if (c == '{' && !statements_.empty() && !statements_.back().statement.body)
    return error_at(
        found_span(at), "G0211",
        keyword == "=" ? "an assignment takes no block" : fmt::format("`{}` takes no block", keyword),
        "unexpected", "a record stands directly after `=` or `with`");
  bool is_statement = !statements_.empty();
  SyntaxError error = error_at(found_span(at), "G0208",
                               fmt::format("expected the end of the {}, found {}",
                                           is_statement ? "statement" : "expression", found(at)),
                               "left over");
  std::string& help = error.diagnostic.help;
  if (c == '=') help = "`==` compares; `=` stands after the name that it sets";
  if (c == '+' || c == '-') help = fmt::format("`a {0}b` is two values; a sum or difference is `a {0} b`", c);
  if (c == ',') help = "a comma stands between two values";
  if (c == '.' && is_digit(this->at(at + 1))) help = "write the digit before the point: 0.5";
  bool after_block = is_statement && statements_.back().statement.body.has_value();
  if (after_block) help = "the next statement begins on a new line or after `;`";
  return error;
}

}  // namespace garment::grammar
