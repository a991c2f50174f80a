#include "interpreter/language/outline.hpp"

#include <cmath>

#include "interpreter/language/clauses.hpp"
#include "runtime/base/portable_math.hpp"

namespace garment::interpreter {
namespace {

using design::Point2;
using geometry::Curve;

constexpr double kShortest = 1e-4;  // m, the shortest edge
constexpr double kSnap = 1e-5;      // m, an outline that ends this near its start is closed
constexpr double kFarthest = 100;   // m

class EdgeDrawer {
 public:
  EdgeDrawer(Program& program, const RecipeItem& item, const Point2& from, const Point2& first)
      : program_(program),
        overrides_(item.overrides),
        clauses_(program, *item.statement, *item.scope, &overrides_),
        name_(item.name),
        span_(item.statement->span),
        name_span_(item.statement->name ? item.statement->name->span : item.statement->span),
        closes_(item.statement->keyword.text == "close"),
        from_(from),
        first_(first) {}

  design::Edge draw() {
    to_ = end_point();
    if ((to_ - from_).norm() == 0 && closes_)
      fail(program_,
           Message("G0403", "edge `" + name_ + "` has no length: the outline is already closed", name_span_)
               .help("leave `close " + name_ + "` out"));
    if (!(to_.cwiseAbs().maxCoeff() <= kFarthest))
      fail(program_, Message("G0309", "edge `" + name_ + "` ends more than 100 m away", name_span_));
    design::Edge edge;
    edge.name = name_;
    edge.curve = Curve(from_, to_, shape());
    edge.free = clauses_.flag("free");
    clauses_.finish();
    if (!(edge.curve.length() >= kShortest))
      fail(program_, Message("G0403",
                             "edge `" + name_ + "` is " + format_mm(edge.curve.length()) +
                                 " long; an edge needs 0.1 mm at least",
                             name_span_));
    edge.origin = program_.origin(span_);
    return edge;
  }

 private:
  Point2 point(const Expr& expr, Scope& scope, const std::string& what, bool relative) {
    const PointValue p = eval_point(program_, expr, scope, 2, kLength, what);
    return relative ? Point2(from_.x() + p.at[0], from_.y() + p.at[1]) : Point2(p.at[0], p.at[1]);
  }

  Point2 end_point() {
    const BoundClause* to = clauses_.find("to");
    const BoundClause* by = clauses_.find("by");
    const BoundClause* heading = clauses_.find("heading");
    const int ways = (to != nullptr) + (by != nullptr) + (heading != nullptr);
    if (closes_ && ways > 0)
      fail(program_,
           Message("G0313", "`close` goes back to where the outline began; it takes no end", name_span_));
    if (closes_) return first_;
    if (const BoundClause* along = ways == 0 ? clauses_.find("along") : nullptr)
      fail(
          program_,
          Message("G0315", "`along` of `edge` is not supported yet", along->clause->span).help(kStillToCome));
    if (ways != 1)
      fail(program_,
           Message(ways == 0 ? "G0312" : "G0415",
                   "edge `" + name_ + "` " + (ways == 0 ? "has no end" : "has more than one end"), name_span_)
               .help("write `to POINT`, `by (DX, DY)` or `heading DIRECTION length LENGTH`"));
    if (to != nullptr) return point(clauses_.value(*to), *to->scope, "`to`", false);
    if (by != nullptr) {
      relative_ = true;
      return point(clauses_.value(*by), *by->scope, "`by`", true);
    }
    const Point2 way = eval_direction(program_, clauses_.value(*heading), *heading->scope, "`heading`");
    const auto length = clauses_.quantity("length");
    if (!length)
      fail(program_, Message("G0312", "`heading` needs `length`", heading->clause->span)
                         .help("as in `heading 30 deg length 12 cm`"));
    relative_ = true;
    return from_ + *length * way;
  }

  Curve::Shape shape() {
    const std::vector<std::string> words = {"control", "controls", "arc", "through", "tangents", "bulge"};
    std::vector<std::string> given;
    for (const std::string& word : words)
      if (clauses_.has(word) && !(word == "through" && clauses_.has("arc"))) given.push_back(word);
    if (given.empty()) return geometry::Line{};
    if (given.size() > 1)
      fail(program_,
           Message("G0415", "edge `" + name_ + "` has two curves: `" + given[0] + "` and `" + given[1] + "`",
                   name_span_)
               .help("one edge is one curve; split it or leave one out"));
    if (given[0] == "bulge") return geometry::Arc{checked_bulge(*clauses_.quantity("bulge"))};
    const BoundClause& clause = *clauses_.find(given[0]);
    if (given[0] == "arc") return arc(clause);
    if (given[0] == "tangents") return tangents(clause);
    const std::vector<Point2> points = this->points(clause);
    if (given[0] == "through") return geometry::Through{points};
    const std::size_t wanted = given[0] == "control" ? 1 : 2;
    if (points.size() != wanted)
      fail(program_,
           Message("G0307",
                   "`" + given[0] + "` takes " + std::to_string(wanted) +
                       (wanted == 1 ? " point" : " points") + ", here are " + std::to_string(points.size()),
                   clause.clause->span));
    if (wanted == 1) return geometry::Quadratic{points[0]};
    return geometry::Cubic{points[0], points[1]};
  }

