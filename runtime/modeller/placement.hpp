#pragma once
// Where every particle starts in space: panels are wrapped onto body parts, laid rigidly, or carried on from the panels
// they are sewn to.
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/body/body.hpp"
#include "runtime/design/garment.hpp"
#include "runtime/model/model.hpp"
#include "runtime/modeller/sewing.hpp"

namespace garment::modeller {

/// Fills `model.start` [n_particles] from the flat positions (`vertex_uv`) and the placements of `garment.panels`, which
/// stand in the order of `model.panels`. A particle that several panels share starts at the mean of its places. Wraps
/// keep lengths within 1 %. With `dress`, panels placed at a point of space are moved out of persons. Warns of those of
/// the seams `sides` that join rings otherwise than they are placed. Returns false, with findings that name the panel, where no place could be found.
bool place_panels(const design::Garment& garment, const std::vector<body::Body>& bodies, const std::vector<SewnSides>& sides,
                  model::Model& model, Findings& findings, bool dress = true);

}  // namespace garment::modeller
