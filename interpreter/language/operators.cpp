#include <cmath>

#include "interpreter/language/collections.hpp"
#include "interpreter/language/curve_values.hpp"
#include "interpreter/language/evaluate.hpp"
#include "runtime/base/limits.hpp"
#include "runtime/base/portable_math.hpp"

namespace garment::interpreter {
namespace {

[[noreturn]] void fail_kinds(Program& program, const Expr& expr, const Value& a, const Value& b) {
  fail(program,
       Message("G0306", "`" + expr.text + "` between " + kind_of(a) + " and " + kind_of(b), expr.span)
           .help(a.as<BodyPlaceValue>() != nullptr || b.as<BodyPlaceValue>() != nullptr
                     ? "a level is no number: ask its `.girth` or `.height`, as in `" +
                           std::string(program.sources.text(expr.children[a.as<BodyPlaceValue>() != nullptr ? 0 : 1].span)) + ".girth`"
                 : expr.text == "+" ? "`+` adds numbers of one kind, adds points, joins lists, and chains edges and curves" : ""));
}

[[noreturn]] void fail_dimensions(Program& program, const Expr& expr, const Quantity& a, const Quantity& b) {
  const auto shown = [&](const Quantity& q) {
    if (program.drape != nullptr && program.drape->stand_in()) return std::string();
    return " (" + format_quantity(q.value, q.dimension, q.percent) + ")";
  };
  Message message("G0305",
                  "`" + expr.text + "` between " + describe(a.dimension) + shown(a) + " and " + describe(b.dimension) + shown(b),
                  expr.span);
  const Quantity& bare = a.dimension.none() ? a : b;
  const Quantity& other = a.dimension.none() ? b : a;
  const std::string& text = program.sources[expr.span.source].text;
  const bool comma = expr.span.end + 1 < text.size() && text[expr.span.end] == ',' && text[expr.span.end + 1] >= '0' &&
                     text[expr.span.end + 1] <= '9';
  if (bare.dimension.none() && program.drape != nullptr && program.drape->stand_in())
    message.help("strains and coefficients are shares: compare them with `8%`");
  else if (comma)
    message.help("is it a decimal point? it is written `.`, as in `5.5 cm`");
  else if (bare.dimension.none() && !bare.percent)
    message.help("give the number a unit: `" + format_quantity(bare.value, {}) + ' ' +
                 example_unit(other.dimension) + "`");
  fail(program, message);
}

Value finite(Program& program, const Expr& expr, Quantity q) {
  if (!std::isfinite(q.value))
    fail(program, Message("G0319", "the result of `" + expr.text + "` is not a finite number", expr.span));
  return Value{q};
}

Quantity add(Program& program, const Expr& expr, const Quantity& a, const Quantity& b, double sign) {
  Quantity r{a.value + sign * b.value, a.dimension, a.percent && b.percent};
  if (a.dimension != b.dimension) {
    if (!is_plain_zero(a) && !is_plain_zero(b)) fail_dimensions(program, expr, a, b);
    if (is_plain_zero(a)) r.dimension = b.dimension;
  }
  return r;
}

Value multiply(Program& program, const Expr& expr, const Quantity& a, const Quantity& b, bool divide) {
  if (divide && b.value == 0)
    fail(program, Message("G0319", "division by zero", expr.span, "")
                      .also(expr.children.size() > 1 ? expr.children[1].span : expr.span, "this is 0"));
  const auto dimension = divide ? quotient(a.dimension, b.dimension) : product(a.dimension, b.dimension);
  if (!dimension) fail(program, Message("G0305", "the unit of the result has exponents past 60", expr.span));
  const bool percent =
      dimension->none() && (divide ? a.percent && !b.percent && b.dimension.none() : a.percent != b.percent);
  return finite(program, expr, {divide ? a.value / b.value : a.value * b.value, *dimension, percent});
}

Value raise(Program& program, const Expr& expr, const Quantity& a, const Quantity& b) {
  if (!b.dimension.none()) fail(program, Message("G0305", "an exponent must be a plain number", expr.span));
  const double rounded = std::round(b.value);
  if (!a.dimension.none()) {
    const auto dimension = rounded == b.value && std::fabs(b.value) <= 60
                               ? power(a.dimension, static_cast<int>(rounded))
                               : std::nullopt;
    if (!dimension)
      fail(program,
           Message("G0305", "only whole powers of " + describe(a.dimension) + " have a unit", expr.span));
    return finite(program, expr, {portable::pow(a.value, b.value), *dimension, false});
  }
  return finite(program, expr, {portable::pow(a.value, b.value), {}, false});
}

Value compare(Program& program, const Expr& expr, const Value& a, const Value& b) {
  const std::string& op = expr.text;
  const auto *p = a.as<Quantity>(), *q = b.as<Quantity>();
  if (p != nullptr && q != nullptr) {
    if (p->dimension != q->dimension && !is_plain_zero(*p) && !is_plain_zero(*q))
      fail_dimensions(program, expr, *p, *q);
    if (op == "<") return Value{p->value < q->value};
    if (op == "<=") return Value{p->value <= q->value};
    if (op == ">") return Value{p->value > q->value};
    if (op == ">=") return Value{p->value >= q->value};
    return Value{(p->value == q->value) == (op != "!=")};
  }
  if (op == "==" || op == "is" || op == "!=") {
    if (a.data.index() != b.data.index()) fail_kinds(program, expr, a, b);
    return Value{equal_values(program, a, b, expr.span) == (op != "!=")};
  }
  fail_kinds(program, expr, a, b);
}

Value point_arithmetic(Program& program, const Expr& expr, const PointValue& a, const PointValue& b,
                       double sign) {
  auto zero = [](const PointValue& p) { return p.at[0] == 0 && p.at[1] == 0 && p.at[2] == 0; };
  if (a.size != b.size || (a.dimension != b.dimension && !zero(a) && !zero(b)))
    fail(program, Message("G0305", "`" + expr.text + "` between points of different kinds", expr.span));
  PointValue r = zero(a) ? b : a;
  r.panel = -1;
  for (std::size_t k = 0; k < 3; ++k) r.at[k] = a.at[k] + sign * b.at[k];
  return Value{r};
}

Value scale_point(Program& program, const Expr& expr, PointValue p, const Quantity& q, bool divide) {
  for (double& x : p.at) {
    const Value scaled = multiply(program, expr, {x, p.dimension, false}, q, divide);
    x = scaled.as<Quantity>()->value;
  }
  p.dimension = divide ? *quotient(p.dimension, q.dimension) : *product(p.dimension, q.dimension);
  p.panel = -1;
  return Value{p};
}

Value chain(Program& program, const Expr& expr, const EdgeValue& a, const EdgeValue& b, bool backwards) {
  if (a.spans.size() + b.spans.size() > kMaxLinks)
    fail(program, Message("G1603", "a chain of " + std::to_string(a.spans.size() + b.spans.size()) +
                                       " edges; at most " + std::to_string(kMaxLinks) + " are allowed",
                          expr.span)
                      .help("sew in several seams"));
  EdgeValue r = a;
  for (std::size_t k = 0; k < b.spans.size(); ++k) {
    EdgeSpan span = b.spans[backwards ? b.spans.size() - 1 - k : k];
    span.backwards = span.backwards != backwards;
    r.spans.push_back(span);
  }
  return Value{r};
}

Value concatenated(Program& program, const Expr& expr, const ListBody& a, const ListBody& b) {
  ListBuilder list(program, a.size() + b.size(), expr.span);
  for (const ListBody* part : {&a, &b})
    for (const Value& value : *part) {
      count_step(program, expr.span);
      list.add(value);
    }
  return list.finish();
}

}  // namespace

Value apply_unary(Program& program, const Expr& expr, const Value& a) {
  if (const auto* q = a.as<Quantity>())
    return expr.text == "-" ? Value{Quantity{-q->value, q->dimension, q->percent}} : a;
  if (const auto* p = a.as<PointValue>(); p != nullptr && (expr.text == "-" || expr.text == "+")) {
    PointValue r = *p;
    if (expr.text == "-")
      for (double& x : r.at) x = -x;
    r.panel = -1;
    return Value{r};
  }
  if (const auto* edge = a.as<EdgeValue>(); edge != nullptr && expr.text == "-")
    return chain(program, expr, {}, *edge, true);
  if (const auto* curve = a.as<CurveValue>(); curve != nullptr && expr.text == "-")
    return curve_value(program, (*curve)->curve.reversed(), expr.span);
  fail(program, Message("G0306", "`" + expr.text + "` before " + kind_of(a), expr.span));
}

Value apply_binary(Program& program, const Expr& expr, const Value& a, const Value& b) {
  const std::string& op = expr.text;
  if (op == "==" || op == "!=" || op == "<" || op == "<=" || op == ">" || op == ">=" || op == "is")
    return compare(program, expr, a, b);
  const auto *p = a.as<Quantity>(), *q = b.as<Quantity>();
  const auto *u = a.as<PointValue>(), *v = b.as<PointValue>();
  const auto *e = a.as<EdgeValue>(), *f = b.as<EdgeValue>();
  if (op == "+" || op == "-") {
    const double sign = op == "+" ? 1 : -1;
    if (p != nullptr && q != nullptr) return finite(program, expr, add(program, expr, *p, *q, sign));
    if (u != nullptr && v != nullptr) return point_arithmetic(program, expr, *u, *v, sign);
    if (e != nullptr && f != nullptr) return chain(program, expr, *e, *f, op == "-");
    const bool curves = a.as<CurveValue>() != nullptr || b.as<CurveValue>() != nullptr;
    if (curves && (e != nullptr || f != nullptr || a.data.index() == b.data.index()))
      return join_curves(program, a, b, op == "-", expr.span);
    const auto *l = a.as<ListValue>(), *m = b.as<ListValue>();
    if (op == "+" && l != nullptr && m != nullptr) return concatenated(program, expr, **l, **m);
  }
  if (op == "*") {
    if (p != nullptr && q != nullptr) return multiply(program, expr, *p, *q, false);
    if (u != nullptr && q != nullptr) return scale_point(program, expr, *u, *q, false);
    if (p != nullptr && v != nullptr) return scale_point(program, expr, *v, *p, false);
  }
  if (op == "/") {
    if (p != nullptr && q != nullptr) return multiply(program, expr, *p, *q, true);
    if (u != nullptr && q != nullptr) return scale_point(program, expr, *u, *q, true);
  }
  if (op == "^" && p != nullptr && q != nullptr) return raise(program, expr, *p, *q);
  fail_kinds(program, expr, a, b);
}

}  // namespace garment::interpreter
