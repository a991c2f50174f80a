#pragma once
// Panels that are declared over or under others, held against how they lie.
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/design/garment.hpp"
#include "runtime/model/model.hpp"

namespace garment::modeller {

/// How a panel lies on the one that it is declared over or under, in parts of its area as cut, m^2.
struct LayerOrder {
  double together = 0;  ///< where the other one lies within reach, along its own normal
  double wrong = 0;     ///< of that: where it lies on the side of the other one that it was not declared on
};

/// One pass over the triangles of the panel, at the positions `x` [n_particles], m. `reach` is the distance, m, within which the panels
/// lie on one another. Cloth beside the other panel's border lies on nothing.
LayerOrder layer_order(const model::Model& model, const std::vector<model::Vector3d>& x, const design::Stacking& stacking, double reach);

/// What starts on the wrong side of what it is declared over or under (G0609, a warning: it may still turn over).
Findings started_out_of_order(const design::Garment& garment, const model::Model& model);

/// What came to rest at `x` on the wrong side of what it is declared over or under (G0811). A corner or a hem that crossed is no finding:
/// more than half of what lies together must be wrong.
Findings rested_out_of_order(const design::Garment& garment, const model::Model& model, const std::vector<model::Vector3d>& x);

}  // namespace garment::modeller
