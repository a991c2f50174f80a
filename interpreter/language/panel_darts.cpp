// Darts: open on an edge, inside the panel, or with drawn legs.
#include <algorithm>
#include <cmath>

#include "interpreter/language/edges.hpp"
#include "interpreter/language/outline.hpp"
#include "interpreter/language/panel_marks.hpp"
#include "interpreter/language/segments.hpp"
#include "interpreter/language/word_lists.hpp"

namespace garment::interpreter {
namespace {

using design::Point2;

constexpr double kLegs = 1e-3;  // m by which the legs of a drawn dart may differ

class DartMaker {
 public:
  DartMaker(Drawing& drawing, const RecipeItem& item)
      : drawing_(drawing),
        program_(drawing.program),
        panel_(drawing.panel),
        item_(item),
        overrides_(item.overrides),
        clauses_(program_, *item.statement, drawing_scope(program_, *item.scope, drawing.index, item), &overrides_) {}

  void make() {
    const int forms = clauses_.has("on") + clauses_.has("inside") + clauses_.has(":");
    if (forms != 1)
      fail(program_, Message(forms == 0 ? "G0312" : "G0415",
                             "dart `" + item_.name + "` " +
                                 (forms == 0 ? "has no place" : "is stated in more than one way"),
                             name_span(item_))
                         .help("write `on EDGE`, `inside from POINT to POINT`, or `: LEG to LEG`"));
    if (clauses_.has("inside")) return make_inside_dart();
    if (clauses_.has(":")) return make_leg_dart();
    make_edge_dart();
  }

 private:
  void make_inside_dart() {
    clauses_.flag("inside");
    design::InsideDart dart;
    dart.name = item_.name;
    dart.origin = program_.origin(item_.statement->span);
    dart.from = point("from");
    dart.to = point("to");
    const auto width = clauses_.quantity("width");
    if (!width) clauses_.need("width");
    dart.width = *width;
    const double length = (dart.to - dart.from).norm();
    if (const BoundClause* at = clauses_.find("at")) dart.at = widest(*at, length);
    clauses_.finish();
    if (dart.width >= length)
      fail(program_, Message("G0427",
                             "dart `" + item_.name + "` is " + format_quantity(dart.width, kLength) + " wide and " +
                                 format_quantity(length, kLength) + " long; a dart is longer than wide",
                             name_span(item_))
                         .help("`from` and `to` are its two tips, `width` is how wide it is between them"));
    check_lens(dart);
    panel_.inside_darts.push_back(dart);
  }

  Point2 point(const char* word) {
    const BoundClause& clause = clauses_.need(word);
    const PointValue p = eval_point(program_, clauses_.value(clause), *clause.scope, 2, kLength,
                                    "`" + std::string(word) + "`");
    return {p.at[0], p.at[1]};
  }

  /// Where an inside dart is widest, as a fraction of its length.
  double widest(const BoundClause& at, double length) {
    auto mark = [](std::string_view) { return std::optional<double>(); };
    const double s = eval_position(program_, at.clause->values, *at.scope, length, mark, at.clause->span,
                                   "the widest place of a dart");
    if (!(s >= 0.05 * length && s <= 0.95 * length))
      fail(program_, Message("G0309",
                             "the widest place of dart `" + item_.name + "` is " + format_quantity(s, kLength) +
                                 " from its first tip; it must lie in " + format_quantity(0.05 * length, kLength) +
                                 " .. " + format_quantity(0.95 * length, kLength),
                             at.clause->span));
    return s / length;
  }

