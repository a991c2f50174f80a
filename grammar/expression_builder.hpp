#pragma once
// Builds expressions while the rules match: a stack of finished values, a stack of operators that still wait
// for their right side, and a stack of open brackets. Precedence is decided here, once, so that the grammar
// can stay flat.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/syntax_error.hpp"
#include "grammar/syntax_tree.hpp"

namespace garment::grammar {

/// What blanks and words mean at a place.
enum class Mode : std::uint8_t {
  items,     ///< values of a statement side by side: clause words count, a line end ends the statement
  line,      ///< inside the braces of a string, name or record: a line end separates
  brackets,  ///< inside ( ) and [ ]: a line end is a blank
};

/// An opening bracket, brace, quote or `if` whose partner has not come yet.
struct Opener {
  char sign = 0;  ///< ( [ { " as written; b for the { of a block, i for `if`
  Span span;
  Mode mode = Mode::items;  ///< inside it
  std::size_t values = 0;   ///< height of the stacks when it was opened
  std::size_t labels = 0;
  std::string pending;  ///< of a string: characters since the last part
  std::uint32_t pending_begin = 0;
};

class ExpressionBuilder {
 public:
  ExpressionBuilder(SourceId source, int max_depth) : source_(source), max_depth_(max_depth) {}

  Mode mode() const { return openers_.empty() ? Mode::items : openers_.back().mode; }
  const std::vector<Opener>& openers() const { return openers_; }

  /// All of these throw SyntaxError where the tree would become too deep.
  void open(char sign, Span span, Mode mode);
  Opener close();

  void number(std::string_view digits, Span span);
  void unit(std::string_view text, Span span);
  void boolean(std::string_view text, Span span);
  void none(std::uint32_t at);

  void name(std::string_view text, Span span);
  void name_text(std::string_view text, Span span);  ///< a literal part after a `{expr}` part
  void close_name_hole();
  void end_name(std::string_view text, Span span);
  Name take_name();
  void member();

  void string_text(std::string_view text, std::uint32_t begin);
  void string_hole_begin();
  void close_string(std::uint32_t end);

  void prefix(std::string_view sign, Span span);
  void infix(std::string_view sign, Span span);
  void end_chain();
  void end_range();

  void label(std::string_view text, Span span);
  void argument();  ///< after a positional argument
  void end_default();

  void close_group(std::uint32_t end);
  void close_list(std::uint32_t end);
  void close_call(std::uint32_t end);
  void close_index(std::uint32_t end);
  void close_record(std::uint32_t end);
  void end_with();
  void end_conditional(std::uint32_t end);

  Expr take();

  struct Heights {
    std::size_t openers, values, operators, labels;
  };
  Heights heights() const { return {openers_.size(), values_.size(), operators_.size(), labels_.size()}; }
  void unwind(const Heights& heights);

 private:
  struct Value {
    Expr expr;
    int depth = 1;
  };
  struct Operator {
    std::string_view sign;
    Span span;
    int precedence;
    bool is_prefix;
    std::size_t level;  // number of open brackets: an operator belongs to the chain of the same level
  };

  Expr leaf(ExprKind kind, std::string_view text, Span span) const;
  void push(Expr expr, int depth = 1);
  Value pop();
  /// A node over all values above `base`, in order.
  void push_node(Expr node, std::size_t base);
  void reduce();
  void flush_text(Opener& opener, std::uint32_t end);
  [[noreturn]] void too_deep(Span span, bool fatal = false) const;

  SourceId source_;
  int max_depth_;
  std::vector<Value> values_;
  std::vector<Operator> operators_;
  std::vector<Opener> openers_;
  std::vector<Name> labels_;
};

}  // namespace garment::grammar
