// Canonical layout: line ends stay where they were, blanks and indents are made anew. A block is on one line
// or has its braces at line ends, so that each statement in it begins at the indent of its block and none
// becomes the next line of another.
#include <algorithm>
#include <string>

#include "grammar/layout_tokens.hpp"

namespace garment::grammar {
namespace {

constexpr int kIndent = 2;

bool is_operator_word(std::string_view word) {
  return word == "and" || word == "or" || word == "minus" || word == "not" || word == "is" || word == "if" ||
         word == "else";
}

class Layout {
 public:
  explicit Layout(const std::vector<LayoutToken>& tokens) : tokens_(tokens) {}

  std::string run() {
    for (i_ = 0; i_ < tokens_.size(); ++i_) {
      const LayoutToken& token = tokens_[i_];
      prefix_ = is_prefix();
      int lines = lines_before();
      if (i_ > 0 && lines == 0)
        out_ += blanks_before();
      else
        begin_line(lines);
      out_ += token.text;
      count(token);
      after_prefix_ = prefix_;
      after_operand_ = ends_operand(token);
    }
    if (!out_.empty()) out_ += '\n';
    return std::move(out_);
  }

 private:
  const LayoutToken* previous() const { return i_ > 0 ? &tokens_[i_ - 1] : nullptr; }

  bool ends_operand(const LayoutToken& token) const {
    if (token.kind == TokenKind::comment) return after_operand_;
    if (token.kind == TokenKind::sign) return token.text == ")" || token.text == "]" || token.text == "}";
    bool is_member = i_ > 0 && previous()->text == ".";
    if (token.begins_statement) return false;
    return token.kind != TokenKind::word || is_member || !is_operator_word(token.text);
  }

  /// A sign that belongs to the value after it; where a value stands before it too, the blanks of the source
  /// decide.
  bool is_prefix() const {
    const LayoutToken& token = tokens_[i_];
    if (token.kind != TokenKind::sign || (token.text != "+" && token.text != "-")) return false;
    if (!after_operand_) return true;
    return brackets_ == 0 && token.blank_before && !token.blank_after;
  }

  int lines_before() const {
    const LayoutToken& token = tokens_[i_];
    const LayoutToken* before = previous();
    if (!before) return 0;
    bool is_else = token.kind == TokenKind::word && token.text == "else" && before->text == "}";
    if (is_else) return 0;
    bool is_trailing = token.kind == TokenKind::comment && token.lines_before == 0;
    bool must_break =
        !is_trailing && (before->opens_block || token.closes_block || before->kind == TokenKind::comment);
    // A statement's own next lines must be deeper than the line on which it begins.
    if (token.begins_statement && before->text == ";" && line_continues_ && braces_ == 0) must_break = true;
    int lines = std::min(token.lines_before, 2);
    if (before->opens_block || token.closes_block) lines = std::min(lines, 1);
    return std::max(lines, must_break ? 1 : 0);
  }

  void begin_line(int lines) {
    out_.append(static_cast<std::size_t>(lines), '\n');
    // A comment on its own line stands where the token after it does.
    std::size_t next = i_;
    while (next < tokens_.size() && tokens_[next].kind == TokenKind::comment) ++next;
    bool at_end = next == tokens_.size();
    bool is_comment = next != i_;
    const LayoutToken* leading = at_end ? nullptr : &tokens_[next];
    int depth = blocks_;
    if (leading && leading->closes_block && !is_comment)
      --depth;
    else if (leading && !leading->begins_statement && !leading->closes_block && leading->text != ";" &&
             leading->text != "else")
      depth += continuation_depth(*leading);
    line_continues_ = depth > blocks_;
    out_.append(static_cast<std::size_t>(kIndent * depth), ' ');
  }

  int continuation_depth(const LayoutToken& leading) const {
    bool closes = leading.text == ")" || leading.text == "]" || leading.text == "}";
    return closes ? std::max(brackets_ + braces_ - 1, 0) : std::max(brackets_ + braces_, 1);
  }

  void count(const LayoutToken& token) {
    if (token.kind != TokenKind::sign) return;
    int& braces = token.opens_block || token.closes_block ? blocks_ : braces_;
    if (token.text == "(" || token.text == "[") ++brackets_;
    if (token.text == ")" || token.text == "]") --brackets_;
    if (token.text == "{") ++braces;
    if (token.text == "}") --braces;
  }

  std::string_view blanks_before() const {
    const LayoutToken& token = tokens_[i_];
    if (token.kind == TokenKind::comment) return "  ";
    return is_tight(*previous(), token) ? "" : " ";
  }

  bool is_tight(const LayoutToken& before, const LayoutToken& token) const {
    std::string_view a = before.text, b = token.text;
    bool sign_before = before.kind == TokenKind::sign, sign_now = token.kind == TokenKind::sign;
    if (token.kind == TokenKind::unit) return b == "%";
    if (sign_now && (b == "," || b == ";" || b == ")" || b == "]" || b == ":" || b == ".")) return true;
    if (sign_before && (a == "(" || a == "[" || a == ".")) return true;
    if (after_prefix_) return true;
    if (sign_before && a == "^" && !power_is_spaced()) return true;
    if (sign_now && (b == "(" || b == "[")) return after_operand_ && !token.blank_before;
    if (sign_before && sign_now && a == "{" && b == "}") return true;
    return sign_now && b == "^" && before.kind != TokenKind::unit;
  }

  /// After a unit `^` keeps its blanks: 5 cm^2 is a unit, 5 cm ^ 2 a power.
  bool power_is_spaced() const { return i_ > 1 && tokens_[i_ - 2].kind == TokenKind::unit; }

  const std::vector<LayoutToken>& tokens_;
  std::size_t i_ = 0;
  int blocks_ = 0;               // open braces of blocks over several lines
  int braces_ = 0;               // other open braces
  int brackets_ = 0;             // open ( and [
  bool line_continues_ = false;  // the line began inside a statement
  bool prefix_ = false, after_prefix_ = false, after_operand_ = false;
  std::string out_;
};

}  // namespace

FormatResult format(const Sources& sources, SourceId id, const Vocabulary& vocabulary) {
  const std::string& text = sources[id].text;
  ParseResult parsed = parse(sources, id, vocabulary);
  if (!parsed.diagnostics.empty()) return {text, std::move(parsed.diagnostics)};
  LayoutRoles roles = layout_roles(parsed.script, text);
  return {Layout(layout_tokens(text, roles)).run(), {}};
}

}  // namespace garment::grammar
