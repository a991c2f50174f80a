#include "interpreter/language/edges.hpp"

#include <algorithm>
#include <cmath>

#include "interpreter/language/evaluate.hpp"

namespace garment::interpreter {
namespace {

const design::Panel& panel_of(const Program& program, int index) {
  return program.panels[static_cast<std::size_t>(index)].panel;
}

double part_length(const design::EdgePart& part) { return std::fabs(part.to - part.from); }

/// Area cut away by a dart: between the edge under its mouth and its legs.
double dart_area(const design::Panel& panel, const design::EdgeDart& dart) {
  for (const design::Edge& edge : panel.edges) {
    if (edge.name != dart.edge) continue;
    const double from = dart.at - dart.width / 2;
    const design::Point2 middle = edge.curve.point_at(dart.at), t = edge.curve.tangent_at(dart.at);
    const design::Point2 left(-t.y(), t.x());
    const design::Point2 side =
        dart.apex ? design::Point2(*dart.apex - middle) : design::Point2(left * dart.depth);
    const design::Point2 apex = middle + side;
    double twice = 0;
    constexpr int kPieces = 32;
    design::Point2 a = edge.curve.point_at(from) - apex;
    for (int k = 1; k <= kPieces; ++k) {
      const design::Point2 b = edge.curve.point_at(from + dart.width * k / kPieces) - apex;
      twice += a.x() * b.y() - a.y() * b.x();
      a = b;
    }
    return std::fabs(twice) / 2;
  }
  return 0;
}

/// Sense in which the hole that edge `k` of Panel::hole_edges belongs to is drawn.
bool hole_counter_clockwise(const design::Panel& panel, int k) {
  double area = 0;
  for (const design::Hole& hole : panel.holes)
    for (int j = hole.first; j < hole.first + hole.count; ++j)
      if (k >= hole.first && k < hole.first + hole.count)
        area += panel.hole_edges[static_cast<std::size_t>(j)].curve.area_term();
  return area > 0;
}

}  // namespace

std::vector<std::string> edge_names(const PanelInfo& panel) {
  std::vector<std::string> names;
  for (const NamedEdge& edge : panel.edges)
    if (std::find(names.begin(), names.end(), edge.name) == names.end()) names.push_back(edge.name);
  return names;
}

const NamedEdge* find_edge(const PanelInfo& panel, std::string_view half, std::string_view name) {
  for (const NamedEdge& edge : panel.edges)
    if (edge.half == half && edge.name == name) return &edge;
  return nullptr;
}

double cut_length(const EdgeSpan& span) {
  double sum = 0;
  for (const design::EdgePart& part : span.parts) sum += part_length(part);
  return sum;
}

double cut_length(const EdgeValue& edge) {
  double sum = 0;
  for (const EdgeSpan& span : edge.spans) sum += cut_length(span);
  return sum;
}

double sewn_length(const Program& program, const design::EdgePart& part) {
  const design::Panel& panel = panel_of(program, part.panel);
  const std::string& name = design::edge_of(panel, part).name;
  const double lo = std::min(part.from, part.to), hi = std::max(part.from, part.to);
  double length = hi - lo;
  auto close = [&](double from, double to) { length -= std::max(0.0, std::min(hi, to) - std::max(lo, from)); };
  for (const design::EdgeDart& dart : panel.darts)
    if (dart.edge == name) close(dart.at - dart.width / 2, dart.at + dart.width / 2);
  for (const design::Pleat& pleat : panel.pleats)
    for (int k = 0; k < pleat.count && pleat.edge == name; ++k) {
      const double middle = pleat.at + k * pleat.spacing;
      close(middle - pleat.take() / 2, middle + pleat.take() / 2);
    }
  return length;
}

double sewn_length(const Program& program, const EdgeSpan& span) {
  double sum = 0;
  for (const design::EdgePart& part : span.parts) sum += sewn_length(program, part);
  return sum;
}

double sewn_length(const Program& program, const EdgeValue& edge) {
  double sum = 0;
  for (const EdgeSpan& span : edge.spans) sum += sewn_length(program, span);
  return sum;
}

EdgeSpan sub_span(const EdgeSpan& span, double from, double to) {
  EdgeSpan out = span;
  out.parts.clear();
  double done = 0;
  constexpr double kSliver = 1e-9;
  for (const design::EdgePart& part : span.parts) {
    const double length = part_length(part), sign = part.to >= part.from ? 1 : -1;
    const double a = std::max(from - done, 0.0), b = std::min(to - done, length);
    if (b - a > kSliver) {
      design::EdgePart piece = part;
      piece.from = a <= 0 ? part.from : part.from + sign * a;
      piece.to = b >= length ? part.to : part.from + sign * b;
      out.parts.push_back(piece);
    }
    done += length;
  }
  return out;
}

design::Point2 point_at(const Program& program, const EdgeSpan& span, double s) {
  for (std::size_t k = 0; k < span.parts.size(); ++k) {
    const design::EdgePart& part = span.parts[k];
    const double length = part_length(part);
    if (s <= length || k + 1 == span.parts.size()) {
      const double at = std::clamp(s, 0.0, length);
      return design::edge_of(panel_of(program, part.panel), part)
          .curve.point_at(part.to >= part.from ? part.from + at : part.from - at);
    }
    s -= length;
  }
  return {0, 0};
}

std::optional<double> notch_position(const Program& program, const EdgeSpan& span, std::string_view notch) {
  double done = 0;
  for (const design::EdgePart& part : span.parts) {
    const design::Panel& panel = panel_of(program, part.panel);
    const std::string& edge = design::edge_of(panel, part).name;
    for (const design::Notch& mark : panel.notches) {
      std::string_view plain = mark.name;
      if (const std::size_t dot = plain.rfind('.'); dot != std::string_view::npos)
        plain.remove_prefix(dot + 1);
      if (mark.edge != edge || (mark.name != notch && plain != notch)) continue;
      const double along = part.to >= part.from ? mark.at - part.from : part.from - mark.at;
      if (along >= -1e-9 && along <= part_length(part) + 1e-9) return done + along;
    }
    done += part_length(part);
  }
  return std::nullopt;
}

double eval_position(Program& program, const std::vector<Expr>& values, Scope& scope, double length,
                     const std::function<std::optional<double>(std::string_view)>& mark, Span span,
                     const std::string& what) {
  auto mark_of = [&](const Expr& expr) -> std::optional<double> {
    if (expr.kind != ExprKind::name) return std::nullopt;
    return mark(name_of(program, expr, scope));
  };
  if (values.empty()) fail(program, Message("G0312", what + " needs a position", span));
  if (values.size() == 1)
    if (const auto at = mark_of(values[0])) return *at;
  const Value value = eval(program, values[0], scope);
  const auto* q = value.as<Quantity>();
  if (q == nullptr || (q->dimension != kLength && !q->dimension.none()))
    fail(program,
         Message("G0306", kind_of(value) + " where " + what + " takes a length, a percentage or a mark",
                 values[0].span));
  double at = q->dimension == kLength ? q->value : q->value * length;
  if (q->dimension.none() && !(q->value >= 0 && q->value <= 1))
    fail(program,
         Message("G0309",
                 what + " at " + format_quantity(q->value, {}) + "; a fraction of an edge lies in 0 .. 1",
                 values[0].span)
             .help("give a unit for a length: `" + format_quantity(q->value, {}) + " cm`"));
  if (values.size() == 1) return at;
  const bool before = values[1].kind == ExprKind::name && values[1].text == "before";
  const bool after = values[1].kind == ExprKind::name && values[1].text == "after";
  if ((!before && !after) || values.size() != 3)
    fail(program, Message("G0313", what + " has words that mean nothing here", values[1].span)
                      .help("write `20 cm`, `50%`, `20 cm before end` or `2 cm after NOTCH`"));
  const auto from = mark_of(values[2]);
  if (!from)
    fail(program, Message("G0301", "there is no mark `" + values[2].text + "` on this edge", values[2].span)
                      .help("marks are start, end and the edge's notches"));
  return before ? *from - at : *from + at;
}

double cloth_area(const PanelInfo& info) {
  double area = info.area;
  for (const design::EdgeDart& dart : info.panel.darts) area -= dart_area(info.panel, dart);
  for (const design::InsideDart& dart : info.panel.inside_darts)
    area -= dart.width * (dart.to - dart.from).norm() / 2;
  for (const design::Hole& hole : info.panel.holes) {
    double loop = 0;
    for (int k = hole.first; k < hole.first + hole.count; ++k)
      loop += info.panel.hole_edges[static_cast<std::size_t>(k)].curve.area_term();
    area -= std::fabs(loop);
  }
  return area;
}

EdgeSpan reversed(EdgeSpan span) {
  std::reverse(span.parts.begin(), span.parts.end());
  for (design::EdgePart& part : span.parts) std::swap(part.from, part.to);
  return span;
}

EdgeSpan counter_clockwise(const Program& program, const EdgeSpan& span) {
  if (span.parts.empty()) return span;
  const bool with_curve = span.parts[0].to >= span.parts[0].from;
  const PanelInfo& info = program.panels[static_cast<std::size_t>(span.panel)];
  const design::EdgePart& first = span.parts[0];
  if (first.on == design::EdgePart::On::line) return span;
  bool loop = info.counter_clockwise;
  if (first.on == design::EdgePart::On::hole) loop = !hole_counter_clockwise(info.panel, first.edge);
  return with_curve == loop ? span : reversed(span);
}

}  // namespace garment::interpreter
