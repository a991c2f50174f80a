// Pleats and tucks: cloth folded away along an edge.
#include <algorithm>
#include <cmath>

#include "interpreter/language/outline.hpp"
#include "interpreter/language/panel_marks.hpp"

namespace garment::interpreter {
namespace {

using design::Pleat;
using design::Point2;

constexpr double kAlong = 0.2;  // least part of a direction that lies along the edge

class PleatMaker {
 public:
  PleatMaker(Drawing& drawing, const RecipeItem& item)
      : drawing_(drawing),
        program_(drawing.program),
        item_(item),
        kind_word_(item.statement->keyword.text),
        overrides_(item.overrides),
        clauses_(program_, *item.statement, drawing_scope(program_, *item.scope, drawing.index, item), &overrides_) {}

  void make() {
    const design::Edge& edge = outline_edge_under(drawing_, item_, clauses_);
    pleat_.name = item_.name;
    pleat_.origin = program_.origin(item_.statement->span);
    pleat_.edge = edge.name;
    pleat_.at = edge.curve.length() / 2;
    const BoundClause* at = clauses_.find("at");
    if (at != nullptr) pleat_.at = position_on(drawing_, *at, edge, "a " + kind_word_);
    kind_word_ == "tuck" ? take_tuck() : take_pleat();
    take_row();
    if (at == nullptr) pleat_.at -= (pleat_.count - 1) * pleat_.spacing / 2;
    if (const BoundClause* toward = clauses_.find("toward")) take_toward(*toward, edge);
    clauses_.finish();
    const double half = pleat_.take() / 2, reach = (pleat_.count - 1) * pleat_.spacing;
    check_stretch(drawing_, item_, edge, pleat_.at - half, pleat_.at + reach + half);
    check_depth(edge);
    drawing_.panel.pleats.push_back(pleat_);
  }

 private:
  void take_pleat() {
    int kinds = 0;
    const std::pair<const char*, Pleat::Kind> words[] = {
        {"knife", Pleat::Kind::knife}, {"box", Pleat::Kind::box}, {"inverted", Pleat::Kind::inverted}};
    for (const auto& [word, kind] : words)
      if (clauses_.has(word) && clauses_.flag(word)) pleat_.kind = kind, ++kinds;
    if (kinds > 1)
      fail(program_, Message("G0415", "pleat `" + item_.name + "` is of two kinds", name_span(item_))
                         .help("take one of knife, box, inverted"));
    pleat_.underlay = needed("underlay");
    pleat_.length = clauses_.quantity("stitched").value_or(0);
    pleat_.ironed = clauses_.has("ironed") && clauses_.flag("ironed");
  }

  void take_tuck() {
    pleat_.kind = Pleat::Kind::tuck;
    pleat_.underlay = needed("width");
    pleat_.length = clauses_.quantity("length").value_or(0);
  }

  double needed(const char* word) {
    const auto value = clauses_.quantity(word);
    if (!value) clauses_.need(word);
    return *value;
  }

  /// `count N every LENGTH`.
  void take_row() {
    pleat_.spacing = pleat_.take();
    if (const auto count = clauses_.quantity("count")) {
      if (*count != std::floor(*count))
        fail(program_, Message("G0309", "`count` is " + format_quantity(*count, {}) + "; it is a whole number",
                               clauses_.find("count")->clause->span));
      pleat_.count = static_cast<int>(*count);
    }
    const auto every = clauses_.quantity("every");
    if (!every) return;
    pleat_.spacing = *every;
    if (pleat_.count < 2)
      fail(program_, Message("G0312", "`every` goes with `count`", clauses_.find("every")->clause->span)
                         .help("as in `count 5 every 6 cm`"));
    if (*every >= pleat_.take() - 1e-9) return;
    fail(program_,
         Message("G0424",
                 kind_word_ + "s `" + item_.name + "` stand " + format_quantity(*every, kLength) + " apart, but each takes " +
                     format_quantity(pleat_.take(), kLength) + " of the edge",
                 clauses_.find("every")->clause->span)
             .help("`every " + format_quantity(pleat_.take(), kLength) + "` would fit, or a smaller " +
                   (kind_word_ == "tuck" ? "width" : "underlay")));
  }

  void take_toward(const BoundClause& toward, const design::Edge& edge) {
    const Expr& expr = clauses_.value(toward);
    if (pleat_.kind == Pleat::Kind::box || pleat_.kind == Pleat::Kind::inverted)
      fail(program_, Message("G0313", "a box or inverted pleat lies to both sides; `toward` goes with knife pleats",
                             toward.clause->span));
    if (expr.kind == ExprKind::name && (expr.text == "start" || expr.text == "end")) {
      pleat_.toward = expr.text == "end" ? 1 : -1;
      return;
    }
    if (expr.kind == ExprKind::name && (expr.text == "left" || expr.text == "right"))
      fail(program_, Message("G0313", "`" + expr.text + "` is a side of the wearer; a pleat is drawn flat", expr.span)
                         .help("say `toward start`, `toward end`, `toward +x` or `toward -x`"));
    const Point2 way = eval_direction(program_, expr, *toward.scope, "`toward`");
    const double along = way.dot(edge.curve.tangent_at(pleat_.at));
    if (std::fabs(along) < kAlong)
      fail(program_, Message("G0313", "edge `" + edge.name + "` runs across this direction at the " + kind_word_, expr.span)
                         .help("say `toward start` or `toward end`"));
    pleat_.toward = along > 0 ? 1 : -1;
  }

  /// What is stitched down must lie in the cloth.
  void check_depth(const design::Edge& edge) {
    if (pleat_.length <= 0) return;
    double area = 0;
    for (const design::Edge& e : drawing_.panel.edges) area += e.curve.area_term();
    for (int k = 0; k < pleat_.count; ++k) {
      const double s = pleat_.at + k * pleat_.spacing;
      const Point2 t = edge.curve.tangent_at(s);
      Point2 way(-t.y(), t.x());
      if (area < 0) way = -way;
      const double room = depth_inside(drawing_.panel, edge.curve.point_at(s), way, 1e-4);
      if (pleat_.length <= room + 1e-6) continue;
      fail(program_, Message("G0407",
                             kind_word_ + " `" + item_.name + "` is stitched down " +
                                 format_quantity(pleat_.length, kLength) + "; the panel is " +
                                 format_quantity(std::min(room, 100.0), kLength) + " deep there",
                             name_span(item_))
                         .help("make it shorter"));
    }
  }

  Drawing& drawing_;
  Program& program_;
  const RecipeItem& item_;
  std::string kind_word_;
  std::vector<Override> overrides_;
  Clauses clauses_;
  Pleat pleat_;
};

}  // namespace

void add_pleat(Drawing& drawing, const RecipeItem& item) { PleatMaker(drawing, item).make(); }

}  // namespace garment::interpreter
