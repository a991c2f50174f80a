#pragma once
// Seams and chains of edges as script text.
#include <string>
#include <vector>

#include "interpreter/language/unparse_text.hpp"
#include "runtime/design/garment.hpp"

namespace garment::interpreter::text {

/// "front.side", or "front.side[2 cm .. end]" for a part.
std::string edge_part(const design::Garment& garment, const Names& names, const design::EdgePart& part);

/// The statement of seam `index`. Sides run oppositely round their loops (counter-clockwise, face up) unless
/// `reversed`; links of a chain that go against their side get a minus.
std::string seam(const design::Garment& garment, const Names& names, std::size_t index);

}  // namespace garment::interpreter::text
