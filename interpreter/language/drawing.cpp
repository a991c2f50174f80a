#include "interpreter/language/drawing.hpp"

#include <cmath>

namespace garment::interpreter {
namespace {

using On = design::EdgePart::On;

EdgeValue whole_edge(int panel, const std::string& name, std::size_t k, On on, const design::Edge& edge) {
  EdgeSpan span;
  span.panel = panel;
  span.name = name;
  span.parts = {{panel, static_cast<int>(k), 0, edge.curve.length(), on}};
  return EdgeValue{{span}};
}

}  // namespace

Scope& drawing_scope(Program& program, Scope& scope, int panel, const RecipeItem& item) {
  Scope& inner = program.new_scope(&scope);
  inner.drawn = panel;
  inner.renamed = &item.renamed;
  return inner;
}

std::optional<Value> drawn_member(Program& program, const Scope& scope, const std::string& written) {
  const Scope* at = &scope;
  while (at != nullptr && at->drawn < 0) at = at->parent;
  if (at == nullptr) return std::nullopt;
  const PanelInfo& info = program.panels[static_cast<std::size_t>(at->drawn)];
  if (info.ready) return std::nullopt;
  std::string name = written;
  if (at->renamed != nullptr)
    if (const auto now = at->renamed->find(name); now != at->renamed->end()) name = now->second;
  const design::Panel& panel = info.panel;
  const std::pair<const std::vector<design::Edge>*, On> lists[] = {
      {&panel.edges, On::outline}, {&panel.lines, On::line}, {&panel.hole_edges, On::hole}};
  for (const auto& [edges, on] : lists)
    for (std::size_t k = 0; k < edges->size(); ++k)
      if ((*edges)[k].name == name) return Value{whole_edge(at->drawn, name, k, on, (*edges)[k])};
  for (const design::InteriorPoint& point : panel.points)
    if (point.name == name)
      return Value{PointValue{{point.point.x(), point.point.y(), 0}, 2, kLength, at->drawn}};
  return std::nullopt;
}

Span name_span(const RecipeItem& item) {
  return item.statement->name ? item.statement->name->span : item.statement->span;
}

std::string renamed(const RecipeItem& item, const std::string& name) {
  const auto now = item.renamed.find(name);
  return now == item.renamed.end() ? name : now->second;
}

const design::Edge* find_drawn_edge(const design::Panel& panel, std::string_view name) {
  for (const auto* edges : {&panel.edges, &panel.lines, &panel.hole_edges})
    for (const design::Edge& edge : *edges)
      if (edge.name == name) return &edge;
  return nullptr;
}

std::vector<std::string> drawn_edge_names(const design::Panel& panel) {
  std::vector<std::string> names;
  for (const auto* edges : {&panel.edges, &panel.lines, &panel.hole_edges})
    for (const design::Edge& edge : *edges) names.push_back(edge.name);
  return names;
}

std::string format_point(const design::Point2& p) {
  auto shown = [](double x) { return format_quantity(std::fabs(x) < 1e-9 ? 0 : x, kLength); };
  return "(" + shown(p.x()) + ", " + shown(p.y()) + ")";
}

}  // namespace garment::interpreter
