#pragma once
// Shapes of regions as script text.
#include <string>

#include "interpreter/language/unparse_text.hpp"

namespace garment::interpreter::text {

/// A value that gives the shape on `panel` back: `within(10 cm, front.waist) and above(40 cm)`. Shapes of a
/// drawn half are written out for both halves. Empty where the shape holds nowhere.
std::string region_shape(const design::Garment& garment, const Names& names, std::size_t panel,
                         const design::RegionShape& shape);

}  // namespace garment::interpreter::text