  std::vector<Point2> points(const BoundClause& clause) {
    std::vector<Point2> points;
    for (const Expr& expr : clause.clause->values)
      points.push_back(point(expr, *clause.scope, "`" + clause.clause->word.text + "`", relative_));
    if (points.empty())
      fail(program_,
           Message("G0312", "`" + clause.clause->word.text + "` needs a point", clause.clause->span));
    for (const Point2& p : points)
      if (!(p.cwiseAbs().maxCoeff() <= kFarthest))
        fail(program_, Message("G0309", "a point of edge `" + name_ + "` lies more than 100 m away",
                               clause.clause->span));
    if (clause.clause->word.text == "through") {
      Point2 last = from_;
      for (std::size_t k = 0; k <= points.size(); ++k) {
        const Point2 next = k < points.size() ? points[k] : to_;
        if ((next - last).norm() < kSnap)
          fail(program_,
               Message("G0403", "two points of edge `" + name_ + "` fall together", clause.clause->span));
        last = next;
      }
    }
    return points;
  }

  double checked_bulge(double bulge) {
    const double chord = (to_ - from_).norm();
    if (!(std::fabs(bulge) <= 50 * chord))
      fail(program_, Message("G0413",
                             "a bulge of " + format_quantity(bulge, kLength) + " over a chord of " +
                                 format_quantity(chord, kLength),
                             name_span_)
                         .help("a bulge over half the chord is more than half a circle"));
    return bulge;
  }

  Curve::Shape arc(const BoundClause& clause) {
    const std::vector<Expr>& values = clause.clause->values;
    const Point2 chord = to_ - from_;
    const double half = chord.norm() / 2;
    if (const BoundClause* through = clauses_.find("through")) {
      if (!values.empty())
        fail(program_, Message("G0415", "`arc` takes a radius or a point, not both", clause.clause->span));
      if (through->clause->values.size() != 1)
        fail(program_, Message("G0307", "`arc through` takes one point", through->clause->span));
      const Point2 p =
          point(through->clause->values[0], *through->scope, "`arc through`", relative_) - (from_ + to_) / 2;
      if (half < kShortest / 2) fail(program_, Message("G0403", "the arc's ends fall together", name_span_));
      const Point2 t = chord / (2 * half), left(-t.y(), t.x());
      const double x = p.dot(t), y = p.dot(left);
      if (std::fabs(y) < 1e-7 && std::fabs(x) < half) return geometry::Line{};
      if (std::fabs(y) < 1e-7)
        fail(program_, Message("G0413", "no arc goes through three points on a line in this order",
                               through->clause->span));
      const double center = (x * x + y * y - half * half) / (2 * y);
      const double radius = std::sqrt(half * half + center * center);
      return geometry::Arc{checked_bulge(center + (y > 0 ? radius : -radius))};
    }
    if (values.size() != 2 || values[0].kind != ExprKind::name || values[0].text != "radius")
      fail(program_, Message("G0313", "`arc` takes `radius LENGTH` or `through POINT`", clause.clause->span));
    const double radius = eval_quantity(program_, values[1], *clause.scope, kLength, "`radius`").value;
    if (!(std::fabs(radius) >= half) || std::fabs(radius) > 1e4)
      fail(program_, Message("G0413",
                             "a radius of " + format_quantity(std::fabs(radius), kLength) +
                                 " does not reach over a chord of " + format_quantity(2 * half, kLength),
                             values[1].span)
                         .help("it must be " + format_quantity(half, kLength) + " at least"));
    // r - sqrt(r^2 - a^2), written so that flat arcs keep their digits
    const double r = std::fabs(radius);
    const double sagitta = half * half / (r + std::sqrt(r * r - half * half));
    return geometry::Arc{radius > 0 ? sagitta : -sagitta};
  }

  Curve::Shape tangents(const BoundClause& clause) {
    const std::vector<Expr>& values = clause.clause->values;
    std::optional<Point2> start, end;
    for (std::size_t k = 0; k < values.size(); k += 2) {
      const bool at_start = values[k].kind == ExprKind::name && values[k].text == "start";
      const bool at_end = values[k].kind == ExprKind::name && values[k].text == "end";
      std::optional<Point2>& side = at_start ? start : end;
      if ((!at_start && !at_end) || k + 1 >= values.size() || side)
        fail(program_,
             Message("G0313", "`tangents` takes `start DIRECTION` and `end DIRECTION`", clause.clause->span)
                 .help("as in `tangents start +x end -y`"));
      side = eval_direction(program_, values[k + 1], *clause.scope, "`tangents`");
    }
    if (!start && !end)
      fail(program_, Message("G0312", "`tangents` needs a direction", clause.clause->span)
                         .help("as in `tangents start +x`"));
    // Cubic Hermite with both derivatives as long as the chord.
    const double handle = (to_ - from_).norm() / 3;
    Point2 a = from_, b = to_;
    if (start) a = from_ + handle * *start;
    if (end) b = to_ - handle * *end;
    if (!start) a = from_ + aimed(from_, b, handle);
    if (!end) b = to_ + aimed(to_, a, handle);
    return geometry::Cubic{a, b};
  }

