#include "interpreter/language/collections.hpp"
#include "interpreter/language/drawing.hpp"
#include "interpreter/language/evaluate.hpp"
#include "interpreter/language/function_table.hpp"
#include "runtime/base/portable_math.hpp"

namespace garment::interpreter {
namespace {

// Nested evaluations. With every case of eval in a frame of its own a level takes 1 to 2 KB of stack, several
// times that under the address sanitizer.

[[noreturn]] [[gnu::noinline]] void fail_depth(Program& program, Span span) {
  fail(program, Message("G0316", "the evaluation is nested more than 1000 deep", span)
                    .help("write the recursion or the chain of definitions less deep"));
}

[[gnu::noinline]] Value eval_not(Program& program, const Expr& expr, Scope& scope) {
  return Value{!eval_truth(program, expr.children[0], scope, "`not`")};
}

[[gnu::noinline]] bool condition_holds(Program& program, const Expr& expr, Scope& scope) {
  return eval_truth(program, expr.children[0], scope, "`if`");
}

[[noreturn]] [[gnu::noinline]] void fail_missing(Program& program, const Expr& expr) {
  fail(program, Message("G0306", "a value is missing here", expr.span));
}

struct DepthGuard {
  Program& program;
  DepthGuard(Program& p, Span span) : program(p) {
    count_step(p, span);
    if (++p.depth <= kMaxEvaluationDepth) return;
    --p.depth;
    fail_depth(p, span);
  }
  DepthGuard(const DepthGuard&) = delete;
  DepthGuard& operator=(const DepthGuard&) = delete;
  ~DepthGuard() { --program.depth; }
};

[[gnu::noinline]] Value eval_number(Program& program, const Expr& expr) {
  const auto unit = find_unit(expr.unit);
  if (!unit)
    fail(program, Message("G0308", "`" + expr.unit + "` is no unit", expr.unit_span)
                      .help(did_you_mean(expr.unit, unit_names())));
  // Division where the factor is a power of ten below one: 58 cm must be the double nearest to 0.58.
  const double inverse = 1 / unit->factor;
  const bool exact = inverse > 1 && inverse == static_cast<double>(static_cast<long long>(inverse)) &&
                     1 / inverse == unit->factor;
  const double value = exact ? expr.number / inverse : expr.number * unit->factor;
  return number_value(value, unit->dimension, unit->percent);
}

[[gnu::noinline]] Value eval_string(Program& program, const Expr& expr, Scope& scope) {
  if (expr.children.empty()) return text_value(program, expr.text, expr.span);
  std::string text;
  for (const Expr& child : expr.children) {
    if (child.kind == ExprKind::text) {
      text += child.text;
    } else {
      const Value value = eval(program, child, scope);
      const auto* plain = value.as<std::string>();
      text += plain != nullptr ? *plain : show(value);
    }
    if (text.size() > kMaxText) break;
  }
  return text_value(program, std::move(text), expr.span);
}

[[gnu::noinline]] Value eval_name(Program& program, const Expr& expr, Scope& scope) {
  const std::string name = name_of(program, expr, scope);
  if (const Value* local = find_local(scope, name)) return *local;
  if (Declaration* declaration = find_declaration(scope, name)) {
    // A port is called as what it shows to the outside; to the panel that is being drawn its own edge is nearer.
    if (declaration->statement->keyword.text == "port")
      if (const auto drawn = drawn_member(program, scope, name)) return *drawn;
    return force(program, *declaration, expr.span);
  }
  // `both` puts its half into every operand that is declared in halves.
  if (!scope.half.empty())
    if (Declaration* declaration = find_declaration(scope, name + '.' + scope.half)) {
      for (const Scope* at = &scope; at != nullptr; at = at->parent) at->half_used = true;
      return force(program, *declaration, expr.span);
    }
  if (const FunctionRecord* function = find_function(name)) {
    if (function->bare) return call_builtin(program, *function, expr, scope);
    fail(program, Message("G0306", "`" + name + "` is a function, it must be called", expr.span)
                      .help("write `" + std::string(function->form) + "`"));
  }
  if (Declaration* half = find_half(program, scope, name, expr.span)) return force(program, *half, expr.span);
  if (const auto drawn = drawn_member(program, scope, name)) return *drawn;
  fail_unknown_name(program, name, expr.span, scope);
}

[[gnu::noinline]] Value eval_point_literal(Program& program, const Expr& expr, Scope& scope) {
  PointValue point;
  point.size = static_cast<int>(expr.children.size());
  if (point.size != 2 && point.size != 3)
    fail(program, Message("G0306", "a point has 2 or 3 coordinates, this has " + std::to_string(point.size),
                          expr.span));
  bool known = false;
  for (int k = 0; k < point.size; ++k) {
    const Expr& child = expr.children[static_cast<std::size_t>(k)];
    const Value value = eval(program, child, scope);
    const auto* q = value.as<Quantity>();
    if (q == nullptr)
      fail(program, Message("G0306", "a coordinate must be a number or a length, this is " + kind_of(value),
                            child.span));
    point.at[static_cast<std::size_t>(k)] = q->value;
    if (is_plain_zero(*q)) continue;
    if (known && q->dimension != point.dimension)
      fail(program, Message("G0305",
                            "the coordinates of a point must be alike: this is " + describe(q->dimension) +
                                ", the one before " + describe(point.dimension),
                            child.span)
                        .help(q->dimension.none() ? "give it a unit: `" + format_quantity(q->value, {}) +
                                                        " " + example_unit(point.dimension) + "`"
                                                  : ""));
    point.dimension = q->dimension;
    known = true;
  }
  return Value{point};
}

[[gnu::noinline]] Value eval_list(Program& program, const Expr& expr, Scope& scope) {
  ListBuilder list(program, expr.children.size(), expr.span);
  for (const Expr& child : expr.children) list.add(eval(program, child, scope));
  return list.finish();
}

[[gnu::noinline]] Value eval_record(Program& program, const Expr& expr, Scope& scope) {
  RecordFields fields;
  for (std::size_t k = 0; k < expr.children.size() && k < expr.labels.size(); ++k) {
    for (std::size_t j = 0; j < k; ++j)
      if (expr.labels[j].text == expr.labels[k].text)
        fail(program, Message("G0314", "`" + expr.labels[k].text + "` is given twice", expr.labels[k].span)
                          .also(expr.labels[j].span, "first here"));
    fields.emplace_back(expr.labels[k].text, eval(program, expr.children[k], scope));
  }
  return record_value(program, std::move(fields), expr.span);
}

[[gnu::noinline]] Value eval_range(Program& program, const Expr& expr, Scope& scope) {
  RangeValue range;
  const Value from = eval(program, expr.children[0], scope), to = eval(program, expr.children[1], scope);
  const auto *a = from.as<Quantity>(), *b = to.as<Quantity>();
  if (a == nullptr || b == nullptr)
    fail(program, Message("G0306", "a range goes from number to number", expr.span));
  range.from = *a;
  range.to = *b;
  if (is_plain_zero(*a)) range.from.dimension = b->dimension;
  if (is_plain_zero(*b)) range.to.dimension = a->dimension;
  if (range.from.dimension != range.to.dimension)
    fail(program, Message("G0305", "a range from " + describe(a->dimension) + " to " + describe(b->dimension),
                          expr.span)
                      .help("give both ends the same kind of unit"));
  return Value{range};
}

[[gnu::noinline]] Value eval_index(Program& program, const Expr& expr, Scope& scope) {
  const Value base = eval(program, expr.children[0], scope);
  const auto* list = base.as<ListValue>();
  if (list == nullptr)
    fail(program, Message("G0306", "only a list has `[i]`, this is " + kind_of(base), expr.children[0].span));
  const Quantity q = eval_quantity(program, expr.children[1], scope, kNumber, "an index");
  const std::size_t n = (*list)->size();
  if (!(q.value >= 1 && q.value <= static_cast<double>(n)) ||
      q.value != static_cast<double>(static_cast<std::size_t>(q.value)))
    fail(
        program,
        Message("G0309", "index " + format_quantity(q.value, {}) + "; the list has 1 .. " + std::to_string(n),
                expr.children[1].span)
            .help("`count(list)` tells how many values a list has, `last(list)` is its last one"));
  return (**list)[static_cast<std::size_t>(q.value) - 1];
}

[[gnu::noinline]] Value eval_binary(Program& program, const Expr& expr, Scope& scope) {
  if (expr.text == "and" || expr.text == "or") {
    const bool a = eval_truth(program, expr.children[0], scope, "`" + expr.text + "`");
    if (a == (expr.text == "or")) return Value{a};
    return Value{eval_truth(program, expr.children[1], scope, "`" + expr.text + "`")};
  }
  if (expr.text == "minus")
    fail(program, Message("G0306", "`minus` between values; it takes one region away from another, in the shape of a region", expr.span)
                      .help("write `region NAME in PANEL: A minus B`; numbers are subtracted with `-`"));
  if (expr.text == "=") {
    const std::string name(program.sources.text(expr.children[0].span)), value(program.sources.text(expr.children[1].span));
    fail(program, Message("G0307", "`=` within a value", expr.span)
                      .help("an argument is named by `:`, as in `" + name + ": " + value + "`; two values are compared by `==`"));
  }
  const Value a = eval(program, expr.children[0], scope);
  const Value b = eval(program, expr.children[1], scope);
  return apply_binary(program, expr, a, b);
}

}  // namespace

Value eval(Program& program, const Expr& expr, Scope& scope) {
  DepthGuard guard(program, expr.span);
  switch (expr.kind) {
    case ExprKind::number:
      return eval_number(program, expr);
    case ExprKind::string:
      return eval_string(program, expr, scope);
    case ExprKind::text:
      return text_value(program, expr.text, expr.span);
    case ExprKind::boolean:
      return Value{expr.text == "true"};
    case ExprKind::name:
      return eval_name(program, expr, scope);
    case ExprKind::member:
      return eval_member(program, expr, scope);
    case ExprKind::range_index:
      return eval_range_index(program, expr, scope);
    case ExprKind::index:
      return eval_index(program, expr, scope);
    case ExprKind::call:
      return eval_call(program, expr, scope);
    case ExprKind::unary:
      if (expr.text == "not") return eval_not(program, expr, scope);
      return apply_unary(program, expr, eval(program, expr.children[0], scope));
    case ExprKind::binary:
      return eval_binary(program, expr, scope);
    case ExprKind::range:
      return eval_range(program, expr, scope);
    case ExprKind::list:
      return eval_list(program, expr, scope);
    case ExprKind::record:
      return eval_record(program, expr, scope);
    case ExprKind::with:
      return eval_with(program, expr, scope);
    case ExprKind::point:
      return eval_point_literal(program, expr, scope);
    case ExprKind::conditional:
      return eval(program, expr.children[condition_holds(program, expr, scope) ? 1 : 2], scope);
    case ExprKind::none:
      fail_missing(program, expr);
    case ExprKind::error:
      throw Stop{};  // the parser has said it
  }
  throw Stop{};
}

}  // namespace garment::interpreter
