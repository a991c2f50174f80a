// Builtin functions that find points and pieces on curves.
#include <cmath>

#include "interpreter/language/collections.hpp"
#include "interpreter/language/curve_values.hpp"
#include "interpreter/language/edges.hpp"
#include "interpreter/language/function_arguments.hpp"
#include "runtime/base/portable_math.hpp"
#include "runtime/geometry/crossings.hpp"
#include "runtime/geometry/offset.hpp"

namespace garment::interpreter::detail {
namespace {

using design::Point2;
using geometry::Curve;

double angle_of(const Point2& way) { return portable::atan2(way.y(), way.x()); }

/// As sewn for edges, else of the curve; of a point its distance from (0, 0).
Value run_length(Call& call) {
  if (const auto* edge = call.arguments[0].as<EdgeValue>())
    return number_value(sewn_length(call.program, *edge), kLength);
  if (const auto* p = call.arguments[0].as<PointValue>())
    return number_value(std::sqrt(p->at[0] * p->at[0] + p->at[1] * p->at[1] + p->at[2] * p->at[2]), p->dimension);
  return number_value(curve_at(call, 0).length(), kLength);
}

Value run_cut_length(Call& call) {
  if (const auto* edge = call.arguments[0].as<EdgeValue>()) return number_value(cut_length(*edge), kLength);
  return number_value(curve_at(call, 0).length(), kLength);
}

Value run_along(Call& call) {
  const Curve curve = curve_at(call, 0);
  return plane_point(curve.point_at(position_at(call, 1, curve)));
}

Value run_tangent(Call& call) {
  const Curve curve = curve_at(call, 0);
  return number_value(angle_of(curve.tangent_at(position_at(call, 1, curve))), kAngle);
}

Value run_normal(Call& call) {
  const Curve curve = curve_at(call, 0);
  const Point2 t = curve.tangent_at(position_at(call, 1, curve));
  return number_value(angle_of({-t.y(), t.x()}), kAngle);
}

Value run_nearest(Call& call) {
  const Curve curve = curve_at(call, 1);
  return plane_point(curve.point_at(curve.nearest(point_at(call, 0))));
}

Value run_length_to(Call& call) {
  const Curve curve = curve_at(call, 0);
  const Point2 p = point_at(call, 1);
  const double at = curve.nearest(p), off = (curve.point_at(at) - p).norm();
  if (!(off <= 1e-4))
    fail(call.program, Message("G0344",
                               "the point " + show(plane_point(p)) + " lies " + format_quantity(off, kLength) +
                                   " off the curve; a point on it is wanted (within 0.1 mm)",
                               place(call, 1))
                           .help("the nearest point of the curve is `nearest(P, CURVE)`"));
  return number_value(at, kLength);
}

/// Foot of the perpendicular from a point: the nearest point of the curve, where the way to it is square to the curve.
Value run_foot(Call& call) {
  const Point2 p = point_at(call, 0);
  const Curve curve = curve_at(call, 1);
  const double at = curve.nearest(p);
  const Point2 foot = curve.point_at(at), way = p - foot, t = curve.tangent_at(at);
  const double beyond = std::fabs(way.dot(t));
  if (beyond > 1e-7 + 1e-6 * way.norm()) {
    const bool start = at < curve.length() / 2;
    fail(call.program,
         Message("G0344",
                 "no perpendicular from " + show(plane_point(p)) + " meets the curve: it would stand " +
                     format_quantity(beyond, kLength) + (start ? " before its start" : " beyond its end"),
                 call.expr.span)
             .help("prolong it, as in `foot(P, extended(CURVE, " + std::string(start ? "before: " : "after: ") +
                   format_quantity(std::ceil(beyond * 100 + 1) / 100, kLength) +
                   "))`, or take `nearest(P, CURVE)`"));
  }
  return plane_point(foot);
}

std::string listed_crossings(const std::vector<geometry::Crossing>& found) {
  std::string text;
  for (std::size_t k = 0; k < found.size() && k < 4; ++k)
    text += (k > 0 ? ", " : "") + show(plane_point(found[k].point));
  return text + (found.size() > 4 ? ", ..." : "");
}

geometry::Crossings checked_crossings(Call& call, const Curve& a, const Curve& b) {
  call.program.steps += 5000;  // about what the search costs beside the elements of the curves
  geometry::Crossings crossings = geometry::crossings_of(a, b);
  if (crossings.overlap || crossings.too_many)
    fail(call.program, Message("G0345", "the two curves run along each other: they have no single points in common",
                               call.expr.span)
                           .also(place(call, 0), "from " + show(plane_point(a.start())) + " to " + show(plane_point(a.end())))
                           .also(place(call, 1), "from " + show(plane_point(b.start())) + " to " + show(plane_point(b.end())))
                           .help("name the point you mean by its place on one of them: `along(curve, 5 cm)`"));
  return crossings;
}

[[noreturn]] void fail_apart(Call& call, const Curve& a, const Curve& b) {
  const geometry::Approach near = geometry::nearest_approach(a, b);
  auto described = [](const Curve& c) {
    return format_quantity(c.length(), kLength) + " long, from " + show(plane_point(c.start())) + " to " +
           show(plane_point(c.end()));
  };
  fail(call.program, Message("G0346",
                             "the two curves do not meet: they come to " + format_quantity(near.distance, kLength) +
                                 " of each other near " + show(plane_point(a.point_at(near.on_a))),
                             call.expr.span)
                         .also(place(call, 0), described(a))
                         .also(place(call, 1), described(b))
                         .help("if one is too short, prolong it: `extended(CURVE, after: 10 cm)`; parallel lines never meet"));
}

Value run_intersections(Call& call) {
  const Curve a = curve_at(call, 0), b = curve_at(call, 1);
  const geometry::Crossings crossings = checked_crossings(call, a, b);
  ListBuilder list(call.program, crossings.found.size(), call.expr.span);
  for (const geometry::Crossing& at : crossings.found) list.add(plane_point(at.point));
  return list.finish();
}

Value run_intersection(Call& call) {
  const Curve a = curve_at(call, 0), b = curve_at(call, 1);
  const geometry::Crossings crossings = checked_crossings(call, a, b);
  const std::vector<geometry::Crossing>& found = crossings.found;
  if (found.empty()) fail_apart(call, a, b);
  if (call.given(2) && call.given(3))
    fail(call.program, Message("G0307", "`intersection` takes `which` or `near`, not both", call.expr.span));
  if (call.given(3)) {
    const Point2 wanted = point_at(call, 3);
    const geometry::Crossing* best = &found[0];
    for (const geometry::Crossing& at : found)
      if ((at.point - wanted).norm() < (best->point - wanted).norm()) best = &at;
    return plane_point(best->point);
  }
  if (call.given(2)) {
    const Quantity q = number_at(call, 2);
    const double n = static_cast<double>(found.size());
    if (!q.dimension.none() || q.value != std::floor(q.value) || !(q.value >= 1 && q.value <= n))
      fail(call.program, Message("G0309",
                                 "`which` is " + format_quantity(q.value, q.dimension) + "; the curves meet in " +
                                     std::to_string(found.size()) + (found.size() == 1 ? " point" : " points"),
                                 place(call, 2))
                             .help("along the first curve they are " + listed_crossings(found)));
    return plane_point(found[static_cast<std::size_t>(q.value) - 1].point);
  }
  if (found.size() > 1)
    fail(call.program, Message("G0347", "the two curves meet in " + std::to_string(found.size()) + " points: " + listed_crossings(found),
                               call.expr.span)
                           .help("say which, along the first curve: `which: 1`; or near what: `near: (x, y)`; all of them "
                                 "are `intersections(a, b)`"));
  return plane_point(found[0].point);
}

Value run_offset(Call& call) {
  const Curve curve = curve_at(call, 0);
  const double distance = length_at(call, 1);
  const geometry::OffsetResult beside = geometry::offset_curve(curve, distance);
  if (beside.curve) return curve_value(call.program, *beside.curve, call.expr.span);
  const std::string where = show(plane_point(curve.point_at(beside.at)));
  fail(call.program, Message("G0348",
                             beside.tight ? "an offset of " + format_quantity(distance, kLength) +
                                                " folds back on itself: the curve bends tighter than that near " + where
                                          : "the corner of the curve at " + where + " is too sharp for an offset",
                             call.expr.span)
                         .help(beside.tight ? "take a smaller offset, or the other side (positive is to the left)"
                                            : "offset the pieces by themselves"));
}

Value run_split(Call& call) {
  const Curve curve = curve_at(call, 0);
  double at = 0;
  if (call.arguments[1].as<PointValue>() != nullptr) {
    const Point2 p = point_at(call, 1);
    at = curve.nearest(p);
    const double off = (curve.point_at(at) - p).norm();
    if (!(off <= 1e-4))
      fail(call.program, Message("G0344", "the point " + show(plane_point(p)) + " lies " + format_quantity(off, kLength) +
                                              " off the curve",
                                 place(call, 1))
                             .help("split at a length, a fraction, or `nearest(P, CURVE)`"));
  } else {
    at = position_at(call, 1, curve);
  }
  if (!(at > 1e-6 && at < curve.length() - 1e-6))
    fail(call.program, Message("G0309", "a split at " + format_quantity(at, kLength) + " of a curve of " +
                                            format_quantity(curve.length(), kLength) + ": one piece would be nothing",
                               place(call, 1)));
  ListBuilder list(call.program, 2, call.expr.span);
  list.add(curve_value(call.program, curve.part(0, at), call.expr.span));
  list.add(curve_value(call.program, curve.part(at, curve.length()), call.expr.span));
  return list.finish();
}

Value run_extended(Call& call) {
  const Curve curve = curve_at(call, 0);
  double lengths[2] = {0, 0};
  if (!call.given(1) && !call.given(2))
    fail(call.program, Message("G0307", "`extended` needs `before` or `after`", call.expr.span)
                           .help("as in `extended(curve, after: 5 cm)`"));
  for (std::size_t k : {1u, 2u}) {
    if (!call.given(k)) continue;
    lengths[k - 1] = length_at(call, k);
    if (!(lengths[k - 1] >= 0 && lengths[k - 1] <= 100))
      fail(call.program, Message("G0309", "prolonged by " + format_quantity(lengths[k - 1], kLength) +
                                              "; it must lie in 0 .. 100 m",
                                 place(call, k)));
  }
  return curve_value(call.program, geometry::prolonged(curve, lengths[0], lengths[1]), call.expr.span);
}

}  // namespace

std::vector<FunctionRecord> crossing_functions() {
  return {
      {"length",
       "length(EDGE | CURVE | POINT)",
       "of an edge as sewn: darts closed; of a curve; of a point its distance from (0, 0)",
       "length(line((0, 0), (3 cm, 4 cm)))",
       {"edge"},
       1,
       run_length},
      {"cut_length",
       "cut_length(EDGE | CURVE)",
       "of an edge as cut: darts open",
       "cut_length(front.waist)",
       {"edge"},
       1,
       run_cut_length},
      {"along",
       "along(CURVE, LENGTH | FRACTION)",
       "the point at that place along a curve or an edge",
       "along(line((0, 0), (12 cm, 0)), 1/3)",
       {"curve", "at"},
       2,
       run_along},
      {"tangent",
       "tangent(CURVE, LENGTH | FRACTION)",
       "the direction of a curve at a place, as an angle from +x",
       "tangent(arc((0, 0), (12 cm, 0), bulge: 2 cm), 0)",
       {"curve", "at"},
       2,
       run_tangent},
      {"normal",
       "normal(CURVE, LENGTH | FRACTION)",
       "the direction square to a curve at a place, to its left, as an angle from +x",
       "normal(line((0, 0), (12 cm, 0)), 50%)",
       {"curve", "at"},
       2,
       run_normal},
      {"nearest",
       "nearest(P, CURVE)",
       "the point of a curve nearest to P",
       "nearest((5 cm, 3 cm), line((0, 0), (12 cm, 0)))",
       {"p", "curve"},
       2,
       run_nearest},
      {"foot",
       "foot(P, CURVE)",
       "where the perpendicular from P meets a curve",
       "foot((5 cm, 3 cm), line((0, 0), (12 cm, 0)))",
       {"p", "curve"},
       2,
       run_foot},
      {"length_to",
       "length_to(CURVE, P)",
       "how far along a curve the point P of it lies",
       "length_to(line((0, 0), (12 cm, 0)), (5 cm, 0))",
       {"curve", "p"},
       2,
       run_length_to},
      {"intersection",
       "intersection(CURVE, CURVE [, which: N | near: POINT])",
       "the point where two curves meet; of several the N-th along the first, or the one nearest to a point",
       "intersection(line((0, 0), (8 cm, 8 cm)), line((0, 4 cm), (8 cm, 4 cm)))",
       {"a", "b", "which", "near"},
       2,
       run_intersection},
      {"intersections",
       "intersections(CURVE, CURVE)",
       "all points where two curves meet, along the first; maybe none",
       "count(intersections(circle((0, 0), 5 cm), line((-9 cm, 0), (9 cm, 0))))",
       {"a", "b"},
       2,
       run_intersections},
      {"offset",
       "offset(CURVE, LENGTH)",
       "the curve that far to the left (to the right where negative), walked the same way",
       "offset(line((0, 0), (12 cm, 0)), 1 cm)",
       {"curve", "by"},
       2,
       run_offset},
      {"split",
       "split(CURVE, LENGTH | FRACTION | POINT)",
       "the two pieces of a curve, as a list",
       "split(line((0, 0), (12 cm, 0)), 1/3)",
       {"curve", "at"},
       2,
       run_split},
      {"extended",
       "extended(CURVE, before: LENGTH, after: LENGTH)",
       "the curve prolonged straight before its start or after its end",
       "extended(line((0, 0), (12 cm, 0)), after: 5 cm)",
       {"curve", "before", "after"},
       1,
       run_extended},
  };
}

}  // namespace garment::interpreter::detail
