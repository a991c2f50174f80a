#include "interpreter/language/panel_interior.hpp"

#include "interpreter/language/clauses.hpp"
#include "interpreter/language/edges.hpp"
#include "interpreter/language/outline.hpp"
#include "interpreter/language/word_lists.hpp"
#include "runtime/design/unfold_interior.hpp"

namespace garment::interpreter {
namespace {

using design::Point2;
using On = design::EdgePart::On;

class InteriorDrawer {
 public:
  explicit InteriorDrawer(Drawing& drawing)
      : drawing_(drawing), program_(drawing.program), panel_(drawing.panel) {}

  void draw(const RecipeItem& item) {
    const std::string& keyword = item.statement->keyword.text;
    drawing_.info.spans[item.name] = name_span(item);
    if (keyword == "line") panel_.lines.push_back(draw_line(drawing_, item));
    if (keyword == "point") add_point(item);
    if (keyword == "hole") add_hole(item);
    if (keyword == "slit") add_slit(item);
  }

 private:
  void add_point(const RecipeItem& item) {
    std::vector<Override> overrides = item.overrides;
    Clauses clauses(program_, *item.statement,
                    drawing_scope(program_, *item.scope, drawing_.index, item), &overrides);
    design::InteriorPoint point{item.name, program_.origin(item.statement->span), {}};
    const BoundClause& at = clauses.need("at");
    if (const BoundClause* on = clauses.find("on")) {
      point.point = on_edge(item, clauses.value(*on), *on->scope, at);
    } else {
      const PointValue p = eval_point(program_, clauses.value(at), *at.scope, 2, kLength, "`at`");
      point.point = {p.at[0], p.at[1]};
    }
    clauses.finish();
    panel_.points.push_back(point);
  }

  Point2 on_edge(const RecipeItem& item, const Expr& expr, Scope& scope, const BoundClause& at) {
    const design::Edge& edge = named_edge(item, expr, scope);
    const double length = edge.curve.length();
    auto mark = [&](std::string_view name) -> std::optional<double> {
      if (name == "start") return 0.0;
      if (name == "end") return length;
      return std::nullopt;
    };
    const double s =
        eval_position(program_, at.clause->values, *at.scope, length, mark, at.clause->span, "a point");
    if (!(s >= -1e-6 && s <= length + 1e-6))
      fail(program_, Message("G0414",
                             "point `" + item.name + "` is at " + format_quantity(s, kLength) + " of `" + edge.name +
                                 "`, which is " + format_quantity(length, kLength) + " long",
                             at.clause->span)
                         .help("positions on it are 0 .. " + format_quantity(length, kLength) +
                               ", from its drawn start; `2 cm before end` counts back"));
    return edge.curve.point_at(s);
  }

  const design::Edge& named_edge(const RecipeItem& item, const Expr& expr, Scope& scope) {
    if (expr.kind != ExprKind::name)
      fail(program_, Message("G0306", "`on` takes the name of an edge or line of this panel", expr.span));
    const std::string name = renamed(item, name_of(program_, expr, scope));
    if (const design::Edge* edge = find_drawn_edge(panel_, name)) return *edge;
    fail(program_, Message("G0301", "panel `" + panel_.name + "` has no edge or line `" + name + "`", expr.span)
                       .help(meant_or_listed(name, drawn_edge_names(panel_), "drawn so far are")));
  }

  void add_hole(const RecipeItem& item) {
    Loop loop;
    loop.head = &item;
    for (const RecipeItem& edge : drawing_.recipe.hole_edges)
      if (edge.owner == item.name) loop.edges.push_back(&edge);
    design::Hole hole{item.name, program_.origin(item.statement->span),
                      static_cast<int>(panel_.hole_edges.size()), 0};
    std::vector<Span> spans;
    draw_loop(drawing_, loop, panel_.hole_edges, spans);
    hole.count = static_cast<int>(panel_.hole_edges.size()) - hole.first;
    for (int k = 0; k < hole.count; ++k)
      drawing_.info.spans.emplace(panel_.hole_edges[static_cast<std::size_t>(hole.first + k)].name,
                                  spans[static_cast<std::size_t>(k)]);
    panel_.holes.push_back(hole);
  }

  void add_slit(const RecipeItem& item) {
    std::vector<Override> overrides = item.overrides;
    Clauses clauses(program_, *item.statement, *item.scope, &overrides);
    const BoundClause& along = clauses.need("along");
    const Expr& expr = clauses.value(along);
    const std::string name = expr.kind == ExprKind::name ? renamed(item, name_of(program_, expr, *along.scope)) : "";
    std::vector<std::string> names;
    int line = -1;
    for (std::size_t k = 0; k < panel_.lines.size(); ++k) {
      names.push_back(panel_.lines[k].name);
      if (panel_.lines[k].name == name) line = static_cast<int>(k);
    }
    clauses.finish();
    if (line < 0)
      fail(program_, Message("G0301", "slit `" + item.name + "` runs along a line of this panel; there is no line `" +
                                          std::string(program_.sources.text(expr.span)) + "` above it",
                             expr.span)
                         .help(names.empty() ? "draw it first: `line NAME from POINT to POINT`"
                                             : did_you_mean(name, names)));
    panel_.slits.push_back({item.name, program_.origin(item.statement->span), line});
  }