  static Point2 aimed(const Point2& from, const Point2& at, double length) {
    const double far = (at - from).norm();
    return far > 0 ? Point2(length / far * (at - from)) : Point2(0, 0);
  }

  Program& program_;
  std::vector<Override> overrides_;
  Clauses clauses_;
  std::string name_;
  Span span_, name_span_;
  bool closes_ = false, relative_ = false;
  Point2 from_, first_, to_;
};

std::vector<design::Edge> circle(Program& program, const Recipe& recipe, Clauses& clauses,
                                 std::vector<Span>& spans) {
  const RecipeItem& item = recipe.outline;
  const Expr& call = item.statement->operands[0];
  const bool named = call.kind == ExprKind::call && call.children[0].kind == ExprKind::name &&
                     call.children[0].text == "circle" && call.children.size() == 3;
  if (!named || item.statement->operands.size() != 1)
    fail(program,
         Message("G0313", "an outline starts `from POINT` or is `circle(CENTER, RADIUS)`", call.span));
  const Expr *center = &call.children[1], *radius = &call.children[2];
  if (call.labels.size() > 1 && call.labels[0].text == "radius") std::swap(center, radius);
  const PointValue c = eval_point(program, *center, *item.scope, 2, kLength, "`center`");
  const double r = eval_quantity(program, *radius, *item.scope, kLength, "`radius`").value;
  if (!(r >= 5e-3 && r <= kFarthest))
    fail(program,
         Message("G0309", "`radius` is " + format_quantity(r, kLength) + "; it must lie in 5 mm .. 100 m",
                 radius->span));
  std::string name = "rim";
  if (const BoundClause* as = clauses.find("as")) {
    const Expr& expr = clauses.value(*as);
    if (expr.kind != ExprKind::name) fail(program, Message("G0306", "`as` takes a name", expr.span));
    name = name_of(program, expr, *as->scope);
  }
  if (!recipe.fold.empty())
    fail(program, Message("G0404", "a circle has no straight edge to fold on", recipe.fold_span)
                      .help("draw half of it: `edge rim to ... arc radius R`, `close fold_line`"));
  const bool free = clauses.flag("free");
  const Point2 right(c.at[0] + r, c.at[1]), left(c.at[0] - r, c.at[1]);
  std::vector<design::Edge> edges(2);
  // Counter-clockwise: the arcs bulge to the right of the way walked.
  edges[0] = {name + ".1", program.origin(item.statement->span), Curve(right, left, geometry::Arc{-r}), free};
  edges[1] = {name + ".2", program.origin(item.statement->span), Curve(left, right, geometry::Arc{-r}), free};
  spans.assign(2, item.statement->span);
  return edges;
}

}  // namespace

std::vector<design::Edge> draw_outline(Program& program, const Recipe& recipe, std::vector<Span>& spans) {
  const RecipeItem& item = recipe.outline;
  const Statement& statement = *item.statement;
  Clauses clauses(program, statement, *item.scope);
  if (!statement.operands.empty()) {
    std::vector<design::Edge> edges = circle(program, recipe, clauses, spans);
    clauses.finish();
    return edges;
  }
  const BoundClause& start = clauses.need("from");
  const PointValue p = eval_point(program, clauses.value(start), *start.scope, 2, kLength, "`from`");
  clauses.finish();
  const Point2 first(p.at[0], p.at[1]);
  Point2 at = first;
  std::vector<design::Edge> edges;
  for (std::size_t k = 0; k < recipe.edges.size(); ++k) {
    const RecipeItem& edge = recipe.edges[k];
    if (edge.statement->keyword.text == "close" && k + 1 < recipe.edges.size())
      fail(program, Message("G0401", "edges stand after `close`", recipe.edges[k + 1].statement->span)
                        .also(edge.statement->span, "the outline is closed here"));
    edges.push_back(EdgeDrawer(program, edge, at, first).draw());
    spans.push_back(edge.statement->name ? edge.statement->name->span : edge.statement->operands.back().span);
    at = edges.back().curve.end();
  }
  const double gap = (at - first).norm();
  if (edges.size() < 2 || gap > kSnap)
    fail(program, Message("G0401",
                          edges.size() < 2 ? "the outline has no loop"
                                           : "the outline is open: it ends " + format_quantity(gap, kLength) +
                                                 " from where it began",
                          edges.size() < 2 ? statement.span : spans.back())
                      .help("end it with `close NAME`"));
  return edges;
}

}  // namespace garment::interpreter
