#pragma once
// Regions, layers, closures, ironing as script text.
#include <string>
#include <vector>

#include "interpreter/language/unparse_text.hpp"

namespace garment::interpreter::text {

/// The statements of all hems, tacks, buttons, zips, regions with their factors, layers, pads, irons and
/// starches, in an order in which a reader meets what they speak of. Regions of panels on the fold are
/// written for the opened panel.
std::vector<std::string> cloth_statements(const design::Garment& garment, const Names& names);

/// " under front over pocket", or nothing: the clauses of panel `index`.
std::string stacking_clauses(const design::Garment& garment, const Names& names, std::size_t index);

/// " lapped 1 cm ironed open", or nothing.
std::string finish_clauses(const design::Garment& garment, const Names& names, const design::Seam& seam);

}  // namespace garment::interpreter::text
