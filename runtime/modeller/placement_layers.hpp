#pragma once
// Panels that lie over or under others: laid on them, turned over seams with them, and kept clear of them.
#include "runtime/modeller/placement_workspace.hpp"

namespace garment::modeller {

/// Lays one panel that has no place yet on the placed one that it is said to lie over or under; true where there was one. Which
/// comes next does not depend on the order of declarations.
bool lay_on_others(Workspace& w);

/// Where the particles of necklines are to lie before stands are carried on from there: along the necklines, evenly spread.
std::vector<std::pair<model::Index, Eigen::Vector3d>> even_necklines(const Workspace& w);

/// Carries a panel on from placed ones that share a seam with it, where another one is to be turned over it: what a collar's leaf is to
/// lie along must not jump. False, and nothing, for other panels.
bool carry_stand(Workspace& w, std::size_t panel);

/// Takes apart cloth that crosses cloth in `model.start`: first the panels that lie on no other, then, with the others laid on
/// them anew, linings too; what is turned over opens as far as it must. Says which panels could not be freed (G0608).
void part_cloth(Workspace& w, model::Model& model);

}  // namespace garment::modeller