  Drawing& drawing_;
  Program& program_;
  design::Panel& panel_;
};

/// A name with its half taken off: {"left", "roll"}, or {"", "roll"}.
std::pair<std::string, std::string> split_half(const PanelInfo& info, const std::string& name) {
  const std::size_t dot = name.find('.');
  const std::string first = dot == std::string::npos ? "" : name.substr(0, dot);
  if (!info.folded || (first != "left" && first != "right")) return {"", name};
  return {first, name.substr(dot + 1)};
}

class InteriorNamer {
 public:
  InteriorNamer(PanelInfo& info, int panel) : info_(info), panel_(info.panel), index_(panel) {}

  void name_lines() {
    for (std::size_t k = 0; k < panel_.lines.size(); ++k)
      add(panel_.lines[k].name, {part(k, On::line, true)});
    // Halves that meet on the fold are also known joined: from the end of one through the fold.
    for (std::size_t k = 0; k + 1 < panel_.lines.size(); ++k) {
      const auto [half, plain] = split_half(info_, panel_.lines[k].name);
      const auto [other, same] = split_half(info_, panel_.lines[k + 1].name);
      if (half.empty() || other.empty() || plain != same) continue;
      const geometry::Curve& curve = panel_.lines[k].curve;
      if (design::on_fold(curve.start(), *panel_.fold_x))
        join(plain, part(k + 1, On::line, false), part(k, On::line, true));
      else if (design::on_fold(curve.end(), *panel_.fold_x))
        join(plain, part(k, On::line, true), part(k + 1, On::line, false));
    }
  }

  void name_holes() {
    for (const design::Hole& hole : panel_.holes) {
      std::vector<design::EdgePart> ring;
      for (int k = 0; k < hole.count; ++k)
        ring.push_back(part(static_cast<std::size_t>(hole.first + k), On::hole, true));
      add(hole.name, ring);
      const bool circle = panel_.hole_edges[static_cast<std::size_t>(hole.first)].name == hole.name + ".1";
      const bool joined = info_.folded && split_half(info_, hole.name).first.empty();
      for (int k = 0; k < hole.count && !circle; ++k) {
        const std::size_t e = static_cast<std::size_t>(hole.first + k);
        // The images of a joined hole are stored walked back.
        add(panel_.hole_edges[e].name, {part(e, On::hole, !(joined && k >= hole.count / 2))});
      }
      if (joined) join_hole(hole);
    }
  }

 private:
  /// The first and the last drawn edge of a joined hole meet their images on the fold.
  void join_hole(const design::Hole& hole) {
    const std::size_t first = static_cast<std::size_t>(hole.first), n = static_cast<std::size_t>(hole.count);
    const std::string start = split_half(info_, panel_.hole_edges[first].name).second;
    join(start, part(first + n - 1, On::hole, true), part(first, On::hole, true));
    if (n == 2) return;
    const std::size_t middle = first + n / 2;
    join(split_half(info_, panel_.hole_edges[middle - 1].name).second, part(middle - 1, On::hole, true),
         part(middle, On::hole, true));
  }

  design::EdgePart part(std::size_t k, On on, bool with_curve) const {
    const auto& edges = on == On::line ? panel_.lines : panel_.hole_edges;
    const double length = edges[k].curve.length();
    return {index_, static_cast<int>(k), with_curve ? 0 : length, with_curve ? length : 0, on};
  }

  void add(const std::string& name, std::vector<design::EdgePart> parts) {
    const auto [half, plain] = split_half(info_, name);
    info_.edges.push_back({plain, half, std::move(parts), info_.spans[plain]});
  }

  void join(const std::string& plain, const design::EdgePart& a, const design::EdgePart& b) {
    info_.edges.push_back({plain, "", {a, b}, info_.spans[plain]});
  }

  PanelInfo& info_;
  const design::Panel& panel_;
  int index_;
};

}  // namespace

bool draw_interior(Drawing& drawing) {
  bool good = true;
  InteriorDrawer drawer(drawing);
  for (const RecipeItem& item : drawing.recipe.interior) {
    try {
      drawer.draw(item);
    } catch (const Stop&) {
      good = false;
    }
  }
  return good;
}

void name_interior(PanelInfo& info, int panel) {
  InteriorNamer namer(info, panel);
  namer.name_lines();
  namer.name_holes();
}

}  // namespace garment::interpreter
