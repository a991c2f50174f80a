#pragma once
// Walking an outline: edges of a recipe to curves.
#include <vector>

#include "interpreter/language/drawing.hpp"

namespace garment::interpreter {

/// A closed loop to walk: an outline or a hole.
struct Loop {
  const RecipeItem* head = nullptr;
  std::vector<const RecipeItem*> edges;
  bool folded = false;  ///< an outline that is opened about one of its edges
  Span fold_span;
};

/// Walks the loop and adds its edges, in drawn order, and the places of their names; a later edge may speak of an
/// earlier one. Reports and throws Stop where there is no loop. A circle becomes two half circles "NAME.1", "NAME.2".
void draw_loop(Drawing& drawing, const Loop& loop, std::vector<design::Edge>& edges, std::vector<Span>& spans);

/// A line inside a panel: `line NAME from P to Q [CURVE]`. Reports and throws Stop.
design::Edge draw_line(Drawing& drawing, const RecipeItem& item);

/// Reports edges of one loop that cross (G0402); `owner` as in "edges `a` and `b` of OWNER cross".
void check_crossings(Program& program, const std::string& owner, const std::vector<design::Edge>& edges,
                     const std::vector<Span>& spans);

/// How far one can go from `from` along the unit vector `way` inside the outline, m; at least `skip`.
double depth_inside(const design::Panel& panel, const design::Point2& from, const design::Point2& way,
                    double skip);

/// True if the point lies inside the outline or within `tolerance` of it.
bool contains(const design::Panel& panel, const design::Point2& p, double tolerance);

}  // namespace garment::interpreter
