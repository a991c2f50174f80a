#pragma once
#include "runtime/body/body.hpp"
#include "runtime/modeller/elements.hpp"

namespace garment::modeller {

/// Holds of attachments and pins, at the start positions (`model.start` is filled). Attached edges that slide
/// keep to the height of their level; held ones, and pins, keep their place. A particle gets one hold, the
/// first that stays in place. `borders` and `outlines` tell which border vertex lies on which part of which
/// edge.
void add_holds(const design::Garment& garment, const std::vector<body::Body>& bodies,
               const std::vector<BorderPanel>& outlines, const Borders& borders,
               const std::vector<MeshedPanel>& panels, model::Model& model, Findings& findings);

}  // namespace garment::modeller
