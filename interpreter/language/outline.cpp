#include "interpreter/language/outline.hpp"

#include <cmath>

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/curve_values.hpp"
#include "interpreter/language/edge_course.hpp"
#include "runtime/base/portable_math.hpp"
#include "runtime/geometry/curve_map.hpp"
#include "runtime/geometry/offset.hpp"

namespace garment::interpreter {
namespace {

using design::Point2;
using geometry::Curve;

constexpr double kShortestEdge = 1e-4;  // m, the shortest edge
constexpr double kSnap = 1e-5;          // m, an outline that ends this near its start is closed
constexpr double kChordFits = 1e-4;     // m, a copied course is this near as long from end to end

class EdgeDrawer {
 public:
  EdgeDrawer(Drawing& drawing, const RecipeItem& item, const Point2& from, const Point2& first)
      : drawing_(drawing),
        program_(drawing.program),
        overrides_(item.overrides),
        clauses_(program_, *item.statement, drawing_scope(program_, *item.scope, drawing.index, item), &overrides_),
        kind_(item.statement->keyword.text == "line" ? "line" : "edge"),
        name_(item.name),
        span_(item.statement->span),
        name_span_(item.statement->name ? item.statement->name->span : item.statement->span),
        closes_(item.statement->keyword.text == "close"),
        from_(from),
        first_(first) {}

  /// The next edge of a loop.
  design::Edge draw() {
    if (const BoundClause* along = clauses_.find("along")) return finish(course(*along));
    to_ = end_point();
    if ((to_ - from_).norm() == 0 && closes_)
      fail(program_,
           Message("G0403", kind_ + " `" + name_ + "` has no length: the outline is already closed", name_span_)
               .help("leave `close " + name_ + "` out"));
    if (!(to_.cwiseAbs().maxCoeff() <= kFarthest))
      fail(program_, Message("G0309", kind_ + " `" + name_ + "` ends more than 100 m away", name_span_));
    return finish(Curve(from_, to_, shape()));
  }

  /// A line inside a panel, which says itself where it starts; along another course it may lie where that does.
  design::Edge draw_line() {
    if (clauses_.has("along") && !clauses_.has("from")) {
      stays_ = true;
      return draw();
    }
    const BoundClause& from = clauses_.need("from");
    from_ = point(clauses_.value(from), *from.scope, "`from`", false);
    if (!(from_.cwiseAbs().maxCoeff() <= kFarthest))
      fail(program_, Message("G0309", kind_ + " `" + name_ + "` starts more than 100 m away", name_span_));
    return draw();
  }

 private:
  design::Edge finish(Curve curve) {
    design::Edge edge;
    edge.name = name_;
    edge.curve = std::move(curve);
    edge.free = clauses_.has("free") && clauses_.flag("free");
    const auto allowance = clauses_.has("allowance") ? clauses_.quantity("allowance") : std::nullopt;
    edge.allowance = allowance.value_or(0);
    clauses_.finish();
    if (allowance) drawing_.info.own_allowance.insert(name_);
    if (!(edge.curve.length() >= kShortestEdge))
      fail(program_, Message("G0403",
                             kind_ + " `" + name_ + "` is " + format_mm(edge.curve.length()) +
                                 " long; it needs 0.1 mm at least",
                             name_span_));
    edge.origin = program_.origin(span_);
    return edge;
  }

  Point2 point(const Expr& expr, Scope& scope, const std::string& what, bool relative) {
    const PointValue p = eval_point(program_, expr, scope, 2, kLength, what);
    return relative ? Point2(from_.x() + p.at[0], from_.y() + p.at[1]) : Point2(p.at[0], p.at[1]);
  }

