#pragma once
// Curves as values: drafted ones, and edges of panels seen as curves.
#include <optional>
#include <string>

#include "interpreter/language/program.hpp"

namespace garment::interpreter {

constexpr double kMeets = 1e-5;    // m, ends this near each other are one point
constexpr double kFarthest = 100;  // m from the origin, of what is drawn

/// The curve that a value stands for, in metres: a drafted curve, an edge, part of an edge, or a chain of edges of one
/// panel, walked in the direction of the value (`-a` backwards). Nothing where the value is of another kind, or where
/// the links of a chain do not meet.
std::optional<geometry::Curve> as_curve(const Program& program, const Value& value);

/// As `as_curve`, but a value that is no curve is reported (G0306, G0340) and throws Stop. `what` names the place for
/// the message ("`offset`").
geometry::Curve curve_of(Program& program, const Value& value, Span span, const std::string& what);
geometry::Curve eval_curve(Program& program, const Expr& expr, Scope& scope, const std::string& what);

/// A drafted curve as a value; its memory is counted. Refuses curves of no length, with points that are not finite or
/// further than 100 m from the origin (G0341).
Value curve_value(Program& program, geometry::Curve curve, Span span);

/// A position along a curve of `length` metres: a length, or a fraction 0 .. 1. Reports and throws Stop where it is
/// neither or lies beyond the ends.
double position_along(Program& program, const Value& value, double length, Span span, const std::string& what);

/// `a + b` of curves (`backwards`: `a - b`, b walked from its end): one curve. Refuses ends that do not meet (G0340).
Value join_curves(Program& program, const Value& a, const Value& b, bool backwards, Span span);

}  // namespace garment::interpreter
