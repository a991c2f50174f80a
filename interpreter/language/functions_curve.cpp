// Builtin functions that draft curves.
#include <cmath>

#include "interpreter/language/collections.hpp"
#include "interpreter/language/curve_values.hpp"
#include "interpreter/language/function_arguments.hpp"
#include "runtime/base/portable_math.hpp"

namespace garment::interpreter::detail {
namespace {

using design::Point2;
using geometry::Curve;

constexpr double kOnePoint = 1e-6;  // m, points this near each other are one
constexpr std::size_t kMaxPoints = 100'000;
constexpr std::size_t kPointBytes = 1000;  // of a spline's point, its cubic and their arc-length table, about

/// Both ends of a curve being drafted, which must not fall together.
std::pair<Point2, Point2> ends(Call& call) {
  const Point2 p = point_at(call, 0), q = point_at(call, 1);
  if ((q - p).norm() < kOnePoint)
    fail(call.program, Message("G0341", called(call) + " from " + show(plane_point(p)) + " to the same point", call.expr.span)
                           .help("its two ends must differ"));
  return {p, q};
}

Value run_line(Call& call) {
  const auto [p, q] = ends(call);
  return curve_value(call.program, Curve(p, q), call.expr.span);
}

Value run_spline(Call& call, const Point2& p, const Point2& q, std::size_t k) {
  std::size_t count = 1;
  if (const auto* list = call.arguments[k].as<ListValue>()) count = (*list)->size();
  if (count > kMaxPoints)
    fail(call.program, Message("G0341", "a curve through " + std::to_string(count) + " points; at most 100000 are allowed",
                               place(call, k))
                           .help("draw it with fewer points"));
  const Charge room = charge_memory(call.program, (count + 1) * kPointBytes, place(call, k));
  const std::vector<Point2> points = points_at(call, k);
  Point2 last = p;
  for (std::size_t i = 0; i <= points.size(); ++i) {
    const Point2 next = i < points.size() ? points[i] : q;
    if ((next - last).norm() < kOnePoint)
      fail(call.program, Message("G0341", "two points of the curve fall together at " + show(plane_point(next)),
                                 place(call, k))
                             .help("leave one of them out; the ends are points of the curve already"));
    last = next;
  }
  return curve_value(call.program, Curve(p, q, geometry::Through{points}), call.expr.span);
}

/// Cubic Hermite with handles of a third of the chord; a missing direction aims at the other handle.
Value run_tangents(Call& call, const Point2& p, const Point2& q) {
  const double handle = (q - p).norm() / 3;
  auto aimed = [&](const Point2& from, const Point2& at) -> Point2 {
    const double far = (at - from).norm();
    return far > 0 ? Point2(from + handle / far * (at - from)) : from;
  };
  Point2 a = p, b = q;
  if (call.given(5)) a = p + handle * direction_at(call, 5);
  if (call.given(6)) b = q - handle * direction_at(call, 6);
  if (!call.given(5)) a = aimed(p, b);
  if (!call.given(6)) b = aimed(q, a);
  return curve_value(call.program, Curve(p, q, geometry::Cubic{a, b}), call.expr.span);
}

Value run_curve(Call& call) {
  const auto [p, q] = ends(call);
  const bool tangents = call.given(5) || call.given(6);
  const int ways = call.given(2) + call.given(3) + call.given(4) + tangents;
  if (ways != 1)
    fail(call.program,
         Message("G0307", ways == 0 ? "`curve` needs to know its course" : "`curve` is given two courses", call.expr.span)
             .help("give one of `through: [P, ...]`, `control: P`, `controls: [P, Q]`, or `start:` and `end:` "
                   "directions; a straight one is `line(P, Q)`"));
  if (call.given(2)) return run_spline(call, p, q, 2);
  if (call.given(3))
    return curve_value(call.program, Curve(p, q, geometry::Quadratic{point_at(call, 3)}), call.expr.span);
  if (tangents) return run_tangents(call, p, q);
  const std::vector<Point2> controls = points_at(call, 4);
  if (controls.size() != 2)
    fail(call.program, Message("G0307", "`controls` takes 2 points, here " + std::string(controls.size() == 1 ? "is " : "are ") +
                                            std::to_string(controls.size()),
                               place(call, 4))
                           .help("as in `controls: [P, Q]`; one is `control: P`"));
  return curve_value(call.program, Curve(p, q, geometry::Cubic{controls[0], controls[1]}), call.expr.span);
}

/// Sagitta of the arc from p to q through `at`, positive to the left.
double bulge_through(Call& call, const Point2& p, const Point2& q, const Point2& at) {
  const double half = (q - p).norm() / 2;
  const Point2 t = (q - p) / (2 * half), left(-t.y(), t.x()), d = at - (p + q) / 2;
  const double x = d.dot(t), y = d.dot(left);
  if (std::fabs(y) < kOnePoint)
    fail(call.program, Message("G0341", "the three points of the arc lie on a line", place(call, 4))
                           .help("a straight one is `line(P, Q)`"));
  const double center = (x * x + y * y - half * half) / (2 * y), radius = std::sqrt(half * half + center * center);
  return center + (y > 0 ? radius : -radius);
}

double bulge_of_radius(Call& call, double radius, double half) {
  const double r = std::fabs(radius);
  if (!(r >= half * (1 - 1e-12)))
    fail(call.program, Message("G0309",
                               "a radius of " + format_quantity(r, kLength) + " does not reach over a chord of " +
                                   format_quantity(2 * half, kLength),
                               place(call, 3))
                           .help("it must be " + format_quantity(half, kLength) + " at least"));
  // r - sqrt(r^2 - a^2), written so that flat arcs keep their digits
  const double sagitta = half * half / (r + std::sqrt(std::max(0.0, r * r - half * half)));
  return radius > 0 ? sagitta : -sagitta;
}

Value run_arc(Call& call) {
  const auto [p, q] = ends(call);
  if (call.given(2) + call.given(3) + call.given(4) != 1)
    fail(call.program, Message("G0307", "`arc` needs one of `bulge`, `radius` and `through`", call.expr.span)
                           .help("as in `arc(P, Q, radius: 12 cm)`; a positive one lies to the left of the way from P to Q"));
  const double half = (q - p).norm() / 2;
  double bulge = 0;
  if (call.given(2)) bulge = length_at(call, 2);
  if (call.given(3)) bulge = bulge_of_radius(call, length_at(call, 3), half);
  if (call.given(4)) bulge = bulge_through(call, p, q, point_at(call, 4));
  if (!(std::fabs(bulge) <= 100 * half))
    fail(call.program, Message("G0309", "a bulge of " + format_quantity(bulge, kLength) + " over a chord of " +
                                            format_quantity(2 * half, kLength),
                               call.expr.span)
                           .help("a bulge over half the chord is more than half a circle"));
  return curve_value(call.program, Curve(p, q, geometry::Arc{bulge}), call.expr.span);
}

/// Counter-clockwise from its rightmost point, as `outline circle` is drawn.
Value run_circle(Call& call) {
  const Point2 c = point_at(call, 0);
  const double r = length_at(call, 1);
  if (!(r >= 1e-4 && r <= 100))
    fail(call.program, Message("G0309", "`radius` is " + format_quantity(r, kLength) + "; it must lie in 0.1 mm .. 100 m",
                               place(call, 1)));
  const Point2 right(c.x() + r, c.y()), left(c.x() - r, c.y());
  return curve_value(call.program,
                     geometry::chain({Curve(right, left, geometry::Arc{-r}), Curve(left, right, geometry::Arc{-r})}),
                     call.expr.span);
}

}  // namespace

std::vector<FunctionRecord> curve_functions() {
  return {
      {"line", "line(P, Q)", "the straight line from P to Q", "line((0, 0), (30 cm, 4 cm))", {"from", "to"}, 2, run_line},
      {.name = "curve",
       .form = "curve(P, Q, through: [POINT, ...] | control: POINT | controls: [POINT, POINT] | start: DIRECTION, end: "
               "DIRECTION)",
       .doc = "a curve from P to Q, drawn as an edge with the clause of the same name",
       .example = "curve((0, 0), (20 cm, 8 cm), start: +x, end: 60 deg)",
       .parameters = {"from", "to", "through", "control", "controls", "start", "end"},
       .required = 2,
       .run = run_curve,
       .directions = {"start", "end"}},
      {"arc",
       "arc(P, Q, bulge: LENGTH | radius: LENGTH | through: POINT)",
       "an arc of a circle; a positive bulge or radius lies to the left of the way from P to Q",
       "arc((0, 0), (20 cm, 0), bulge: 3 cm)",
       {"from", "to", "bulge", "radius", "through"},
       2,
       run_arc},
      {"circle",
       "circle(CENTER, RADIUS)",
       "a circle, counter-clockwise from its rightmost point",
       "circle((0, 0), 12 cm)",
       {"center", "radius"},
       2,
       run_circle},
  };
}

}  // namespace garment::interpreter::detail
