#include "interpreter/service/context.hpp"

#include <algorithm>

#include "interpreter/language/construct_table.hpp"
#include "interpreter/service/symbols.hpp"

namespace garment::service {
namespace {

using interpreter::ConstructRecord;
using interpreter::find_clause;
using interpreter::find_construct;

bool asks_for_value(const Token& token, std::string_view word) {
  if (token.kind == TokenKind::sign)
    return is_any(word, {",", "+", "-", "*", "/", "^", "=", ":", "..", "==", "!=", "<", ">", "<=", ">=", ".",
                         "(", "["});
  return token.kind == TokenKind::word && is_any(word, {"and", "or", "not", "minus", "is"});
}

/// Reads tokens up to the place and knows at each what is open.
class Reader {
 public:
  Reader(std::string_view text, std::vector<Token> tokens) : text_(text), tokens_(std::move(tokens)) {
    frames_.push_back({});
  }

  Context read(std::uint32_t offset) {
    std::size_t k = 0;
    for (; k < tokens_.size() && tokens_[k].end < offset; ++k) take(k);
    if (k < tokens_.size() && tokens_[k].end == offset && !is_open_word(tokens_[k])) take(k++);
    return here(k, offset);
  }

 private:
  struct Frame {
    OpenBlock block;
    std::string loop_variable;  ///< of the `for` whose block this is
    bool open_statement = false, both = false, wants_name = false, second_word = false;
    int indent = 0;
    std::string keyword, name, target, clause;
    std::vector<std::string> clauses;
    const ConstructRecord* record = nullptr;
    int values = 0;
    std::vector<OpenBracket> open;
  };

  std::string_view word(std::size_t k) const { return text_of(text_, tokens_[k]); }
  Frame& frame() { return frames_.back(); }

  /// A word that the place touches belongs to what is being typed.
  static bool is_open_word(const Token& token) {
    return token.kind == TokenKind::word || token.kind == TokenKind::comment || token.kind == TokenKind::unit;
  }

  bool touches(std::size_t k) const {
    return k > 0 && last_ < tokens_.size() && tokens_[last_].end == tokens_[k].begin;
  }

  /// A statement's first token: first in its block, or on a new line that does not go on with the one above.
  bool begins(bool first_on_line, int indent, std::string_view text) const {
    const Frame& f = frames_.back();
    if (!f.open_statement) return true;
    if (!first_on_line || !f.open.empty()) return false;
    if (after_operator_ && !(find_construct(text) != nullptr && indent <= f.indent)) return false;
    return !(indent > f.indent && f.record != nullptr && find_clause(*f.record, text) != nullptr);
  }

  void begin_statement(std::size_t k) {
    Frame& f = frame();
    end_statement();
    f.open_statement = true;
    f.indent = tokens_[k].indent;
  }

  void take(std::size_t k) {
    const Token& token = tokens_[k];
    if (token.kind == TokenKind::comment) return;
    const std::string_view text = word(k);
    if (text == ";" && frame().open.empty()) {
      end_statement();
    } else if (text == "}") {
      close_brace();
    } else {
      if (begins(token.first_on_line, token.indent, text)) begin_statement(k);
      take_inside(k, text);
    }
    after_operator_ = asks_for_value(token, text);
    last_ = k;
  }

  void end_statement() {
    Frame fresh;
    fresh.block = frame().block;
    fresh.loop_variable = frame().loop_variable;
    frame() = std::move(fresh);
  }

  void close_brace() {
    Frame& f = frame();
    while (!f.open.empty() && f.open.back().sign != '{') f.open.pop_back();
    if (!f.open.empty()) {
      f.open.pop_back();
      return;
    }
    if (frames_.size() > 1) frames_.pop_back();
    end_statement();
  }

  void take_inside(std::size_t k, std::string_view text) {
    Frame& f = frame();
    const Token& token = tokens_[k];
    if (token.kind == TokenKind::sign && (text == "(" || text == "[")) return open_bracket(k, text[0]);
    if (text == "{") return open_brace(k);
    if (token.kind == TokenKind::sign && (text == ")" || text == "]")) {
      if (!f.open.empty() && f.open.back().sign != '{') f.open.pop_back();
      if (f.open.empty()) ++f.values;
      return;
    }
    if (!f.open.empty()) return take_in_bracket(k, text);
    take_plain(k, text);
  }

  void open_bracket(std::size_t k, char sign) {
    OpenBracket bracket;
    bracket.sign = sign;
    bracket.begin = tokens_[k].begin;
    if (touches(k)) bracket.callee = chain_before(k);
    frame().open.push_back(bracket);
  }

