// Builtin functions on points and directions: the ruler and protractor of a pattern maker.
#include <cmath>

#include "interpreter/language/collections.hpp"
#include "interpreter/language/curve_values.hpp"
#include "interpreter/language/function_arguments.hpp"
#include "runtime/base/portable_math.hpp"

namespace garment::interpreter::detail {
namespace {

using design::Point2;
using geometry::Curve;

constexpr double kCoincident = 1e-9;  // m

const PointValue& any_point(Call& call, std::size_t k) {
  const auto* p = call.arguments[k].as<PointValue>();
  if (p == nullptr)
    fail(call.program, Message("G0306", kind_of(call.arguments[k]) + " where " + called(call) + " takes a point",
                               place(call, k))
                           .help("points are written `(x, y)`; edges have `.start`, `.end`, `.middle` and `.at(5 cm)`"));
  return *p;
}

/// Two points of as many coordinates and of one dimension.
std::pair<PointValue, PointValue> two_points(Call& call) {
  PointValue p = any_point(call, 0), q = any_point(call, 1);
  if (p.size != q.size)
    fail(call.program, Message("G0306",
                               called(call) + " of " + kind_of(Value{p}) + " and " + kind_of(Value{q}), call.expr.span)
                           .help("both need as many coordinates"));
  auto zero = [](const PointValue& v) { return v.at[0] == 0 && v.at[1] == 0 && v.at[2] == 0; };
  if (zero(p)) p.dimension = q.dimension;
  if (zero(q)) q.dimension = p.dimension;
  if (p.dimension != q.dimension)
    fail(call.program, Message("G0305",
                               called(call) + " between coordinates that are " + describe(p.dimension) + " and " +
                                   describe(q.dimension),
                               call.expr.span)
                           .help("give all coordinates the same kind of unit"));
  return {p, q};
}

double apart(const PointValue& p, const PointValue& q) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += (p.at[k] - q.at[k]) * (p.at[k] - q.at[k]);
  return std::sqrt(sum);
}

Value run_distance(Call& call) {
  const auto [p, q] = two_points(call);
  return finite(call, {apart(p, q), p.dimension, false});
}

Value run_dot(Call& call) {
  const auto [p, q] = two_points(call);
  const auto dimension = product(p.dimension, q.dimension);
  if (!dimension) fail(call.program, Message("G0305", "the unit of the result has exponents past 60", call.expr.span));
  return finite(call, {p.at[0] * q.at[0] + p.at[1] * q.at[1] + p.at[2] * q.at[2], *dimension, false});
}

Value run_polar(Call& call) {
  return plane_point(point_at(call, 0) + length_at(call, 2) * direction_at(call, 1));
}

Value run_toward(Call& call) {
  const auto [p, q] = two_points(call);
  const Quantity way = number_at(call, 2);
  double t = way.value;
  if (way.dimension == p.dimension && !way.dimension.none()) {
    const double far = apart(p, q);
    if (far == 0)
      fail(call.program, Message("G0342", "no way leads from " + show(Value{p}) + " to the same point", call.expr.span)
                             .help("a direction and a length give a point too: `polar(P, 30 deg, 5 cm)`"));
    t = way.value / far;
  } else if (!way.dimension.none()) {
    fail(call.program, Message("G0306", describe(way.dimension) + " where `toward` takes a fraction or a length",
                               place(call, 2))
                           .help("as in `1/3` or `5 cm`"));
  }
  PointValue r = p;
  for (std::size_t k = 0; k < 3; ++k) r.at[k] += t * (q.at[k] - p.at[k]);
  r.panel = -1;
  return Value{r};
}

/// Direction of a vector; refuses one without length.
double direction_of(Call& call, const Point2& way, const std::string& what) {
  if (way.norm() < kCoincident)
    fail(call.program, Message("G0342", what + " fall together: there is no direction", call.expr.span)
                           .help("give points that differ"));
  return portable::atan2(way.y(), way.x());
}

double between(Call& call, const Point2& a, const Point2& b) {
  double turn = direction_of(call, b, "two of the points") - direction_of(call, a, "two of the points");
  if (turn < 0) turn = -turn;
  return turn > portable::kPi ? 2 * portable::kPi - turn : turn;
}

//   angle(line)     from +x, of the way from its start to its end
//   angle(P, Q)     from +x, of the way from P to Q
//   angle(P, Q, R)  at Q between the ways to P and to R, 0 .. 180 deg
Value run_angle(Call& call) {
  if (!call.given(1)) {
    const Curve curve = curve_at(call, 0);
    return number_value(direction_of(call, curve.end() - curve.start(), "its ends"), kAngle);
  }
  const Point2 p = point_at(call, 0), q = point_at(call, 1);
  if (!call.given(2)) return number_value(direction_of(call, q - p, "the two points"), kAngle);
  return number_value(between(call, p - q, point_at(call, 2) - q), kAngle);
}

/// A point or curve moved in the plane.
Value moved(Call& call, const Eigen::Isometry2d& motion) {
  if (const auto* list = call.arguments[0].as<ListValue>()) {
    const ListValue kept = *list;
    ListBuilder out(call.program, kept->size(), call.expr.span);
    for (const Value& value : *kept) {
      count_step(call.program, call.expr.span);
      call.arguments[0] = value;
      out.add(moved(call, motion));
    }
    return out.finish();
  }
  if (call.arguments[0].as<PointValue>() != nullptr) return plane_point(motion * point_at(call, 0));
  return curve_value(call.program, curve_at(call, 0).transformed(motion), call.expr.span);
}

/// The line to mirror about: a straight curve or edge, or two points.
std::pair<Point2, Point2> axis(Call& call) {
  if (call.given(2)) return {point_at(call, 1), point_at(call, 2)};
  const Curve line = curve_at(call, 1);
  const Point2 way = line.end() - line.start();
  if (!(way.norm() >= line.length() * (1 - 1e-6)))
    fail(call.program, Message("G0343", "`mirror` about a curve: it is " + format_quantity(line.length(), kLength) +
                                            " long and its ends are " + format_quantity(way.norm(), kLength) + " apart",
                               place(call, 1))
                           .help("mirror about a straight line, or about two points: `mirror(x, P, Q)`"));
  return {line.start(), line.end()};
}

Value run_mirror(Call& call) {
  const auto [p, q] = axis(call);
  if ((q - p).norm() < kCoincident)
    fail(call.program, Message("G0342", "the two points of the axis fall together", call.expr.span)
                           .help("give points that differ"));
  const Point2 t = (q - p).normalized();
  Eigen::Isometry2d motion = Eigen::Isometry2d::Identity();
  Eigen::Matrix2d linear = 2 * t * t.transpose() - Eigen::Matrix2d::Identity();
  motion.linear() = linear;
  motion.translation() = p - linear * p;
  return moved(call, motion);
}

Value run_rotate(Call& call) {
  const Point2 center = point_at(call, 1);
  const double angle = angle_at(call, 2), c = portable::cos(angle), s = portable::sin(angle);
  Eigen::Isometry2d motion = Eigen::Isometry2d::Identity();
  motion.linear() << c, -s, s, c;
  motion.translation() = center - motion.linear() * center;
  return moved(call, motion);
}

Value run_shift(Call& call) {
  Eigen::Isometry2d motion = Eigen::Isometry2d::Identity();
  motion.translation() = point_at(call, 1);
  return moved(call, motion);
}

}  // namespace

