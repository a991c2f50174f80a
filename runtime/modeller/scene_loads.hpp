#pragma once
// What acts on the cloth beside its weight and the bodies: forces, pressures, bilateral constraints, friction of pairs, air.
#include "runtime/base/finding.hpp"
#include "runtime/body/body.hpp"
#include "runtime/modeller/elements.hpp"

namespace garment::modeller {

/// Fills loads, pressed triangles, rods (with their ties), the plane holds of constraints, friction of pairs and the air. The
/// panels must be placed and the holds of pins and clamps be there. A force on a point goes to the corners of its triangle by
/// barycentric weights; on_line and on_plane hold the particle next to their point, as a pin does; distance and equal are
/// rods between the points. Findings: what names no panel (G0652).
void add_scene_loads(const design::Garment& garment, const std::vector<body::Body>& bodies,
                     const std::vector<MeshedPanel>& panels, model::Model& model, Findings& findings);

/// The particle of a panel that is next to a point of its pattern; -1 without such a panel.
model::Index particle_next_to(const std::vector<MeshedPanel>& panels, const model::Model& model, int panel,
                              const design::Point2& point);

}  // namespace garment::modeller
