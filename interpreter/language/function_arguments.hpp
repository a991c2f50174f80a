#pragma once
// Reading the arguments of a builtin: each with its kind, else a report and Stop; and what several of them
// answer alike.
#include <string>

#include "interpreter/language/evaluate.hpp"
#include "interpreter/language/function_table.hpp"

namespace garment::interpreter::detail {

/// Place of argument `k`, of the whole call where it was not given.
Span place(const Call& call, std::size_t k);
/// "`polar`", for messages.
std::string called(const Call& call);

Quantity number_at(Call& call, std::size_t k);
double length_at(Call& call, std::size_t k);
double angle_at(Call& call, std::size_t k);
/// A point in the plane, in metres.
design::Point2 point_at(Call& call, std::size_t k);
/// A parameter that is a direction: a unit vector.
design::Point2 direction_at(Call& call, std::size_t k);
geometry::Curve curve_at(Call& call, std::size_t k);
/// One point or a list of points.
std::vector<design::Point2> points_at(Call& call, std::size_t k);
const ListBody& list_at(Call& call, std::size_t k);
/// A position along `curve`: a length or a fraction.
double position_at(Call& call, std::size_t k, const geometry::Curve& curve);

/// What the drape measured; reports where there is no drape yet.
const DrapeMeasures& drape_of(Call& call);

/// The value; reports where it is not finite.
Value finite(Call& call, Quantity q);
Value plane_point(const design::Point2& p, int panel = -1);

}  // namespace garment::interpreter::detail
