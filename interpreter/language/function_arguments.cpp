#include "interpreter/language/function_arguments.hpp"

#include <cmath>

#include "interpreter/language/curve_values.hpp"

namespace garment::interpreter::detail {
namespace {

std::string what(const Call& call, std::size_t k) {
  const bool named = call.record.parameters.size() > 1 && k < call.record.parameters.size();
  return called(call) + (named ? " as `" + std::string(call.record.parameters[k]) + "`" : "");
}

design::Point2 as_point(Call& call, const Value& value, Span span, const std::string& name) {
  const auto* p = value.as<PointValue>();
  if (p == nullptr || p->size != 2)
    fail(call.program,
         Message("G0306", kind_of(value) + " where " + name + " takes a point in the plane", span)
             .help("points are written `(x, y)`; edges have `.start`, `.end`, `.middle` and `.at(5 cm)`"));
  const bool zero = p->at[0] == 0 && p->at[1] == 0;
  if (p->dimension != kLength && !zero)
    fail(call.program, Message(p->dimension.none() ? "G0308" : "G0305",
                               "coordinates are " + describe(p->dimension) + " where " + name + " takes a length",
                               span)
                           .help("give them a unit, as in `10 cm`"));
  return {p->at[0], p->at[1]};
}

}  // namespace

Span place(const Call& call, std::size_t k) { return call.given(k) ? call.places[k]->span : call.expr.span; }

std::string called(const Call& call) { return "`" + std::string(call.record.name) + "`"; }

Quantity number_at(Call& call, std::size_t k) {
  const auto* q = call.arguments[k].as<Quantity>();
  if (q == nullptr)
    fail(call.program, Message("G0306", called(call) + " of " + kind_of(call.arguments[k]), place(call, k))
                           .help("it takes numbers"));
  return *q;
}

double length_at(Call& call, std::size_t k) {
  return as_quantity(call.program, call.arguments[k], place(call, k), kLength, what(call, k)).value;
}

double angle_at(Call& call, std::size_t k) {
  return as_quantity(call.program, call.arguments[k], place(call, k), kAngle, what(call, k)).value;
}

design::Point2 point_at(Call& call, std::size_t k) {
  return as_point(call, call.arguments[k], place(call, k), what(call, k));
}

design::Point2 direction_at(Call& call, std::size_t k) {
  const auto& p = *call.arguments[k].as<PointValue>();
  return {p.at[0], p.at[1]};
}

geometry::Curve curve_at(Call& call, std::size_t k) {
  return curve_of(call.program, call.arguments[k], place(call, k), what(call, k));
}

std::vector<design::Point2> points_at(Call& call, std::size_t k) {
  const auto* list = call.arguments[k].as<ListValue>();
  if (list == nullptr) return {point_at(call, k)};
  std::vector<design::Point2> points;
  for (const Value& value : **list) {
    count_step(call.program, place(call, k));
    points.push_back(as_point(call, value, place(call, k), what(call, k)));
  }
  return points;
}

const ListBody& list_at(Call& call, std::size_t k) {
  const auto* list = call.arguments[k].as<ListValue>();
  if (list == nullptr)
    fail(call.program,
         Message("G0306", kind_of(call.arguments[k]) + " where " + what(call, k) + " takes a list", place(call, k))
             .help("lists are written `[a, b, c]`"));
  return **list;
}

double position_at(Call& call, std::size_t k, const geometry::Curve& curve) {
  return position_along(call.program, call.arguments[k], curve.length(), place(call, k), what(call, k));
}

const DrapeMeasures& drape_of(Call& call) {
  if (call.program.drape != nullptr) return *call.program.drape;
  fail(call.program, Message("G0325", called(call) + " is known only after a drape", call.expr.span)
                         .help("ask it in `expect` or `measure`"));
}

Value finite(Call& call, Quantity q) {
  if (!std::isfinite(q.value))
    fail(call.program, Message("G0319", called(call) + " has no finite value here", call.expr.span));
  return Value{q};
}

Value plane_point(const design::Point2& p, int panel) { return Value{PointValue{{p.x(), p.y(), 0}, 2, kLength, panel}}; }

}  // namespace garment::interpreter::detail
