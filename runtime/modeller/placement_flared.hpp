#pragma once
// Panels that fan out from the edge they hang by, wider than a ring round the body has room for: whole circle skirts.
#include <cstddef>
#include <vector>

#include "runtime/modeller/placement_workspace.hpp"

namespace garment::modeller {

/// Wraps those of `panels` (on one ring round the torso) that hang by an arc as a cone below that arc's level, in flutes where the cone
/// is narrower than the cloth, so that their lengths are kept and their seams are closed from the start. Does so only for arcs that
/// turn, all together, by more than a little over half a circle: what fans out less goes round the body as an upright ring.
/// Returns those it laid, none where the cone finds no room beside the body.
std::vector<std::size_t> lay_flared(Workspace& w, const body::Body& body, const std::vector<std::size_t>& panels);

}  // namespace garment::modeller
