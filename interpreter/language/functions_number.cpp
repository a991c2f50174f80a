// Builtin functions on numbers.
#include <cmath>

#include "interpreter/language/function_arguments.hpp"
#include "runtime/base/portable_math.hpp"

namespace garment::interpreter::detail {
namespace {

Quantity wanted(Call& call, std::size_t k, Dimension dimension) {
  return as_quantity(call.program, call.arguments[k], place(call, k), dimension,
                     "`" + std::string(call.record.name) + "`");
}

Value extreme(Call& call, bool largest) {
  const auto* list = call.arguments.size() == 1 ? call.arguments[0].as<ListValue>() : nullptr;
  const std::vector<Value>& values = list != nullptr ? static_cast<const std::vector<Value>&>(**list) : call.arguments;
  if (values.empty())
    fail(call.program, Message("G0350", called(call) + " of an empty list", call.expr.span)
                           .help("`count(list)` tells how many values a list has"));
  Quantity best;
  for (std::size_t k = 0; k < values.size(); ++k) {
    count_step(call.program, call.expr.span);
    const auto* q = values[k].as<Quantity>();
    if (q == nullptr) fail(call.program, Message("G0306", kind_of(values[k]) + " where " + called(call) + " takes numbers", place(call, k)));
    if (k == 0) {
      best = *q;
      continue;
    }
    if (q->dimension != best.dimension && !is_plain_zero(*q) && !is_plain_zero(best))
      fail(call.program,
           Message("G0305", describe(q->dimension) + " beside " + describe(best.dimension), place(call, k))
               .help("all values must be of one kind"));
    const Dimension dimension = is_plain_zero(best) ? q->dimension : best.dimension;
    if (largest ? q->value > best.value : q->value < best.value) best = *q;
    best.dimension = dimension;
  }
  return Value{best};
}

Value run_sqrt(Call& call) {
  const Quantity q = number_at(call, 0);
  const Dimension d = q.dimension;
  if (d.m % 2 != 0 || d.kg % 2 != 0 || d.s % 2 != 0 || d.rad % 2 != 0)
    fail(call.program,
         Message("G0305", "the square root of " + describe(d) + " has no unit", place(call, 0)));
  if (q.value < 0)
    fail(call.program, Message("G0309", "the square root of " + format_quantity(q.value, d), place(call, 0))
                           .help("the value must not be negative"));
  auto half = [](std::int8_t e) { return static_cast<std::int8_t>(e / 2); };
  return finite(call, {std::sqrt(q.value), {half(d.m), half(d.kg), half(d.s), half(d.rad)}, false});
}

template <double (*F)(double)>
Value angle_function(Call& call) {
  return finite(call, {F(wanted(call, 0, kAngle).value), kNumber, false});
}

template <double (*F)(double)>
Value inverse_function(Call& call) {
  return finite(call, {F(wanted(call, 0, kNumber).value), kAngle, false});
}

Value run_atan2(Call& call) {
  const Quantity y = number_at(call, 0), x = number_at(call, 1);
  if (y.dimension != x.dimension && !is_plain_zero(y) && !is_plain_zero(x))
    fail(call.program,
         Message("G0305", "`atan2` of " + describe(y.dimension) + " and " + describe(x.dimension),
                 call.expr.span));
  return finite(call, {portable::atan2(y.value, x.value), kAngle, false});
}

template <double (*F)(double)>
Value rounded(Call& call) {
  const Quantity q = number_at(call, 0);
  if (!call.given(1)) {
    if (!q.dimension.none())
      fail(
          call.program,
          Message("G0308",
                  "`" + std::string(call.record.name) + "` of " + describe(q.dimension) + " needs a step",
                  place(call, 0))
              .help("as in `" + std::string(call.record.name) + "(x, 1 " + example_unit(q.dimension) + ")`"));
    return Value{Quantity{F(q.value), q.dimension, false}};
  }
  const Quantity step = wanted(call, 1, q.dimension);
  if (!(step.value > 0))
    fail(call.program, Message("G0309", "a step of " + format_quantity(step.value, step.dimension) + "; it must be over 0",
                               place(call, 1)));
  return finite(call, {F(q.value / step.value) * step.value, q.dimension, q.percent});
}

double round_half_away(double x) { return std::round(x); }
double round_down(double x) { return std::floor(x); }
double round_up(double x) { return std::ceil(x); }

Value run_floor(Call& call) {
  return call.given(0) ? rounded<round_down>(call) : Value{ShapeValue{design::Floor{}}};
}

Value run_abs(Call& call) {
  Quantity q = number_at(call, 0);
  q.value = std::fabs(q.value);
  return Value{q};
}

}  // namespace

std::vector<FunctionRecord> number_functions() {
  return {
      {"pi",
       "pi",
       "3.14159...",
       "2 * pi * 10 cm",
       {},
       0,
       [](Call&) { return number_value(portable::kPi); },
       true},
      {"min",
       "min(A, B, ...)",
       "the smallest",
       "min(w, 30 cm)",
       {"a", "b"},
       1,
       [](Call& call) {
         if (!call.given(1)) call.arguments.resize(1);
         return extreme(call, false);
       },
       false,
       false,
       true},
      {"max",
       "max(A, B, ...)",
       "the largest",
       "max(w, 30 cm)",
       {"a", "b"},
       1,
       [](Call& call) {
         if (!call.given(1)) call.arguments.resize(1);
         return extreme(call, true);
       },
       false,
       false,
       true},
      {"abs", "abs(X)", "without its sign", "abs(a - b)", {"x"}, 1, run_abs},
      {"sqrt", "sqrt(X)", "square root; of an area a length", "sqrt(a * a + b * b)", {"x"}, 1, run_sqrt},
      {"sin", "sin(ANGLE)", "sine", "sin(30 deg)", {"angle"}, 1, angle_function<portable::sin>},
      {"cos", "cos(ANGLE)", "cosine", "cos(60 deg)", {"angle"}, 1, angle_function<portable::cos>},
      {"tan", "tan(ANGLE)", "tangent", "tan(45 deg)", {"angle"}, 1, angle_function<portable::tan>},
      {"asin", "asin(X)", "angle of a sine", "asin(0.5)", {"x"}, 1, inverse_function<portable::asin>},
      {"acos", "acos(X)", "angle of a cosine", "acos(0.5)", {"x"}, 1, inverse_function<portable::acos>},
      {"atan", "atan(X)", "angle of a tangent", "atan(1)", {"x"}, 1, inverse_function<portable::atan>},
      {"atan2", "atan2(Y, X)", "angle of the point (X, Y)", "atan2(2 cm, 3 cm)", {"y", "x"}, 2, run_atan2},
      {"round",
       "round(X [, STEP])",
       "to the nearest step",
       "round(w, 1 mm)",
       {"x", "step"},
       1,
       rounded<round_half_away>},
      {"floor",
       "floor(X [, STEP]) | floor",
       "down to a step; as a body: the floor at y = 0",
       "floor(3.7)",
       {"x", "step"},
       0,
       run_floor,
       true},
      {"ceil", "ceil(X [, STEP])", "up to a step", "ceil(3.2)", {"x", "step"}, 1, rounded<round_up>},
  };
}

}  // namespace garment::interpreter::detail