  /// The course of another edge or curve, brought to where the walk is: moved so that it starts there, and where an end is
  /// stated, turned so that it ends there.
  Curve course(const BoundClause& along) {
    for (const char* word : {"control", "controls", "arc", "through", "tangents", "bulge"})
      if (clauses_.has(word))
        fail(program_, Message("G0415", kind_ + " `" + name_ + "` has two curves: `along` and `" + word + "`", name_span_)
                           .help("the course comes from the other edge; leave `" + std::string(word) + "` out"));
    const Expr& expr = clauses_.value(along);
    Curve curve = eval_course(program_, expr, *along.scope, "`along`");
    if (const auto offset = clauses_.quantity("offset"); offset && *offset != 0) curve = offset_course(curve, *offset, expr);
    if (stays_) return curve;
    Eigen::Isometry2d motion = Eigen::Isometry2d::Identity();
    if (!closes_ && !clauses_.has("to") && !clauses_.has("by") && !clauses_.has("heading")) {
      if ((curve.start() - from_).norm() <= 1e-9) return curve;
      motion.translation() = from_ - curve.start();
      return curve.transformed(motion);
    }
    to_ = end_point();
    const Point2 wanted = to_ - from_, chord = curve.end() - curve.start();
    if (std::fabs(wanted.norm() - chord.norm()) > kChordFits || chord.norm() < kShortestEdge)
      fail(program_,
           Message("G0440",
                   "`" + name_ + "` is to end " + format_quantity(wanted.norm(), kLength) +
                       " from where it starts; the course of `" + std::string(program_.sources.text(expr.span)) + "` is " +
                       format_quantity(chord.norm(), kLength) + " from end to end",
                   name_span_)
               .help("leave the end out: the copy is moved to where the walk is, and ends where it ends"));
    const Point2 u = chord.normalized(), v = wanted.normalized();
    const double c = u.dot(v), s = u.x() * v.y() - u.y() * v.x();
    motion.linear() << c, -s, s, c;
    motion.translation() = from_ - motion.linear() * curve.start();
    const Curve moved = curve.transformed(motion);
    return geometry::warped(moved, from_ - moved.start(), to_ - moved.end());
  }

