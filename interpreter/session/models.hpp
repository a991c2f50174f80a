#pragma once
// From the declared garment to the coarser particle models that a drape starts on.
#include <vector>

#include "runtime/body/body.hpp"
#include "runtime/design/garment.hpp"
#include "runtime/model/model.hpp"

namespace garment::session {

/// Models at 2^k times the stated grid spacing, coarsest first, `fine` not among them; empty for small
/// garments and where a panel is too small for a coarser grid. `bodies` are those of the garment, in the same
/// order.
std::vector<model::Model> coarse_models(const design::Garment& garment, const std::vector<body::Body>& bodies,
                                        const model::Model& fine, bool dress = true);

}  // namespace garment::session
