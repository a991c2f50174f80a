// Questions to a recorded curve.
#include "interpreter/language/curve_questions.hpp"
#include "interpreter/language/evaluate.hpp"
#include "interpreter/language/function_table.hpp"

namespace garment::interpreter::detail {
namespace {

/// The curve that the first argument names, and what its two values measure.
struct Asked {
  const CurvePoints* points = nullptr;  // null: of a drape to come
  std::string name;
  Dimension x, y;
};

Span place_of(const Call& call, std::size_t k) { return call.given(k) ? call.places[k]->span : call.expr.span; }

Dimension dimension_of(Program& program, const Expr& expr, Scope& scope) {
  const Value value = eval(program, expr, scope);
  const auto* q = value.as<Quantity>();
  return q == nullptr ? Dimension{} : q->dimension;
}

const RecordAct& record_of(Call& call, const std::string& name) {
  std::string known;
  for (const Act& act : call.program.acts)
    if (const auto* record = std::get_if<RecordAct>(&act.act); record != nullptr && !record->frames) {
      if (record->path == name) return *record;
      known += (known.empty() ? "`" : ", `") + record->path + '`';
    }
  if (call.program.has_error) throw Stop{};  // its `record` may be among what failed
  fail(call.program, Message("G1327", "no curve `" + name + "` is recorded above", place_of(call, 0))
                         .help(known.empty() ? "write `record curve X, Y every TIME as \"" + name + "\"` above the drape"
                                             : "recorded are " + known));
}

Asked asked(Call& call) {
  if (call.program.drape == nullptr)
    fail(call.program,
         Message("G0325", "`" + std::string(call.record.name) + "` is known only after a drape", call.expr.span)
             .help("ask it in `expect` or `measure`"));
  const auto* name = call.arguments[0].as<std::string>();
  if (name == nullptr)
    fail(call.program, Message("G0306", kind_of(call.arguments[0]) + " where `" + std::string(call.record.name) +
                                            "` takes a recorded curve",
                               place_of(call, 0))
                           .help("name it by its file, as in `" + std::string(call.record.example) + '`'));
  const RecordAct& record = record_of(call, *name);
  Asked a;
  a.name = *name;
  Scope& scope = *static_cast<Scope*>(record.scope);
  a.x = dimension_of(call.program, record.statement->operands[1], scope);
  a.y = dimension_of(call.program, record.statement->operands[2], scope);
  if (call.program.drape->stand_in()) return a;
  a.points = call.program.drape->curve(*name);
  if (a.points == nullptr)
    fail(call.program, Message("G1328", "the curve `" + *name + "` has no points yet", place_of(call, 0))
                           .help("curves are recorded in the `drape for` that follows their `record`"));
  return a;
}

double at_of(Call& call, const Asked& a) {
  return as_quantity(call.program, call.arguments[1], place_of(call, 1), a.x, "`" + std::string(call.record.name) + "`").value;
}

RangeValue range_of(Call& call, const Asked& a) {
  const auto* range = call.arguments[1].as<RangeValue>();
  if (range == nullptr)
    fail(call.program, Message("G0306", kind_of(call.arguments[1]) + " where `" + std::string(call.record.name) + "` takes a range",
                               place_of(call, 1))
                           .help("as in `" + std::string(call.record.example) + '`'));
  if (range->from.dimension != a.x && !(is_plain_zero(range->from) && is_plain_zero(range->to)))
    fail(call.program, Message("G0305", "a range of " + describe(range->from.dimension) + "; the first value of `" + a.name + "` is " +
                                            describe(a.x),
                               place_of(call, 1)));
  return *range;
}

[[noreturn]] void fail_off_curve(Call& call, const Asked& a, const std::string& what) {
  double low = 1e300, high = -1e300;
  for (const auto& p : *a.points) {
    low = std::min(low, p[0]);
    high = std::max(high, p[0]);
  }
  fail(call.program, Message("G1328", "`" + a.name + "` does not " + what, place_of(call, 1))
                         .help("its first value goes from " + format_quantity(low, a.x) + " to " + format_quantity(high, a.x)));
}

std::string along(const RangeValue& r) {
  return "go from " + format_quantity(r.from.value, r.from.dimension) + " to " + format_quantity(r.to.value, r.to.dimension);
}

/// What `of` reads from the curve over a range of its first values; in units that `combine` makes of those of both values.
template <class Combine, class Of>
Value over_range(Call& call, const Combine& combine, const Of& of) {
  const Asked a = asked(call);
  const RangeValue r = range_of(call, a);
  const Dimension dimension = combine(a.y, a.x).value_or(kNumber);
  if (a.points == nullptr) return number_value(1, dimension);
  if (const auto value = of(*a.points, r.from.value, r.to.value)) return number_value(*value, dimension);
  fail_off_curve(call, a, along(r));
}

Value run_slope(Call& call) { return over_range(call, quotient, slope_of); }
Value run_work(Call& call) { return over_range(call, product, work_of); }

Value run_reading(Call& call) {
  const Asked a = asked(call);
  const double at = at_of(call, a);
  if (a.points == nullptr) return number_value(1, a.y);
  if (const auto y = reading_of(*a.points, at)) return number_value(*y, a.y);
  fail_off_curve(call, a, "pass " + format_quantity(at, a.x));
}

Value run_loop_width(Call& call) {
  const Asked a = asked(call);
  const double at = at_of(call, a);
  if (a.points == nullptr) return number_value(1, a.y);
  if (const auto w = loop_width_of(*a.points, at)) return number_value(*w, a.y);
  fail_off_curve(call, a, "pass " + format_quantity(at, a.x) + " twice");
}

FunctionRecord question(std::string_view name, std::string_view form, std::string_view doc, std::string_view example,
                        std::string_view second, Value (*run)(Call&)) {
  FunctionRecord record;
  record.name = name;
  record.form = form;
  record.doc = doc;
  record.example = example;
  record.parameters = {"curve", second};
  record.required = 2;
  record.run = run;
  record.asks_drape = true;
  return record;
}

}  // namespace

std::vector<FunctionRecord> record_functions() {
  return {
      question("slope", "slope(CURVE, RANGE)",
               "slope of a recorded curve, where its first value goes through the range for the first time; in the sense of the range",
               "slope(\"pull.csv\", 1 cm .. 2 cm)", "range", run_slope),
      question("work", "work(CURVE, RANGE)", "area below a recorded curve, where its first value goes through the range for the first time",
               "work(\"pull.csv\", 0 cm .. 2 cm)", "range", run_work),
      question("reading", "reading(CURVE, AT)", "second value of a recorded curve, where the first passes a value for the first time",
               "reading(\"pull.csv\", 1 cm)", "at", run_reading),
      question("loop_width", "loop_width(CURVE, AT)",
               "by how much the second value of a recorded curve differs between the way out and the way back", "loop_width(\"pull.csv\", 1 cm)",
               "at", run_loop_width),
  };
}

}  // namespace garment::interpreter::detail
