#pragma once
// Which panel a failed drape is to be blamed on.
#include <string>
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/model/model.hpp"

namespace garment::simulator {

struct Culprit {
  std::string name;  ///< of the panel, as messages write it, "`front`"
  OriginId origin;
};

/// The panel whose particles have the largest sum of squares of `per_particle` [n_particles] (forces, speeds, positions); what is no
/// number is larger than all numbers. A model without panels has "the garment".
Culprit panel_with_most(const model::Model& model, const std::vector<model::Vector3d>& per_particle);

/// G0803: positions, `x`, are no longer numbers.
Finding infinite_positions(const model::Model& model, const std::vector<model::Vector3d>& x);

}  // namespace garment::simulator
