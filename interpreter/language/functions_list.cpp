// Builtin functions on lists and texts.
#include <algorithm>
#include <cmath>

#include "interpreter/language/collections.hpp"
#include "interpreter/language/curve_values.hpp"
#include "interpreter/language/function_arguments.hpp"

namespace garment::interpreter::detail {
namespace {

const ListBody& filled_list(Call& call, std::size_t k) {
  const ListBody& list = list_at(call, k);
  if (list.empty())
    fail(call.program, Message("G0350", called(call) + " of an empty list", place(call, k))
                           .help("`count(list)` tells how many values a list has"));
  return list;
}

Value run_count(Call& call) {
  if (const auto* text = call.arguments[0].as<std::string>())
    return number_value(static_cast<double>(
        std::count_if(text->begin(), text->end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; })));
  return number_value(static_cast<double>(list_at(call, 0).size()));
}

Value run_first(Call& call) { return filled_list(call, 0).front(); }
Value run_last(Call& call) { return filled_list(call, 0).back(); }

Value plus(Call& call, const Value& a, const Value& b) {
  Expr sum;
  sum.kind = ExprKind::binary;
  sum.text = "+";
  sum.span = place(call, 0);
  return apply_binary(call.program, sum, a, b);
}

Value run_sum(Call& call) {
  const ListBody& list = list_at(call, 0);
  if (list.empty()) return number_value(0);
  Value total = list.front();
  if (total.as<Quantity>() == nullptr && total.as<PointValue>() == nullptr)
    fail(call.program, Message("G0306", "`sum` of a list that holds " + kind_of(total), place(call, 0))
                           .help("numbers and points have a sum; edges and lists are joined with `+`"));
  for (std::size_t k = 1; k < list.size(); ++k) {
    count_step(call.program, call.expr.span);
    total = plus(call, total, list[k]);
  }
  return total;
}

/// True where a comes before b. Refuses what has no order.
bool before(Call& call, const Value& a, const Value& b) {
  count_step(call.program, call.expr.span);
  const auto *p = a.as<Quantity>(), *q = b.as<Quantity>();
  if (p != nullptr && q != nullptr) {
    if (p->dimension != q->dimension && !is_plain_zero(*p) && !is_plain_zero(*q))
      fail(call.program, Message("G0305", "`sort` of a list with " + describe(p->dimension) + " and " + describe(q->dimension),
                                 place(call, 0))
                             .help("all values must be of one kind"));
    return p->value < q->value;
  }
  const auto *s = a.as<std::string>(), *t = b.as<std::string>();
  if (s != nullptr && t != nullptr) return *s < *t;
  fail(call.program, Message("G0306", "`sort` of a list with " + kind_of(a) + " and " + kind_of(b), place(call, 0))
                         .help("numbers of one kind and texts have an order; a second argument gives what to sort by"));
}

Value call_with(Call& call, const Value& function, const Value& value) {
  return call_function(call.program, function, {value}, call.expr, place(call, 1));
}

/// By value, or by what a function makes of each. Equal ones keep their order.
Value run_sort(Call& call) {
  const ListBody& list = list_at(call, 0);
  // Counted while it is sorted: the keys, and as much again for the sort.
  const Charge room =
      charge_memory(call.program, 2 * list.size() * sizeof(std::pair<Value, std::size_t>), call.expr.span);
  std::vector<std::pair<Value, std::size_t>> keys;
  keys.reserve(list.size());
  for (std::size_t k = 0; k < list.size(); ++k)
    keys.emplace_back(call.given(1) ? call_with(call, call.arguments[1], list[k]) : list[k], k);
  for (std::size_t k = 1; k < keys.size(); ++k) before(call, keys[0].first, keys[k].first);  // refuses before it sorts
  std::stable_sort(keys.begin(), keys.end(), [&](const auto& a, const auto& b) { return before(call, a.first, b.first); });
  ListBuilder out(call.program, list.size(), call.expr.span);
  for (const auto& [key, k] : keys) out.add(list[k]);
  return out.finish();
}

Value run_reverse(Call& call) {
  const auto* list = call.arguments[0].as<ListValue>();
  if (list == nullptr) return curve_value(call.program, curve_at(call, 0).reversed(), call.expr.span);
  ListBuilder out(call.program, (*list)->size(), call.expr.span);
  for (std::size_t k = (*list)->size(); k-- > 0;) {
    count_step(call.program, call.expr.span);
    out.add((**list)[k]);
  }
  return out.finish();
}

Value run_map(Call& call) {
  const ListBody& list = list_at(call, 0);
  ListBuilder out(call.program, list.size(), call.expr.span);
  for (const Value& value : list) out.add(call_with(call, call.arguments[1], value));
  return out.finish();
}

Value run_filter(Call& call) {
  const ListBody& list = list_at(call, 0);
  ListBuilder out(call.program, list.size(), call.expr.span);
  for (const Value& value : list) {
    const Value kept = call_with(call, call.arguments[1], value);
    if (kept.as<bool>() == nullptr)
      fail(call.program, Message("G0306", "the function gives " + kind_of(kept) + " where `filter` takes true or false",
                                 place(call, 1)));
    if (*kept.as<bool>()) out.add(value);
  }
  return out.finish();
}

constexpr double kMostSteps = 1e6;

/// Numbers from one end of a range to the other.
Value run_steps(Call& call) {
  const auto* range = call.arguments[0].as<RangeValue>();
  if (range == nullptr)
    fail(call.program, Message("G0306", kind_of(call.arguments[0]) + " where `steps` takes a range", place(call, 0))
                           .help("as in `steps(0 cm .. 10 cm, 2 cm)`"));
  const Dimension dimension = range->from.dimension;
  double step = 1;
  if (call.given(1)) {
    step = as_quantity(call.program, call.arguments[1], place(call, 1), dimension, "`steps`").value;
  } else if (!dimension.none()) {
    fail(call.program, Message("G0308", "`steps` over " + describe(dimension) + " needs a step", call.expr.span)
                           .help("as in `steps(0 cm .. 10 cm, 2 cm)`"));
  }
  const double from = range->from.value, to = range->to.value, count = (to - from) / step;
  if (!(step > 0))
    fail(call.program, Message("G0309", "a step of " + format_quantity(step, dimension) + "; it must be over 0", place(call, 1))
                           .help("the values the other way round are `reverse(steps(...))`"));
  if (!(count <= kMostSteps))
    fail(call.program, Message("G0309", "`steps` would give " + format_quantity(std::floor(count) + 1, {}) +
                                            " values; at most 1000000 are allowed",
                               call.expr.span)
                           .help("take a larger step"));
  const std::size_t n = count >= -1e-9 ? static_cast<std::size_t>(count + 1e-9) + 1 : 0;
  ListBuilder out(call.program, n, call.expr.span);
  for (std::size_t k = 0; k < n; ++k) {
    count_step(call.program, call.expr.span);
    out.add(number_value(from + static_cast<double>(k) * step, dimension, range->from.percent));
  }
  return out.finish();
}

std::string as_text(const Value& value) {
  const auto* text = value.as<std::string>();
  return text != nullptr ? *text : show(value);
}

Value run_joined(Call& call) {
  const ListBody& list = list_at(call, 0);
  std::string between;
  if (call.given(1)) {
    const auto* text = call.arguments[1].as<std::string>();
    if (text == nullptr)
      fail(call.program, Message("G0306", kind_of(call.arguments[1]) + " where `joined` takes a text", place(call, 1)));
    between = *text;
  }
  std::string out;
  for (std::size_t k = 0; k < list.size() && out.size() <= kMaxText; ++k) {
    count_step(call.program, call.expr.span);
    out += (k > 0 ? between : "") + as_text(list[k]);
  }
  return text_value(call.program, std::move(out), call.expr.span);
}

/// A value as a person reads it, rounded to a step: text(w, 1 mm).
Value run_text(Call& call) {
  if (!call.given(1)) return text_value(call.program, as_text(call.arguments[0]), call.expr.span);
  const Quantity q = number_at(call, 0);
  const Quantity step = as_quantity(call.program, call.arguments[1], place(call, 1), q.dimension, "`text`");
  if (!(step.value > 0))
    fail(call.program, Message("G0309", "a step of " + format_quantity(step.value, q.dimension) + "; it must be over 0",
                               place(call, 1)));
  const double rounded = std::round(q.value / step.value) * step.value;
  return text_value(call.program, format_quantity(rounded, q.dimension, q.percent, 9), call.expr.span);
}

/// One row of a table: x and the y that belongs to it.
std::pair<Quantity, Quantity> row_of(Call& call, const Value& value) {
  if (const auto* p = value.as<PointValue>(); p != nullptr && p->size == 2)
    return {{p->at[0], p->dimension, false}, {p->at[1], p->dimension, false}};
  if (const auto* pair = value.as<ListValue>(); pair != nullptr && (*pair)->size() == 2) {
    const auto *x = (**pair)[0].as<Quantity>(), *y = (**pair)[1].as<Quantity>();
    if (x != nullptr && y != nullptr) return {*x, *y};
  }
  fail(call.program, Message("G0306", "a row of the table is " + kind_of(value) + "; `interpolate` takes pairs of numbers",
                             place(call, 0))
                         .help("as in `[[36, 84 cm], [38, 88 cm], [40, 92 cm]]`"));
}

Value run_interpolate(Call& call) {
  const ListBody& table = filled_list(call, 0);
  const Quantity x = number_at(call, 1);
  std::vector<std::pair<Quantity, Quantity>> rows;
  rows.reserve(table.size());
  for (const Value& value : table) {
    count_step(call.program, call.expr.span);
    rows.push_back(row_of(call, value));
    const auto& [at, y] = rows.back();
    if (at.dimension != x.dimension && !is_plain_zero(at) && !is_plain_zero(x))
      fail(call.program, Message("G0305", "`interpolate` at " + describe(x.dimension) + " in a table over " +
                                              describe(at.dimension),
                                 place(call, 1))
                             .help("the table and the value must be of one kind"));
    if (y.dimension != rows[0].second.dimension && !is_plain_zero(y))
      fail(call.program, Message("G0305", "the table has " + describe(rows[0].second.dimension) + " and " +
                                              describe(y.dimension) + " side by side",
                                 place(call, 0)));
    if (rows.size() > 1 && !(rows[rows.size() - 2].first.value < at.value))
      fail(call.program, Message("G0351",
                                 "the table's first column does not rise: " +
                                     format_quantity(rows[rows.size() - 2].first.value, at.dimension) + " is followed by " +
                                     format_quantity(at.value, at.dimension),
                                 place(call, 0))
                             .help("put the rows in rising order, each value once"));
  }
  const Quantity &low = rows.front().first, &high = rows.back().first;
  if (!(x.value >= low.value && x.value <= high.value))
    fail(call.program, Message("G0352",
                               format_quantity(x.value, x.dimension, x.percent) + " lies outside the table, which goes from " +
                                   format_quantity(low.value, x.dimension) + " to " + format_quantity(high.value, x.dimension),
                               place(call, 1))
                           .help("add a row to the table: values are not guessed beyond its ends"));
  std::size_t k = 1;
  while (k + 1 < rows.size() && x.value > rows[k].first.value) ++k;
  if (rows.size() == 1) return Value{rows[0].second};
  const auto& [x0, y0] = rows[k - 1];
  const auto& [x1, y1] = rows[k];
  const double t = (x.value - x0.value) / (x1.value - x0.value);
  return Value{Quantity{t == 1 ? y1.value : y0.value + t * (y1.value - y0.value), rows[0].second.dimension,
                        y0.percent && y1.percent}};
}

}  // namespace

