#pragma once
#include "runtime/base/finding.hpp"
#include "runtime/model/model.hpp"

namespace garment::model {

/// Checks what every stage after the modeller relies on: arrays of one kind have equal lengths, indices lie
/// within what they refer to, numbers are finite, masses, lengths and areas positive, ranges of panels and
/// fits in order, laws rising. Empty for every model that the modeller makes; G0490, at most ten times, for a
/// model made otherwise.
Findings validate(const Model& model);

}  // namespace garment::model
