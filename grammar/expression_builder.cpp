#include "grammar/expression_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "runtime/base/number.hpp"

namespace garment::grammar {
namespace {

// Loose to tight. `not` stands between `and` and the comparisons, a sign between `*` and `^`: -2^2 is -(2^2).
enum Precedence { kOr = 1, kAnd, kNot, kComparison, kSum, kProduct, kSign, kPower };

int infix_precedence(std::string_view sign) {
  if (sign == "or") return kOr;
  if (sign == "and" || sign == "minus") return kAnd;
  if (sign == "+" || sign == "-") return kSum;
  if (sign == "*" || sign == "/") return kProduct;
  if (sign == "^") return kPower;
  return kComparison;
}

[[noreturn]] void out_of_range(std::string_view digits, Span span) {
  Diagnostic d;
  d.code = "G0106";
  d.message = fmt::format("the number {} is out of range", digits.substr(0, 40));
  d.labels = {{span, "beyond 64-bit floating point"}};
  d.help = "check the digits and the exponent";
  throw SyntaxError{d, span.begin, false};
}

[[noreturn]] void comparisons_chain(std::string_view sign, Span second, Span first) {
  Diagnostic d;
  d.code = "G0213";
  d.message = fmt::format("`{}` follows another comparison, but comparisons do not chain", sign);
  d.labels = {{second, "second comparison"}, {first, "first comparison"}};
  d.help = "join two comparisons by `and`: 0 < x and x < 1";
  throw SyntaxError{d, second.begin, false};
}

}  // namespace

void ExpressionBuilder::too_deep(Span span, bool fatal) const {
  Diagnostic d{"G0210",
               Severity::error,
               fmt::format("nested more than {} deep", max_depth_),
               {{span, "one level too many"}},
               "name a part with `let` and use the name"};
  throw SyntaxError{d, span.begin, false, fatal};
}

void ExpressionBuilder::open(char sign, Span span, Mode mode) {
  if (openers_.size() >= static_cast<std::size_t>(max_depth_)) too_deep(span, sign == 'b');
  openers_.push_back({sign, span, mode, values_.size(), labels_.size(), {}, span.end});
}

Opener ExpressionBuilder::close() {
  Opener opener = std::move(openers_.back());
  openers_.pop_back();
  return opener;
}

Expr ExpressionBuilder::leaf(ExprKind kind, std::string_view text, Span span) const {
  Expr expr;
  expr.kind = kind;
  expr.span = span;
  expr.text = text;
  return expr;
}

void ExpressionBuilder::push(Expr expr, int depth) {
  if (depth > max_depth_) too_deep(expr.span);
  values_.push_back({std::move(expr), depth});
}

ExpressionBuilder::Value ExpressionBuilder::pop() {
  Value value = std::move(values_.back());
  values_.pop_back();
  return value;
}

void ExpressionBuilder::push_node(Expr node, std::size_t base) {
  int depth = 0;
  for (std::size_t i = base; i < values_.size(); ++i) {
    depth = std::max(depth, values_[i].depth);
    node.children.push_back(std::move(values_[i].expr));
  }
  values_.resize(base);
  push(std::move(node), depth + 1);
}

Expr ExpressionBuilder::take() { return pop().expr; }

void ExpressionBuilder::unwind(const Heights& heights) {
  openers_.resize(heights.openers);
  values_.resize(heights.values);
  operators_.erase(operators_.begin() + static_cast<std::ptrdiff_t>(heights.operators), operators_.end());
  labels_.resize(heights.labels);
}

// ---- leaves

void ExpressionBuilder::number(std::string_view digits, Span span) {
  Expr expr = leaf(ExprKind::number, "", span);
  std::optional<double> value = parse_number(digits);
  if (!value) out_of_range(digits, span);
  expr.number = *value;
  push(std::move(expr));
}

void ExpressionBuilder::unit(std::string_view text, Span span) {
  Expr& number = values_.back().expr;
  number.unit = text;
  number.unit_span = span;
  number.span.end = span.end;
}

void ExpressionBuilder::boolean(std::string_view text, Span span) {
  push(leaf(ExprKind::boolean, text, span));
}

void ExpressionBuilder::none(std::uint32_t at) { push(leaf(ExprKind::none, "", {source_, at, at})); }

// ---- names: the words before, between and after the holes are parts of the name below them on the stack

void ExpressionBuilder::name(std::string_view text, Span span) { push(leaf(ExprKind::name, text, span)); }

void ExpressionBuilder::name_text(std::string_view text, Span span) {
  values_.back().expr.children.push_back(leaf(ExprKind::text, text, span));
}

void ExpressionBuilder::close_name_hole() {
  close();
  Value hole = pop();
  Value& name = values_.back();
  if (hole.depth + 1 > max_depth_) too_deep(hole.expr.span);
  if (name.expr.children.empty())
    name.expr.children.push_back(leaf(ExprKind::text, name.expr.text, name.expr.span));
  name.expr.children.push_back(std::move(hole.expr));
  name.depth = std::max(name.depth, hole.depth + 1);
}

void ExpressionBuilder::end_name(std::string_view text, Span span) {
  Expr& name = values_.back().expr;
  if (name.children.empty()) return;
  name.text = text;
  name.span = span;
}

Name ExpressionBuilder::take_name() {
  Expr name = take();
  return {std::move(name.text), name.span, std::move(name.children)};
}

void ExpressionBuilder::member() {
  Value name = pop(), base = pop();
  Expr node = leaf(ExprKind::member, "", cover(base.expr.span, name.expr.span));
  node.text = std::move(name.expr.text);
  node.name_span = name.expr.span;
  node.children.push_back(std::move(base.expr));
  std::move(name.expr.children.begin(), name.expr.children.end(), std::back_inserter(node.children));
  push(std::move(node), std::max(base.depth, name.depth) + 1);
}

// ---- strings

void ExpressionBuilder::string_text(std::string_view text, std::uint32_t begin) {
  Opener& opener = openers_.back();
  if (opener.pending.empty()) opener.pending_begin = begin;
  opener.pending += text;
}

void ExpressionBuilder::flush_text(Opener& opener, std::uint32_t end) {
  if (opener.pending.empty()) return;
  push(leaf(ExprKind::text, opener.pending, {source_, opener.pending_begin, end}));
  opener.pending.clear();
}

void ExpressionBuilder::string_hole_begin() {
  std::size_t hole = openers_.size() - 1;  // opened last, above its string
  Opener& string = openers_[hole - 1];
  flush_text(string, openers_[hole].span.begin);
}

void ExpressionBuilder::close_string(std::uint32_t end) {
  Opener opener = close();
  flush_text(opener, end - 1);
  Expr node = leaf(ExprKind::string, "", {source_, opener.span.begin, end});
  bool is_plain = values_.size() == opener.values + 1 && values_.back().expr.kind == ExprKind::text;
  if (is_plain) node.text = values_.back().expr.text;
  push_node(std::move(node), opener.values);
}

// ---- operators

void ExpressionBuilder::prefix(std::string_view sign, Span span) {
  bool is_word = sign == "not" || sign == "minus";
  operators_.push_back({sign, span, is_word ? kNot : kSign, true, openers_.size()});
}

void ExpressionBuilder::infix(std::string_view sign, Span span) {
  int precedence = infix_precedence(sign);
  while (!operators_.empty() && operators_.back().level == openers_.size()) {
    const Operator& top = operators_.back();
    bool waits = precedence > top.precedence || (precedence == kPower && top.precedence == kPower);
    if (waits) break;
    if (precedence == kComparison && top.precedence == kComparison) comparisons_chain(sign, span, top.span);
    reduce();
  }
  operators_.push_back({sign, span, precedence, false, openers_.size()});
}

void ExpressionBuilder::reduce() {
  Operator op = operators_.back();
  operators_.pop_back();
  std::size_t n_operands = op.is_prefix ? 1 : 2;
  std::size_t base = values_.size() - n_operands;
  Span span = cover(op.is_prefix ? op.span : values_[base].expr.span, values_.back().expr.span);
  for (std::size_t i = base; i < values_.size(); ++i)
    if (values_[i].depth >= max_depth_) too_deep(op.span);
  push_node(leaf(op.is_prefix ? ExprKind::unary : ExprKind::binary, op.sign, span), base);
}

void ExpressionBuilder::end_chain() {
  while (!operators_.empty() && operators_.back().level == openers_.size()) reduce();
}

void ExpressionBuilder::end_range() {
  std::size_t base = values_.size() - 2;
  push_node(leaf(ExprKind::range, "", cover(values_[base].expr.span, values_.back().expr.span)), base);
}

// ---- brackets

void ExpressionBuilder::label(std::string_view text, Span span) {
  labels_.push_back({std::string(text), span});
}

void ExpressionBuilder::argument() {
  const Opener& call = openers_.back();
  std::size_t n_arguments = values_.size() - call.values, n_labels = labels_.size() - call.labels;
  if (n_labels < n_arguments) {
    std::uint32_t at = values_.back().expr.span.begin;
    labels_.push_back({"", {source_, at, at}});
  }
}

void ExpressionBuilder::end_default() {
  std::size_t base = values_.size() - 2;
  push_node(leaf(ExprKind::binary, "=", cover(values_[base].expr.span, values_.back().expr.span)), base);
}

void ExpressionBuilder::close_group(std::uint32_t end) {
  Opener opener = close();
  Span span{source_, opener.span.begin, end};
  std::size_t n_values = values_.size() - opener.values;
  if (n_values == 1) {
    values_.back().expr.span = span;  // the brackets belong to what is shown under a caret
    return;
  }
  if (n_values > 3) {
    Diagnostic d{"G0214",
                 Severity::error,
                 fmt::format("a point with {} coordinates, but a point has 2 or 3", n_values),
                 {{values_[opener.values + 3].expr.span, "too many"}},
                 "a list stands in square brackets: [a, b, c, d]"};
    throw SyntaxError{d, span.begin, false};
  }
  push_node(leaf(ExprKind::point, "", span), opener.values);
}

void ExpressionBuilder::close_list(std::uint32_t end) {
  Opener opener = close();
  push_node(leaf(ExprKind::list, "", {source_, opener.span.begin, end}), opener.values);
}

void ExpressionBuilder::close_call(std::uint32_t end) {
  Opener opener = close();
  std::size_t base = opener.values - 1;  // what is called lies below the arguments
  Expr node = leaf(ExprKind::call, "", {source_, values_[base].expr.span.begin, end});
  auto first = labels_.begin() + static_cast<std::ptrdiff_t>(opener.labels);
  std::move(first, labels_.end(), std::back_inserter(node.labels));
  labels_.resize(opener.labels);
  push_node(std::move(node), base);
}

void ExpressionBuilder::close_index(std::uint32_t end) {
  Opener opener = close();
  std::size_t base = opener.values - 1;
  Expr node = leaf(ExprKind::index, "", {source_, values_[base].expr.span.begin, end});
  if (values_.back().expr.kind == ExprKind::range) {
    Value range = pop();
    node.kind = ExprKind::range_index;
    for (Expr& side : range.expr.children) push(std::move(side), range.depth - 1);
  }
  push_node(std::move(node), base);
}

void ExpressionBuilder::close_record(std::uint32_t end) {
  Opener opener = close();
  Expr node = leaf(ExprKind::record, "", {source_, opener.span.begin, end});
  auto first = labels_.begin() + static_cast<std::ptrdiff_t>(opener.labels);
  std::move(first, labels_.end(), std::back_inserter(node.labels));
  labels_.resize(opener.labels);
  push_node(std::move(node), opener.values);
}

void ExpressionBuilder::end_with() {
  std::size_t base = values_.size() - 2;
  push_node(leaf(ExprKind::with, "", cover(values_[base].expr.span, values_.back().expr.span)), base);
}

void ExpressionBuilder::end_conditional(std::uint32_t end) {
  Opener opener = close();
  Expr node = leaf(ExprKind::conditional, "", {source_, opener.span.begin, end});
  push_node(std::move(node), opener.values);
}

}  // namespace garment::grammar
