#include "interpreter/language/curve_values.hpp"

#include <cmath>

#include "interpreter/language/collections.hpp"
#include "interpreter/language/evaluate.hpp"

namespace garment::interpreter {
namespace {

using geometry::Curve;
using geometry::Point2;

constexpr double kShortestCurve = 1e-6;    // m
constexpr std::size_t kElementSteps = 50;  // of work with one element of a curve, about
constexpr std::size_t kMaxElements = 100'000;
constexpr std::size_t kCurveBytes = 600;  // of one element with its arc-length table, about

std::size_t size_of(const Curve& curve) {
  if (const auto* through = std::get_if<geometry::Through>(&curve.shape())) return through->points.size() + 1;
  if (const auto* chain = std::get_if<geometry::Chain>(&curve.shape())) return chain->links->size();
  return 1;
}

Curve curve_of_span(const Program& program, const EdgeSpan& span) {
  std::vector<Curve> links;
  for (const design::EdgePart& part : span.parts) {
    const design::Panel& panel = program.panels[static_cast<std::size_t>(part.panel)].panel;
    links.push_back(design::edge_of(panel, part).curve.part(part.from, part.to));
  }
  const Curve curve = geometry::chain(links);
  return span.backwards ? curve.reversed() : curve;
}

/// A gap between two links of a chain, m, and between which; nothing where all meet.
struct Gap {
  std::size_t before = 0;
  double distance = 0;
};
std::optional<Gap> find_gap(const std::vector<Curve>& links) {
  for (std::size_t k = 1; k < links.size(); ++k) {
    const double distance = (links[k].start() - links[k - 1].end()).norm();
    if (!(distance <= kMeets)) return Gap{k - 1, distance};
  }
  return std::nullopt;
}

std::vector<Curve> links_of(const Program& program, const EdgeValue& edge) {
  std::vector<Curve> links;
  for (const EdgeSpan& span : edge.spans) links.push_back(curve_of_span(program, span));
  return links;
}

bool on_one_panel(const EdgeValue& edge) {
  for (const EdgeSpan& span : edge.spans)
    if (span.panel != edge.spans[0].panel) return false;
  return true;
}

[[noreturn]] void fail_gap(Program& program, double distance, const std::string& a, const std::string& b, Span span) {
  fail(program, Message("G0340",
                        a + " ends " + format_quantity(distance, kLength) + " from where " + b +
                            " begins; one curve needs links that meet within 0.01 mm",
                        span)
                    .help("walk a link backwards with `-`, or draw what is missing with `line(P, Q)`"));
}

}  // namespace

std::optional<Curve> as_curve(const Program& program, const Value& value) {
  if (const auto* curve = value.as<CurveValue>()) return (*curve)->curve;
  const auto* edge = value.as<EdgeValue>();
  if (edge == nullptr || edge->spans.empty() || !on_one_panel(*edge)) return std::nullopt;
  const std::vector<Curve> links = links_of(program, *edge);
  if (find_gap(links)) return std::nullopt;
  return geometry::chain(links);
}

Curve curve_of(Program& program, const Value& value, Span span, const std::string& what) {
  if (const auto curve = as_curve(program, value)) {
    // What is done with a curve takes time by its elements: they count as steps.
    program.steps += kElementSteps * size_of(*curve);
    count_step(program, span);
    return *curve;
  }
  const auto* edge = value.as<EdgeValue>();
  if (edge == nullptr || edge->spans.empty())
    fail(program, Message("G0306", kind_of(value) + " where " + what + " takes a curve or an edge", span)
                      .help("curves are edges of panels and what `line`, `curve`, `arc` and `circle` draft"));
  if (!on_one_panel(*edge))
    fail(program, Message("G0340", "`" + show(value) + "` lies on several panels; a curve lies in one plane", span)
                      .help("take the edges of one panel"));
  const std::vector<Curve> links = links_of(program, *edge);
  const Gap gap = *find_gap(links);
  fail_gap(program, gap.distance, "`" + edge->spans[gap.before].name + "`",
           "`" + edge->spans[gap.before + 1].name + "`", span);
}

Curve eval_curve(Program& program, const Expr& expr, Scope& scope, const std::string& what) {
  return curve_of(program, eval(program, expr, scope), expr.span, what);
}

Value curve_value(Program& program, Curve curve, Span span) {
  const double length = curve.length();
  if (!(length >= kShortestCurve))
    fail(program, Message("G0341", "the curve is " + format_quantity(length, kLength) + " long; it needs a length", span)
                      .help("its points must not fall together"));
  if (!(length <= 1e4 && curve.start().cwiseAbs().maxCoeff() <= kFarthest &&
        curve.end().cwiseAbs().maxCoeff() <= kFarthest))
    fail(program, Message("G0341", "the curve reaches further than 100 m", span).help("check the units of its points"));
  if (size_of(curve) > kMaxElements)
    fail(program, Message("G0341", "the curve has more than 100000 pieces", span).help("draw it with fewer points"));
  Charge charge = charge_memory(program, kCurveBytes * size_of(curve), span);
  return Value{CurveValue(std::make_shared<CurveBody>(CurveBody{std::move(curve), std::move(charge)}))};
}

double position_along(Program& program, const Value& value, double length, Span span, const std::string& what) {
  const auto* q = value.as<Quantity>();
  if (q == nullptr || (q->dimension != kLength && !q->dimension.none()))
    fail(program, Message("G0306", kind_of(value) + " where " + what + " takes a length or a fraction", span)
                      .help("as in `5 cm` or `1/3`"));
  const bool fraction = q->dimension.none();
  if (fraction && !(q->value >= 0 && q->value <= 1))
    fail(program,
         Message("G0309", what + " at " + format_quantity(q->value, {}, q->percent) + "; a fraction lies in 0 .. 1", span)
             .help("give a unit for a length: `" + format_quantity(q->value, {}) + " cm`"));
  const double at = fraction ? q->value * length : q->value;
  if (!(at >= -1e-6 && at <= length + 1e-6))
    fail(program,
         Message("G0309", what + " at " + format_quantity(at, kLength) + "; the curve is " +
                              format_quantity(length, kLength) + " long",
                 span)
             .help("prolong it with `extended(curve, after: 5 cm)`"));
  return std::min(std::max(at, 0.0), length);
}

Value join_curves(Program& program, const Value& a, const Value& b, bool backwards, Span span) {
  const Curve first = curve_of(program, a, span, "`+`");
  Curve second = curve_of(program, b, span, "`+`");
  if (backwards) second = second.reversed();
  const double distance = (second.start() - first.end()).norm();
  if (!(distance <= kMeets)) fail_gap(program, distance, "the first curve", "the second", span);
  return curve_value(program, geometry::chain({first, second}), span);
}

}  // namespace garment::interpreter
