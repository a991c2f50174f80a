#pragma once
// What stands on the edges of a panel: notches, darts, pleats, allowances.
#include "interpreter/language/clauses.hpp"
#include "interpreter/language/drawing.hpp"

namespace garment::interpreter {

/// Notches, darts, pleats and tucks, then allowances, as the recipe states them. Reports; false where something was
/// wrong.
bool add_marks(Drawing& drawing);

/// A statement that stands on an edge: the edge of its `on`. Reports and throws Stop where there is none of that name.
const design::Edge& edge_under(Drawing& drawing, const RecipeItem& item, Clauses& clauses);
/// As `edge_under`, but of the outline: elsewhere neither darts nor pleats can open (G0418).
const design::Edge& outline_edge_under(Drawing& drawing, const RecipeItem& item, Clauses& clauses);

/// A position on the edge, m from its drawn start; marks are start, end and the edge's notches.
double position_on(Drawing& drawing, const BoundClause& at, const design::Edge& edge, const std::string& what);

/// `dart` in each of its three forms.
void add_dart(Drawing& drawing, const RecipeItem& item);

/// `pleat` and `tuck`.
void add_pleat(Drawing& drawing, const RecipeItem& item);

inline constexpr double kWidestAllowance = 0.3;  ///< m

/// `allowance LENGTH [on EDGE]`.
void add_allowance(Drawing& drawing, const RecipeItem& item);
/// Reports allowances that lie on each other (G0431).
void check_allowances(Program& program, const PanelInfo& info);
/// Gives the edges that a seam with an `allowance` sews that width, in whole, unless they state one of their own; where
/// several such seams sew an edge, the widest.
void take_seam_allowances(Program& program);

/// The stretch of an edge that a dart's mouth or a pleat takes, [from, to] in m, may not reach beyond the edge (G0408)
/// nor over that of another (G0417).
void check_stretch(Drawing& drawing, const RecipeItem& item, const design::Edge& edge, double from, double to);

}  // namespace garment::interpreter