  void open_brace(std::size_t k) {
    const std::string_view before = last_ < tokens_.size() ? word(last_) : std::string_view();
    Frame& f = frame();
    const bool hole =
        touches(k) && tokens_[last_].kind == TokenKind::word && before != "with" && before != "else";
    if (hole || before == "with" || before == "=" || !f.open.empty()) {
      OpenBracket bracket;
      bracket.sign = '{';
      bracket.begin = tokens_[k].begin;
      if (before == "with" && last_ > 0) bracket.callee = chain_before(last_);
      f.open.push_back(bracket);
      return;
    }
    Frame inner;
    const bool transparent = is_any(f.keyword, {"if", "for", "else", ""});
    inner.block = transparent ? f.block : OpenBlock{f.keyword, f.name};
    if (f.keyword == "outline" || f.keyword == "hole")
      inner.block.name = f.name.empty() ? f.block.name : f.name;
    if (f.keyword == "for") inner.loop_variable = f.name;
    frames_.push_back(std::move(inner));
  }

  void take_in_bracket(std::size_t k, std::string_view text) {
    OpenBracket& b = frame().open.back();
    const bool record = b.sign == '{';
    const bool next_entry =
        text == "," || (record && tokens_[k].first_on_line && b.in_value && !after_operator_);
    if (next_entry) {
      ++b.commas;
      b.in_value = false;
      b.label.clear();
      if (text == ",") return;
    }
    if ((text == ":" || (record && text == "=")) && last_ < tokens_.size() && b.label.empty()) {
      b.label = std::string(word(last_));
      b.labels.push_back(b.label);
      b.in_value = false;
      return;
    }
    b.in_value = true;
  }

  void take_plain(std::size_t k, std::string_view text) {
    Frame& f = frame();
    if (f.keyword.empty() && f.target.empty()) return take_first(k, text);
    if (f.second_word) {
      f.second_word = false;
      f.wants_name = f.record->declares_name;
      return;
    }
    if (f.wants_name && tokens_[k].kind == TokenKind::word) {
      f.wants_name = false;
      f.name = std::string(text);
      return;
    }
    const bool own = last_ < tokens_.size() && word(last_) == ".";
    if (f.record != nullptr && !own && (tokens_[k].kind == TokenKind::word || text == ":" || text == "=") &&
        find_clause(*f.record, text) != nullptr && !follows_touching(k)) {
      f.clause = std::string(text);
      f.clauses.push_back(f.clause);
      f.values = 0;
      return;
    }
    if (f.record == nullptr && (text == "=" || text == "in")) {
      f.clause = std::string(text);
      f.values = 0;
      return;
    }
    if (tokens_[k].kind != TokenKind::sign && tokens_[k].kind != TokenKind::unit && !own && !after_operator_)
      ++f.values;
    if (tokens_[k].kind != TokenKind::sign && f.values == 0) f.values = 1;
  }

  /// A word that touches `.`, `(` or `[` is part of a value and no clause word.
  bool follows_touching(std::size_t k) const {
    return tokens_[k].kind == TokenKind::word && k + 1 < tokens_.size() &&
           tokens_[k + 1].begin == tokens_[k].end && is_any(word(k + 1), {".", "(", "["});
  }

  void take_first(std::size_t k, std::string_view text) {
    Frame& f = frame();
    if (tokens_[k].kind != TokenKind::word) return;
    if (k + 1 < tokens_.size())  // `pair panel`
      if (const std::string two = std::string(text) + ' ' + std::string(word(k + 1));
          find_construct(two) != nullptr) {
        f.keyword = two;
        f.record = find_construct(two);
        f.second_word = true;
        return;
      }
    if (text == "both") {
      f.both = true;
      return;
    }
    const bool touched =
        k + 1 < tokens_.size() && tokens_[k + 1].begin == tokens_[k].end && word(k + 1) == ".";
    const bool assigned = k + 1 < tokens_.size() && word(k + 1) == "=";
    f.record = touched || assigned ? nullptr : find_construct(text);
    if (f.record != nullptr || (is_any(text, {"if", "for", "else"}) && !touched)) {
      f.keyword = std::string(text);
      f.wants_name = (f.record != nullptr && f.record->declares_name) || text == "for";
      return;
    }
    f.target = std::string(text);
    for (std::size_t j = k + 1; j < tokens_.size() && tokens_[j].begin == tokens_[j - 1].end; ++j)
      f.target += word(j);
  }