  void check_lens(const design::InsideDart& dart) {
    const Point2 along = dart.to - dart.from, middle = dart.from + dart.at * along;
    const Point2 side = dart.width / 2 * Point2(-along.y(), along.x()).normalized();
    const Point2 corners[] = {dart.from, middle + side, dart.to, middle - side};
    const std::vector<Segment> outline = segments_of(panel_.edges), holes = segments_of(panel_.hole_edges);
    std::vector<Segment> lens;
    for (int k = 0; k < 4; ++k) lens.push_back({corners[k], corners[(k + 1) % 4], 0});
    auto met = first_crossing(program_, name_span(item_), lens, outline);
    if (!met) met = first_crossing(program_, name_span(item_), lens, holes);
    std::optional<Point2> outside;
    if (met) outside = met->at;
    for (const Point2& corner : corners)
      if (!outside && (!contains(outline, corner, 0) || contains(holes, corner, 0))) outside = corner;
    if (!outside) return;
    fail(program_, Message("G0426",
                           "dart `" + item_.name + "` leaves the cloth of `" + panel_.name + "` at " +
                               format_point(*outside),
                           name_span(item_))
                       .help("both its tips and its whole width lie inside the panel; a dart that opens on an edge is "
                             "stated `on EDGE`"));
  }

  void make_leg_dart() {
    design::LegDart dart;
    dart.name = item_.name;
    dart.origin = program_.origin(item_.statement->span);
    const std::size_t a = leg(":"), b = leg("to");
    clauses_.finish();
    const design::Edge &leg_a = panel_.edges[a], &leg_b = panel_.edges[b];
    dart.leg_a = leg_a.name;
    dart.leg_b = leg_b.name;
    const std::size_t n = panel_.edges.size();
    const bool forwards = (a + 1) % n == b, backwards = (b + 1) % n == a;
    if (a == b || (!forwards && !backwards))
      fail(program_, Message("G0428",
                             "`" + leg_a.name + "` and `" + leg_b.name + "` do not follow each other on the outline of `" +
                                 panel_.name + "`, so they meet in no tip",
                             name_span(item_))
                         .help("the legs of a dart are two edges, one after the other: down to the tip and up again"));
    check_tip(forwards ? a : b, forwards ? b : a);
    check_legs(leg_a, leg_b, forwards);
    for (const design::LegDart& other : panel_.leg_darts)
      for (const std::string& name : {other.leg_a, other.leg_b})
        if (name == dart.leg_a || name == dart.leg_b)
          fail(program_, Message("G0417", "`" + name + "` is already a leg of dart `" + other.name + "`", name_span(item_))
                             .also(drawing_.info.spans[other.name], ""));
    panel_.leg_darts.push_back(dart);
  }

  /// Index of the edge that `word` names.
  std::size_t leg(const char* word) {
    const BoundClause& clause = clauses_.need(word);
    const Expr& expr = clauses_.value(clause);
    if (expr.kind != ExprKind::name)
      fail(program_, Message("G0306", "a leg of a dart is the name of an edge of this panel", expr.span)
                         .help("as in `dart d: leg_a to leg_b`"));
    const std::string name = renamed(item_, name_of(program_, expr, *clause.scope));
    std::vector<std::string> names;
    for (std::size_t k = 0; k < panel_.edges.size(); ++k) {
      if (panel_.edges[k].name == name) return k;
      names.push_back(panel_.edges[k].name);
    }
    fail(program_, Message("G0301", "panel `" + panel_.name + "` has no edge `" + name + "`", expr.span)
                       .help(meant_or_listed(name, names, "its edges are")));
  }

  /// The corner between the legs points into the cloth.
  void check_tip(std::size_t first, std::size_t second) {
    const geometry::Curve &in = panel_.edges[first].curve, &out = panel_.edges[second].curve;
    const Point2 u = in.tangent_at(in.length()), v = out.tangent_at(0);
    double area = 0;
    for (const design::Edge& e : panel_.edges) area += e.curve.area_term();
    const double turn = (u.x() * v.y() - u.y() * v.x()) * (area > 0 ? 1 : -1);
    const bool into = turn < 0 || (u.dot(v) < 0 && std::fabs(turn) < 1e-12);
    if (into && u.dot(v) < 0) return;
    fail(program_, Message("G0428",
                           "`" + panel_.edges[first].name + "` and `" + panel_.edges[second].name + "` meet at " +
                               format_point(in.end()) + (turn < 0 ? " at a blunt corner" : " at a corner that points out of the panel") +
                               "; the tip of a dart is a sharp corner that points into it",
                           name_span(item_))
                       .help("draw the legs from the edge to the tip inside and back to the edge"));
  }

