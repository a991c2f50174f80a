#include "interpreter/language/edge_course.hpp"

#include <algorithm>

#include "interpreter/language/curve_values.hpp"
#include "runtime/geometry/curve_map.hpp"

namespace garment::interpreter {
namespace {

geometry::Curve course_of(const Program& program, const EdgeSpan& span) {
  const design::Panel& panel = program.panels[static_cast<std::size_t>(span.panel)].panel;
  std::vector<geometry::Curve> links;
  for (const design::EdgePart& part : span.parts) {
    const geometry::Curve piece = geometry::piece_of(design::edge_of(panel, part).curve, std::min(part.from, part.to),
                                                     std::max(part.from, part.to));
    links.push_back(part.from <= part.to ? piece : piece.reversed());
  }
  const geometry::Curve curve = geometry::joined(links);
  return span.backwards ? curve.reversed() : curve;
}

}  // namespace

geometry::Curve eval_course(Program& program, const Expr& expr, Scope& scope, const std::string& what) {
  const Value value = eval(program, expr, scope);
  if (value.as<CurveValue>() != nullptr) return curve_of(program, value, expr.span, what);
  if (value.as<EdgeValue>() == nullptr)
    fail(program, Message("G0306", kind_of(value) + " where " + what + " takes an edge or a curve", expr.span)
                      .help("as in `along front.neck` or `along curve(from: P, to: Q, bulge: 1 cm)`"));
  const EdgeValue edge = *value.as<EdgeValue>();
  std::vector<geometry::Curve> links;
  for (const EdgeSpan& span : edge.spans) {
    if (span.panel != edge.spans[0].panel)
      fail(program, Message("G0442", "`" + show(Value{edge}) + "` runs over two panels; " + what + " takes edges of one", expr.span)
                        .help("copy the edges of each panel one by one"));
    links.push_back(course_of(program, span));
    const double gap = links.size() < 2 ? 0 : (links.back().start() - links[links.size() - 2].end()).norm();
    if (gap > kMeets)
      fail(program, Message("G0442",
                            "`" + span.name + "` starts " + format_quantity(gap, kLength) +
                                " from where the edge before it ends; one course has no gaps",
                            expr.span)
                        .help("is the order right, or one of them to be walked backwards: `a - b`?"));
  }
  return geometry::joined(links);
}

}  // namespace garment::interpreter