  Curve offset_course(const Curve& curve, double distance, const Expr& expr) {
    const geometry::OffsetResult found = geometry::offset_curve(curve, distance);
    if (found.curve) return *found.curve;
    fail(program_, Message("G0441",
                           "there is no course " + format_quantity(distance, kLength) + " beside `" +
                               std::string(program_.sources.text(expr.span)) + "`: " + format_quantity(found.at, kLength) +
                               " along it, it " + (found.tight ? "bends more tightly than that" : "has a corner too sharp"),
                           clauses_.find("offset")->clause->span)
                       .help("take a smaller offset, or copy the parts on either side one by one"));
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
    if (ways != 1)
      fail(program_,
           Message(ways == 0 ? "G0312" : "G0415",
                   kind_ + " `" + name_ + "` " + (ways == 0 ? "has no end" : "has more than one end"), name_span_)
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
           Message("G0415", kind_ + " `" + name_ + "` has two curves: `" + given[0] + "` and `" + given[1] + "`",
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
        fail(program_, Message("G0309", "a point of " + kind_ + " `" + name_ + "` lies more than 100 m away",
                               clause.clause->span));
    if (clause.clause->word.text == "through") {
      Point2 last = from_;
      for (std::size_t k = 0; k <= points.size(); ++k) {
        const Point2 next = k < points.size() ? points[k] : to_;
        if ((next - last).norm() < kSnap)
          fail(program_,
               Message("G0403", "two points of " + kind_ + " `" + name_ + "` fall together", clause.clause->span));
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
      if (half < kShortestEdge / 2) fail(program_, Message("G0403", "the arc's ends fall together", name_span_));
      const Point2 t = chord / (2 * half), left(-t.y(), t.x());
      const double x = p.dot(t), y = p.dot(left);
      if (std::fabs(y) < 1e-7 && std::fabs(x) < half) return geometry::Line{};
      if (std::fabs(y) < 1e-7)
        fail(program_, Message("G0413", "no arc goes through three points on a line in this order",
                               through->clause->span)
                           .help("the point after `through` lies between the ends, beside the straight way"));
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

  Drawing& drawing_;
  Program& program_;
  std::vector<Override> overrides_;
  Clauses clauses_;
  std::string kind_, name_;
  Span span_, name_span_;
  bool closes_ = false, relative_ = false, stays_ = false;
  Point2 from_, first_, to_;
};

void draw_circle(Drawing& drawing, const Loop& loop, Clauses& clauses, std::vector<design::Edge>& edges,
                 std::vector<Span>& spans) {
  Program& program = drawing.program;
  const RecipeItem& item = *loop.head;
  const std::string keyword = item.statement->keyword.text;
  const Expr& call = item.statement->operands[0];
  const bool named = call.kind == ExprKind::call && call.children[0].kind == ExprKind::name &&
                     call.children[0].text == "circle" && call.children.size() == 3;
  if (!named || item.statement->operands.size() != 1)
    fail(program, Message("G0313", (keyword == "hole" ? "a hole" : "an outline") +
                                       std::string(" starts `from POINT` or is `circle(CENTER, RADIUS)`"),
                          call.span));
  Scope& scope = drawing_scope(program, *item.scope, drawing.index, item);
  const Expr *center = &call.children[1], *radius = &call.children[2];
  if (call.labels.size() > 1 && call.labels[0].text == "radius") std::swap(center, radius);
  const PointValue c = eval_point(program, *center, scope, 2, kLength, "`center`");
  const double r = eval_quantity(program, *radius, scope, kLength, "`radius`").value;
  const double least = keyword == "hole" ? 1e-3 : 5e-3;
  if (!(r >= least && r <= kFarthest))
    fail(program, Message("G0309",
                          "`radius` is " + format_quantity(r, kLength) + "; it must lie in " +
                              format_mm(least) + " .. 100 m",
                          radius->span));
  std::string name = item.name.empty() ? "rim" : item.name;
  if (const BoundClause* as = clauses.find("as")) {
    const Expr& expr = clauses.value(*as);
    if (expr.kind != ExprKind::name) fail(program, Message("G0306", "`as` takes a name", expr.span));
    name = name_of(program, expr, *as->scope);
  }
  if (keyword == "outline" && loop.folded)
    fail(program, Message("G0404", "a circle has no straight edge to fold on", loop.fold_span)
                      .help("draw half of it: `edge rim to ... arc radius R`, `close fold_line`"));
  const bool free = clauses.flag("free");
  const Point2 right(c.at[0] + r, c.at[1]), left(c.at[0] - r, c.at[1]);
  // Counter-clockwise: the arcs bulge to the right of the way walked.
  edges.push_back({name + ".1", program.origin(item.statement->span), Curve(right, left, geometry::Arc{-r}), free});
  edges.push_back({name + ".2", program.origin(item.statement->span), Curve(left, right, geometry::Arc{-r}), free});
  const Span span = item.statement->name ? item.statement->name->span : item.statement->span;
  spans.insert(spans.end(), 2, span);
}

}  // namespace

void draw_loop(Drawing& drawing, const Loop& loop, std::vector<design::Edge>& edges, std::vector<Span>& spans) {
  Program& program = drawing.program;
  const RecipeItem& item = *loop.head;
  const Statement& statement = *item.statement;
  std::vector<Override> overrides = item.overrides;
  Clauses clauses(program, statement, drawing_scope(program, *item.scope, drawing.index, item), &overrides);
  if (!statement.operands.empty()) {
    draw_circle(drawing, loop, clauses, edges, spans);
    clauses.finish();
    return;
  }
  const std::string what = statement.keyword.text == "hole" ? "the hole `" + item.name + "`" : "the outline";
  const BoundClause& start = clauses.need("from");
  const PointValue p = eval_point(program, clauses.value(start), *start.scope, 2, kLength, "`from`");
  const bool free = clauses.has("free") && clauses.flag("free");
  clauses.finish();
  const Point2 first(p.at[0], p.at[1]);
  Point2 at = first;
  const std::size_t begin = edges.size();
  for (std::size_t k = 0; k < loop.edges.size(); ++k) {
    const RecipeItem& edge = *loop.edges[k];
    if (edge.statement->keyword.text == "close" && k + 1 < loop.edges.size())
      fail(program, Message("G0401", "edges stand after `close`", loop.edges[k + 1]->statement->span)
                        .also(edge.statement->span, what + " is closed here"));
    design::Edge drawn = EdgeDrawer(drawing, edge, at, first).draw();
    drawn.free = drawn.free || free;
    edges.push_back(std::move(drawn));
    spans.push_back(edge.statement->name ? edge.statement->name->span : edge.statement->operands.back().span);
    at = edges.back().curve.end();
  }
  const double gap = (at - first).norm();
  const bool no_loop = edges.size() - begin < 2;
  if (no_loop || gap > kSnap)
    fail(program, Message("G0401",
                          no_loop ? what + " has no loop"
                                  : what + " is open: it ends " + format_quantity(gap, kLength) +
                                        " from where it began",
                          no_loop ? (statement.name ? statement.name->span : statement.span) : spans.back())
                      .help("end it with `close NAME`"));
}

design::Edge draw_line(Drawing& drawing, const RecipeItem& item) {
  return EdgeDrawer(drawing, item, Point2(0, 0), Point2(0, 0)).draw_line();
}

}  // namespace garment::interpreter