  void check_legs(const design::Edge& a, const design::Edge& b, bool forwards) {
    const double one = a.curve.length(), two = b.curve.length();
    if (std::fabs(one - two) <= kLegs) return;
    const bool first = one > two;  // the longer one is cut back
    const geometry::Curve& longer = first ? a.curve : b.curve;
    const bool tip_at_end = first == forwards;
    const double shorter = std::min(one, two);
    const Point2 end = longer.point_at(tip_at_end ? longer.length() - shorter : shorter);
    fail(program_, Message("G0429",
                           "the legs of dart `" + item_.name + "` are " + format_mm(one) + " and " + format_mm(two) +
                               " long; they are sewn together and must agree within 1 mm",
                           name_span(item_))
                       .also(drawing_.info.spans[a.name], format_mm(one))
                       .also(drawing_.info.spans[b.name], format_mm(two))
                       .help("let `" + (first ? a.name : b.name) + "` " + (tip_at_end ? "start" : "end") + " at " +
                             format_point(end) + ": then both are " + format_mm(shorter)));
  }

  void make_edge_dart() {
    const design::Edge& edge = outline_edge_under(drawing_, item_, clauses_);
    design::EdgeDart dart;
    dart.name = item_.name;
    dart.origin = program_.origin(item_.statement->span);
    dart.edge = edge.name;
    const BoundClause* at = clauses_.find("at");
    dart.at = at != nullptr ? position_on(drawing_, *at, edge, "a dart") : edge.curve.length() / 2;
    const auto width = clauses_.quantity("width");
    if (!width) clauses_.need("width");
    dart.width = *width;
    const auto depth = clauses_.quantity("depth");
    const BoundClause* to = clauses_.find("to");
    if ((to != nullptr) == depth.has_value())
      fail(program_,
           Message(depth ? "G0415" : "G0312",
                   "dart `" + item_.name + "` needs " + (depth ? "one tip: `depth` or `to`" : "a tip"),
                   name_span(item_))
               .help("write `depth 9 cm` or `to POINT`"));
    if (depth) dart.depth = *depth;
    if (to != nullptr) {
      const PointValue p = eval_point(program_, clauses_.value(*to), *to->scope, 2, kLength, "`to`");
      dart.apex = Point2(p.at[0], p.at[1]);
    }
    clauses_.finish();
    check_stretch(drawing_, item_, edge, dart.at - dart.width / 2, dart.at + dart.width / 2);
    check_depth(dart, edge);
    panel_.darts.push_back(dart);
  }

  void check_depth(const design::EdgeDart& dart, const design::Edge& edge) {
    const Point2 middle = edge.curve.point_at(dart.at), t = edge.curve.tangent_at(dart.at);
    Point2 way(-t.y(), t.x());
    double area = 0;
    for (const design::Edge& e : panel_.edges) area += e.curve.area_term();
    if (area < 0) way = -way;
    double depth = dart.depth;
    if (dart.apex) {
      depth = (*dart.apex - middle).norm();
      if (depth < 5e-3)
        fail(program_, Message("G0407", "dart `" + item_.name + "` has no depth", name_span(item_)));
      way = (*dart.apex - middle) / depth;
    }
    const double room = depth_inside(panel_, middle, way, 1e-4);
    if (depth < room && (!dart.apex || contains(panel_, *dart.apex, 0))) return;
    fail(program_,
         Message("G0407",
                 "dart `" + item_.name + "` is " + format_quantity(depth, kLength) + " deep; the panel is " +
                     format_quantity(std::min(room, 100.0), kLength) + " deep there",
                 name_span(item_))
             .help("make it shallower, or place it elsewhere"));
  }

  Drawing& drawing_;
  Program& program_;
  design::Panel& panel_;
  const RecipeItem& item_;
  std::vector<Override> overrides_;
  Clauses clauses_;
};

}  // namespace

void add_dart(Drawing& drawing, const RecipeItem& item) { DartMaker(drawing, item).make(); }

}  // namespace garment::interpreter
