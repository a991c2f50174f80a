#pragma once
// Walking an outline: edges of a recipe to curves.
#include <vector>

#include "interpreter/language/recipe.hpp"

namespace garment::interpreter {

/// The edges of a closed loop, in drawn order. Reports and throws Stop where there is none. A circle becomes
/// two half circles "NAME.1", "NAME.2".
std::vector<design::Edge> draw_outline(Program& program, const Recipe& recipe, std::vector<Span>& spans);

/// Reports edges that cross (G0402).
void check_crossings(Program& program, const design::Panel& panel, const std::vector<Span>& spans);

/// How far one can go from `from` along the unit vector `way` inside the outline, m; at least `skip`.
double depth_inside(const design::Panel& panel, const design::Point2& from, const design::Point2& way,
                    double skip);

/// True if the point lies inside the outline or within `tolerance` of it.
bool contains(const design::Panel& panel, const design::Point2& p, double tolerance);

}  // namespace garment::interpreter
