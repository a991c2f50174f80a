#pragma once
// Edge algebra: edges by name, parts of edges, lengths, positions on an edge.
#include <optional>
#include <string>
#include <vector>

#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// Names by which a panel's edges are called, without halves.
std::vector<std::string> edge_names(const PanelInfo& panel);
/// The edge `name` of the half ("" for the whole panel or the joined edge); nothing if there is none.
const NamedEdge* find_edge(const PanelInfo& panel, std::string_view half, std::string_view name);

/// Length as cut, m.
double cut_length(const EdgeSpan& span);
double cut_length(const EdgeValue& edge);
/// Length as sewn: mouths of darts are closed, pleats and tucks folded.
double sewn_length(const Program& program, const design::EdgePart& part);
double sewn_length(const Program& program, const EdgeSpan& span);
double sewn_length(const Program& program, const EdgeValue& edge);

/// The piece of `span` between two arc lengths along its drawn direction (from < to), m.
EdgeSpan sub_span(const EdgeSpan& span, double from, double to);
/// Point at arc length `s` along the drawn direction.
design::Point2 point_at(const Program& program, const EdgeSpan& span, double s);
/// Arc length along the span of a notch of its panel; nothing if no such notch lies on it.
std::optional<double> notch_position(const Program& program, const EdgeSpan& span, std::string_view notch);

/// A position on an edge of `length` metres: `20 cm`, `50%`, `20 cm before end`, `1 cm after MARK`, `MARK`,
/// where `mark` gives the arc length of a named mark ("start", "end", a notch). Reports and throws Stop
/// otherwise.
double eval_position(Program& program, const std::vector<Expr>& values, Scope& scope, double length,
                     const std::function<std::optional<double>(std::string_view)>& mark, Span span,
                     const std::string& what);

/// Area of a panel with its darts and holes cut away, m^2.
double cloth_area(const PanelInfo& panel);

/// The part with both ends turned to run with its loop so that the cloth lies to the left, face up: counter-clockwise
/// round an outline, clockwise round a hole. A line inside stays as drawn.
EdgeSpan counter_clockwise(const Program& program, const EdgeSpan& span);
EdgeSpan reversed(EdgeSpan span);

}  // namespace garment::interpreter
