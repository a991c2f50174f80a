#pragma once
// Bodies on paths, where they have come to.
#include <vector>

#include "runtime/body/body.hpp"
#include "runtime/model/model.hpp"

namespace garment::simulator {

/// The bodies at `time` (s): copies, those that a motion of the model has moved with their surface, levels and parts moved and
/// their search structures made anew (some 10 ms each).
std::vector<body::Body> bodies_at(const std::vector<body::Body>& bodies, const model::Model& model, double time);

}  // namespace garment::simulator