std::vector<FunctionRecord> list_functions() {
  return {
      {"count", "count(LIST | TEXT)", "how many values a list has, or signs a text", "count([1, 2])", {"list"}, 1, run_count},
      {"first_of", "first_of(LIST)", "its first value", "first_of([3 cm, 5 cm])", {"list"}, 1, run_first},
      {"last_of", "last_of(LIST)", "its last value", "last_of([3 cm, 5 cm])", {"list"}, 1, run_last},
      {"sum", "sum(LIST)", "of numbers or points", "sum([3 cm, 5 cm])", {"list"}, 1, run_sum},
      {"sort",
       "sort(LIST [, FUNCTION])",
       "in rising order, of its values or of what the function makes of them",
       "sort([5 cm, 3 cm])",
       {"list", "by"},
       1,
       run_sort},
      {"reverse",
       "reverse(LIST | CURVE)",
       "the values from the last to the first; a curve walked the other way",
       "reverse([1, 2, 3])",
       {"list"},
       1,
       run_reverse},
      {"map", "map(LIST, FUNCTION)", "what the function makes of each value", "fn half(x) = x / 2; map([1, 2, 3], half)", {"list", "function"}, 2, run_map},
      {"filter",
       "filter(LIST, FUNCTION)",
       "the values for which the function is true",
       "fn large(x) = x > 2 cm; filter([1 cm, 3 cm], large)",
       {"list", "function"},
       2,
       run_filter},
      {"steps",
       "steps(RANGE [, STEP])",
       "the numbers of a range, from its low end in steps of 1 or of STEP",
       "steps(0 cm .. 10 cm, 2 cm)",
       {"range", "step"},
       1,
       run_steps},
      {"joined",
       "joined(LIST [, TEXT])",
       "all values as one text, with TEXT between them",
       "joined([\"a\", \"b\"], \", \")",
       {"list", "between"},
       1,
       run_joined},
      {"text",
       "text(VALUE [, STEP])",
       "the value as a person reads it, rounded to a step",
       "text(123.456 mm, 1 mm)",
       {"value", "step"},
       1,
       run_text},
      {"interpolate",
       "interpolate(TABLE, X)",
       "the value that belongs to X between the rows of a table [[X, Y], ...], along straight lines",
       "interpolate([[36, 84 cm], [40, 92 cm]], 38)",
       {"table", "x"},
       2,
       run_interpolate},
  };
}

}  // namespace garment::interpreter::detail
