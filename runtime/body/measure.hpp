#pragma once
// Girths at any height, and the levels of a body in a row.
#include <string>
#include <vector>

#include "runtime/body/body.hpp"
#include "runtime/body/slice.hpp"

namespace garment::body {

/// What a tape lies on at height y (m), as a convex polygon in (x, -z), counter-clockwise from above: the
/// torso without arms on a person, one leg below the crotch, everything on a plain shape or an unknown mesh.
/// Empty beside the body.
Loop hull_section(const Body& body, double y);

/// Length of that tape, m; 0 where nothing is.
double girth(const Body& body, double y);

struct MeasureRow {
  std::string level;
  double height = 0;  ///< m above the lowest point of the body
  double girth = 0;   ///< m
};
/// All levels of a person from top to bottom; a plain shape gives one row "whole" at half its height.
using MeasureTable = std::vector<MeasureRow>;
MeasureTable measure(const Body& body);

}  // namespace garment::body
