#pragma once
// All that the rules share while a source is read: the text, the vocabulary, the expression under
// construction, and the stack of statements that are not finished.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/expression_builder.hpp"
#include "grammar/keywords.hpp"
#include "grammar/problems.hpp"
#include "grammar/syntax_tree.hpp"

namespace garment::grammar {

class ParseState {
 public:
  ParseState(const Source& source, SourceId id, const Keywords& keywords, const ParseLimits& limits)
      : text_(source.text),
        line_begin_(source.line_begin),
        source_(id),
        keywords_(keywords),
        max_depth_(limits.max_depth),
        expressions_(id, limits.max_depth) {}

  ExpressionBuilder& expressions() { return expressions_; }
  std::string_view text() const { return text_; }
  const Keywords& keywords() const { return keywords_; }
  Span span(std::size_t begin, std::size_t end) const {
    return {source_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
  }
  char at(std::size_t i) const { return i < text_.size() ? text_[i] : '\0'; }

  // ---- questions of the contextual rules (parse_state.cpp)

  /// Length of the clause word of the present statement at `at`; 0 where none counts. A word that touches
  /// `.`, `(`, `[` or a brace is part of an expression.
  std::size_t clause_word(std::size_t at) const;
  /// 1 if `=` or `:` stands there as a clause word.
  std::size_t clause_sign(std::size_t at) const;
  /// Length from the line end at `at` to a clause word that goes on with the present statement; 0 if none
  /// does.
  std::size_t continuation(std::size_t at) const;
  /// `+` or `-` with a blank before it and none after begins a new value beside others.
  bool sign_begins_value(std::size_t at) const;
  /// First on its line stands a keyword with something after it that cannot follow a name in an expression.
  bool statement_begins(std::size_t at) const;
  /// `a.b = `, not `a == b`.
  bool assignment_begins(std::size_t at) const;
  /// The keyword of a statement that may stand here.
  Keywords::Match allowed_keyword(std::size_t at) const;
  /// A keyword that belongs to an outer block and is not indented deeper than this block's statement: a } is
  /// missing.
  bool outer_statement_begins(std::size_t at) const;
  std::size_t keyword_length(std::size_t at) const { return allowed_keyword(at).length; }
  std::size_t unit_length(std::size_t at) const { return keywords_.unit_length(text_, at); }
  bool in_brackets() const { return expressions_.mode() == Mode::brackets; }
  bool not_stopped() const { return !stopped_; }
  /// The block just read has no }: its statement ends before the next one.
  bool block_left_open() const { return left_open_; }
  /// At a line end: the deeper next line begins with a keyword of this statement's block, but the { is
  /// missing.
  bool block_begins_below(std::size_t at) const;
  bool declares_name() const;
  bool has_body() const;

  // ---- statements under construction (statement_stack.cpp)

  void begin_statement(Span keyword, std::string_view text, const Keyword* info);
  void declare_name() { statements_.back().statement.name = expressions_.take_name(); }
  void begin_assignment(Span sign);  ///< its target was read before
  void add_value();
  void begin_clause(Span word);
  void open_block(Span brace);  ///< `brace` is empty where the { is missing; that is reported here
  /// `brace` is empty where the } is missing; that is reported here, once for each mistake.
  void close_block(Span brace);
  void end_else();
  void end_both();
  void end_statement(std::uint32_t end);
  Block take_script() { return std::move(script_); }

  // ---- mistakes

  /// Throws the SyntaxError for `problem` at offset `at` (explain.cpp).
  [[noreturn]] void fail(const Problem& problem, std::size_t at) const;
  /// Keeps the error and marks the statement begun at `begin` as broken; `depth` statements stay open around
  /// it.
  void break_statement(SyntaxError error, std::size_t begin, std::size_t end, std::size_t depth);
  void report(SyntaxError error);
  void report_stray_brace(Span brace);
  /// Where reading goes on after a mistake at `position` in the statement at `begin` (recovery.cpp).
  std::size_t resume(std::size_t begin, std::size_t position) const;
  std::size_t depth() const { return statements_.size(); }
  bool stopped() const { return stopped_; }
  bool incomplete() const { return incomplete_ && !final_; }
  Diagnostics take_diagnostics() { return std::move(diagnostics_); }
  /// The sign or word that asks for a value next, for the message when none comes.
  void expect_after(Span sign) { expecting_ = sign; }

 private:
  struct Open {
    Statement statement;
    const Keyword* keyword = nullptr;  // none for assignments, if, for, both
    const WordSet* allowed = nullptr;  // keywords of its block
    int indent = 0;                    // of the line on which it begins
    bool in_block = false;
    Span brace;
    Block children;
  };

  // ---- one slip, one message (cascades.cpp)

  /// The mistake is what an earlier one made of the text: it is not told.
  bool follows_from_earlier(const SyntaxError& error) const;
  bool only_blanks_since_broken(std::size_t at) const;
  /// After a mistake in the statement [begin, end): is it still known which blocks are open?
  void judge_nesting(const SyntaxError& error, std::size_t begin, std::size_t end, bool block_expected);
  void lose_nesting(std::size_t line);
  /// A statement begins at `at`: at the top level and at the line's begin, blocks are known again.
  void find_footing(std::size_t at);

  const WordSet& allowed_words() const;
  int indent_of(std::size_t at) const;
  bool first_on_line(std::size_t at) const;
  std::string doc_above(std::size_t at) const;
  Block& sink() { return statements_.empty() ? script_ : statements_.back().children; }
  bool closes_less_indented(const Open& open, Span brace) const;
  void report_open_block(const Open& open, std::size_t at);
  std::size_t line_of(std::size_t at) const;
  std::size_t next_word_line(std::size_t at) const;
  bool ends_before(std::size_t next, std::size_t position, int indent, bool open, bool skipped) const;

  std::string found(std::size_t at) const;
  Span found_span(std::size_t at) const;
  SyntaxError unknown_character(std::size_t at) const;
  SyntaxError unknown_statement(std::size_t at) const;
  SyntaxError unknown_unit(std::size_t number_end, std::size_t at) const;
  SyntaxError unclosed(const Problem& problem, std::size_t at) const;
  SyntaxError missing_value(const Problem& problem, std::size_t at) const;
  SyntaxError leftover(std::size_t at) const;

  std::string_view text_;
  const std::vector<std::uint32_t>& line_begin_;
  SourceId source_;
  const Keywords& keywords_;
  int max_depth_;
  ExpressionBuilder expressions_;
  std::vector<Open> statements_;
  Block script_;
  Diagnostics diagnostics_;
  Span expecting_;
  Span suspect_;  // the { of a block whose } is less indented than its statement: probably another block's }
  std::string suspect_keyword_;
  bool incomplete_ = false;  // some mistake would vanish with more text
  bool final_ = false;       // some would not
  bool stopped_ = false;
  bool left_open_ = false;
  bool end_reported_ = false;
  bool lost_ = false;           // blocks and brackets do not match since `lost_line_`
  std::size_t lost_line_ = 0;
  bool fresh_ = false;          // a mistake was told since the last whole statement of the top level
  std::size_t broken_end_ = 0;  // where the last broken statement ends
  mutable std::size_t indent_line_ =
      0;  // the last line asked for and its indentation: a line may hold many statements
  mutable int indent_ = -1;
};

}  // namespace garment::grammar
