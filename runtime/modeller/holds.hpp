#pragma once
#include "runtime/body/body.hpp"
#include "runtime/modeller/elements.hpp"

namespace garment::modeller {

/// Holds of attachments and pins, at the start positions (`model.start` is filled). Attached edges that slide
/// keep to the height of their level; held ones, and pins, keep their place. A particle gets one hold, the
/// first that stays in place. `borders` and `outlines` tell which border vertex lies on which part of which
/// edge.
/// Clamps that move and bodies on paths bring their motions, and what is attached to a body goes with it; pins and clamps are listed among the holders.
void add_holds(const design::Garment& garment, const std::vector<body::Body>& bodies,
               const std::vector<BorderPanel>& outlines, const Borders& borders,
               const std::vector<MeshedPanel>& panels, model::Model& model, Findings& findings);

/// Holds, their motions and what jaws do to the cloth, of a model of the same cloth: after a release.
void take_holds(const model::Model& from, model::Model& model);

}  // namespace garment::modeller
