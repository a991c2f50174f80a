#pragma once
// Drawn points made into edges: loops chained, corners found, runs of points between them fitted by one edge
// each.
#include <vector>

#include "runtime/design/panel.hpp"
#include "runtime/io/dxf_piece.hpp"

namespace garment::io {

/// Courses joined where their ends lie within `meet` (m), whichever way they run; closed ones repeat no
/// point. At most `most` open ones are joined, the rest is left as it is.
std::vector<DxfCourse> chained(std::vector<DxfCourse> courses, double meet = 1e-4, std::size_t most = 8192);

/// Signed area of the polygon of a course, its arcs sampled within 0.02 mm, m^2.
double course_area(const DxfCourse& course);

/// The points of a course, arcs sampled within 0.02 mm.
std::vector<design::Point2> sampled(const DxfCourse& course);

/// A closed course as edges, counter-clockwise, without names. Corners are at the vertices that `turns` name
/// (within 0.3 mm) or, where there are none, at turns of more than 20 degrees; points in `curves` are none. A
/// run that is straight within 0.02 mm is a line, one arc an arc, another a spline through its points.
std::vector<design::Edge> outline_of(DxfCourse loop, const std::vector<design::Point2>& turns,
                                     const std::vector<design::Point2>& curves);

/// An open course as one curve; a closed one ends where it starts.
geometry::Curve curve_of(const DxfCourse& course);

/// True if `p` lies within the polygon.
bool within(const std::vector<design::Point2>& polygon, const design::Point2& p);
/// Distance of a point from the border of the polygon, m.
double border_distance(const std::vector<design::Point2>& polygon, const design::Point2& p);

}  // namespace garment::io
