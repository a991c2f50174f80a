#include "interpreter/language/panel_marks.hpp"

#include <algorithm>
#include <cmath>

#include "interpreter/language/edges.hpp"
#include "interpreter/language/word_lists.hpp"

namespace garment::interpreter {
namespace {

void add_notch(Drawing& drawing, const RecipeItem& item) {
  Program& program = drawing.program;
  std::vector<Override> overrides = item.overrides;
  Clauses clauses(program, *item.statement, drawing_scope(program, *item.scope, drawing.index, item), &overrides);
  const design::Edge& edge = edge_under(drawing, item, clauses);
  const BoundClause& at = clauses.need("at");
  const double s = position_on(drawing, at, edge, "a notch");
  clauses.finish();
  const double length = edge.curve.length();
  if (!(s >= -1e-6 && s <= length + 1e-6))
    fail(program, Message("G0414",
                          "notch `" + item.name + "` is at " + format_quantity(s, kLength) + " of edge `" + edge.name +
                              "`; the edge is " + format_quantity(length, kLength) + " long",
                          at.clause->span)
                      .help("positions on it are 0 .. " + format_quantity(length, kLength) +
                            ", from its drawn start; `2 cm before end` counts back"));
  drawing.panel.notches.push_back(
      {item.name, program.origin(item.statement->span), edge.name, std::clamp(s, 0.0, length)});
}

/// The stretches of an edge that darts and pleats take, with the names of their owners.
struct Taken {
  std::string name, kind;
  double from, to;
};

std::vector<Taken> taken_of(const design::Panel& panel, const std::string& edge) {
  std::vector<Taken> all;
  for (const design::EdgeDart& dart : panel.darts)
    if (dart.edge == edge) all.push_back({dart.name, "dart", dart.at - dart.width / 2, dart.at + dart.width / 2});
  for (const design::Pleat& pleat : panel.pleats) {
    if (pleat.edge != edge) continue;
    const double reach = (pleat.count - 1) * pleat.spacing, half = pleat.take() / 2;
    all.push_back({pleat.name, pleat.kind == design::Pleat::Kind::tuck ? "tuck" : "pleat",
                   std::min(pleat.at, pleat.at + reach) - half, std::max(pleat.at, pleat.at + reach) + half});
  }
  return all;
}

/// A notch that is folded or cut away cannot be matched.
void check_notch(Drawing& drawing, const design::Notch& notch) {
  for (const Taken& taken : taken_of(drawing.panel, notch.edge)) {
    if (notch.at <= taken.from + 1e-3 || notch.at >= taken.to - 1e-3) continue;
    report(drawing.program, Message("G0425",
                                    "notch `" + notch.name + "` lies in the " + taken.kind + " `" + taken.name +
                                        "`, which takes " + format_quantity(taken.from, kLength) + " .. " +
                                        format_quantity(taken.to, kLength) + " of `" + notch.edge + "`",
                                    drawing.info.spans[notch.name])
                                .also(drawing.info.spans[taken.name], "")
                                .warning()
                                .help("once it is closed the notch is gone; move the notch beside it"));
  }
}

}  // namespace

const design::Edge& edge_under(Drawing& drawing, const RecipeItem& item, Clauses& clauses) {
  Program& program = drawing.program;
  const BoundClause& on = clauses.need("on");
  const Expr& expr = clauses.value(on);
  if (expr.kind != ExprKind::name)
    fail(program, Message("G0306", "`on` takes the name of an edge of this panel", expr.span));
  const std::string name = renamed(item, name_of(program, expr, *on.scope));
  if (const design::Edge* edge = find_drawn_edge(drawing.panel, name)) return *edge;
  fail(program, Message("G0301", "panel `" + drawing.panel.name + "` has no edge `" + name + "`", expr.span)
                    .help(meant_or_listed(name, drawn_edge_names(drawing.panel), "its edges and lines are")));
}

const design::Edge& outline_edge_under(Drawing& drawing, const RecipeItem& item, Clauses& clauses) {
  const design::Edge& edge = edge_under(drawing, item, clauses);
  for (const design::Edge& known : drawing.panel.edges)
    if (known.name == edge.name) return edge;
  const std::string& keyword = item.statement->keyword.text;
  std::string place = "an interior line";
  for (const design::Edge& known : drawing.panel.hole_edges)
    if (known.name == edge.name) place = "the edge of a hole";
  fail(drawing.program,
       Message("G0418", "`" + edge.name + "` is " + place + "; a " + keyword + " opens on an edge of the outline",
               clauses.find("on")->clause->span)
           .help(keyword == "dart" ? "inside a panel: `dart " + item.name + " inside from POINT to POINT width LENGTH`"
                                   : "state it on the edge that the line ends on"));
}

double position_on(Drawing& drawing, const BoundClause& at, const design::Edge& edge, const std::string& what) {
  const double length = edge.curve.length();
  auto mark = [&](std::string_view name) -> std::optional<double> {
    if (name == "start") return 0.0;
    if (name == "end") return length;
    for (const design::Notch& notch : drawing.panel.notches)
      if (notch.name == name && notch.edge == edge.name) return notch.at;
    return std::nullopt;
  };
  return eval_position(drawing.program, at.clause->values, *at.scope, length, mark, at.clause->span, what);
}

void check_stretch(Drawing& drawing, const RecipeItem& item, const design::Edge& edge, double from, double to) {
  Program& program = drawing.program;
  const double length = edge.curve.length();
  const std::string& kind = item.statement->keyword.text;
  if (from < -1e-9 || to > length + 1e-9)
    fail(program, Message("G0408",
                          (kind == "dart" ? "the mouth of dart `" : kind + " `") + item.name + "` is at " +
                              format_quantity(from, kLength) + " .. " + format_quantity(to, kLength) + "; edge `" +
                              edge.name + "` is " + format_quantity(length, kLength) + " long",
                          name_span(item))
                      .help("move it along the edge or make it narrower"));
  for (const Taken& other : taken_of(drawing.panel, edge.name)) {
    if (other.from >= to - 1e-9 || from >= other.to - 1e-9) continue;
    const bool alike = other.kind == kind;
    fail(program, Message("G0417",
                          (alike ? kind + "s `" : other.kind + " `") + other.name + "` and " + (alike ? "" : kind + ' ') +
                              "`" + item.name + "` overlap on edge `" + edge.name + "`",
                          name_span(item))
                      .also(drawing.info.spans[other.name], "at " + format_quantity((other.from + other.to) / 2, kLength)));
  }
}

bool add_marks(Drawing& drawing) {
  bool good = true;
  auto take = [&](const std::vector<RecipeItem>& items, void (*add)(Drawing&, const RecipeItem&)) {
    for (const RecipeItem& item : items) {
      try {
        if (!item.name.empty()) drawing.info.spans[item.name] = name_span(item);
        add(drawing, item);
      } catch (const Stop&) {
        good = false;
      }
    }
  };
  take(drawing.recipe.notches, add_notch);
  take(drawing.recipe.darts, add_dart);
  take(drawing.recipe.pleats, add_pleat);
  take(drawing.recipe.allowances, add_allowance);
  for (design::Edge& edge : drawing.panel.edges)
    if (edge.name == drawing.recipe.fold) edge.allowance = 0;
  if (good) check_allowances(drawing.program, drawing.info);
  for (const design::Notch& notch : drawing.panel.notches) check_notch(drawing, notch);
  return good;
}

}  // namespace garment::interpreter