  /// The value that ends before token `k` and touches it: `front.left.side`, `edges[1]`, `bodies.woman(size:
  /// 40)`.
  std::string chain_before(std::size_t k) const {
    std::size_t j = k;
    int depth = 0;
    while (j > 0) {
      const Token& token = tokens_[j - 1];
      const std::string_view text = word(j - 1);
      const bool inside = depth > 0;
      if (!inside && j < k && token.end != tokens_[j].begin) break;
      if (is_any(text, {")", "]"}))
        ++depth;
      else if (is_any(text, {"(", "["}) && depth-- == 0)
        break;
      else if (!inside && token.kind == TokenKind::sign && text != ".")
        break;
      else if (!inside && is_any(std::string(text), {"{", "}"}))
        break;
      --j;
    }
    if (j >= k) return "";
    return std::string(text_.substr(tokens_[j].begin, tokens_[k - 1].end - tokens_[j].begin));
  }

  Context here(std::size_t k, std::uint32_t offset) {
    Context c;
    c.word_begin = c.word_end = offset;
    Token token;
    token.begin = offset;
    line_of(offset, token);
    if (k < tokens_.size() && tokens_[k].begin < offset) {
      token = tokens_[k];
      if (!is_open_word(token) || token.kind == TokenKind::comment) c.silent = true;
      c.word_begin = token.begin;
      c.word_end = token.end;
      c.prefix = std::string(text_.substr(token.begin, offset - token.begin));
    } else if (k < tokens_.size() && tokens_[k].begin == offset && tokens_[k].kind == TokenKind::word) {
      c.word_end = tokens_[k].end;
    }
    for (std::size_t i = 1; i < frames_.size(); ++i)
      if (!frames_[i].block.keyword.empty()) c.blocks.push_back(frames_[i].block);
    for (const Frame& f : frames_)
      if (!f.loop_variable.empty()) c.loop_variables.push_back(f.loop_variable);
    take_state(c, token);
    take_before(c);
    return c;
  }

  /// Whether only blanks stand before the place on its line, and how many.
  void line_of(std::uint32_t offset, Token& token) const {
    std::size_t i = offset;
    while (i > 0 && text_[i - 1] != '\n') --i;
    token.first_on_line = true;
    for (; i < offset; ++i) {
      if (text_[i] != ' ' && text_[i] != '\t' && text_[i] != '\r') token.first_on_line = false;
      token.indent = text_[i] == '\t' ? (token.indent / 4 + 1) * 4 : token.indent + 1;
    }
  }

  void take_state(Context& c, const Token& token) {
    const Frame& f = frame();
    c.begins_statement = begins(token.first_on_line, token.indent, c.prefix) || (f.both && f.keyword.empty());
    // Deeper on a new line: a clause of the statement above, or a statement of its own.
    const bool deeper = token.first_on_line && token.indent > f.indent && f.open.empty();
    c.in_statement = f.open_statement && !f.keyword.empty() && (!c.begins_statement || deeper);
    if (f.open_statement && f.keyword.empty() && !f.target.empty() && !c.begins_statement)
      c.in_statement = true;
    c.both = f.both;
    c.keyword = f.keyword;
    c.target = f.target;
    c.names_itself = f.wants_name;
    c.clause = f.clause;
    c.clauses = f.clauses;
    c.values = f.values;
    c.open = f.open;
  }

  void take_before(Context& c) const {
    if (last_ >= tokens_.size()) return;
    const Token& before = tokens_[last_];
    c.after_operator = after_operator_;
    const bool line =
        text_.substr(before.end, c.word_begin - before.end).find('\n') == std::string_view::npos;
    c.after_number = before.kind == TokenKind::number && line;
    c.touches_number = c.after_number && before.end == c.word_begin;
    if (word(last_) == "." && before.end == c.word_begin) {
      c.base = chain_before(last_);
      if (c.base.empty()) c.silent = true;
      c.begins_statement = false;
    }
  }

  std::string_view text_;
  std::vector<Token> tokens_;
  std::vector<Frame> frames_;
  std::size_t last_ = static_cast<std::size_t>(-1);  ///< the token before, comments aside
  bool after_operator_ = false;
};

}  // namespace

Context context_at(std::string_view text, std::uint32_t offset) {
  offset = std::min(offset, static_cast<std::uint32_t>(text.size()));
  return Reader(text, tokenize(text)).read(offset);
}

}  // namespace garment::service