std::vector<FunctionRecord> point_functions() {
  return {
      {"distance", "distance(P, Q)", "between two points", "distance((0, 0), (3 cm, 4 cm))", {"p", "q"}, 2, run_distance},
      {"angle",
       "angle(P, Q) | angle(LINE) | angle(P, Q, R)",
       "of the way from P to Q, or along a line, from +x; with three points the angle at Q between the ways to P and R",
       "angle((0, 0), (3 cm, 3 cm))",
       {"p", "q", "r"},
       1,
       run_angle},
      {.name = "polar",
       .form = "polar(P, DIRECTION, LENGTH)",
       .doc = "the point that far from P, in that direction: an angle from +x, or +x, -x, +y, -y",
       .example = "polar((0, 0), 30 deg, 10 cm)",
       .parameters = {"p", "direction", "length"},
       .required = 3,
       .run = run_polar,
       .directions = {"direction"}},
      {"toward",
       "toward(P, Q, FRACTION | LENGTH)",
       "the point that far on the way from P to Q",
       "toward((0, 0), (30 cm, 0), 1/3)",
       {"p", "q", "way"},
       3,
       run_toward},
      {"dot", "dot(P, Q)", "sum of the products of the coordinates", "dot((1, 2), (3, 4))", {"p", "q"}, 2, run_dot},
      {"mirror",
       "mirror(POINT | CURVE | LIST, LINE) | mirror(..., P, Q)",
       "mirrored about a straight line, or about the line through two points",
       "mirror((3 cm, 1 cm), line((0, 0), (0, 10 cm)))",
       {"what", "about", "q"},
       2,
       run_mirror},
      {"rotate",
       "rotate(POINT | CURVE | LIST, CENTER, ANGLE)",
       "turned counter-clockwise about a point",
       "rotate((10 cm, 0), (0, 0), 90 deg)",
       {"what", "about", "angle"},
       3,
       run_rotate},
      {"shift",
       "shift(POINT | CURVE | LIST, (DX, DY))",
       "moved without turning",
       "shift((1 cm, 0), (0, 2 cm))",
       {"what", "by"},
       2,
       run_shift},
  };
}

}  // namespace garment::interpreter::detail
