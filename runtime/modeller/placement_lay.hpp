#pragma once
// Placing a panel that lies over or under another one: pockets, facings, linings.
#include <vector>

#include "runtime/model/model.hpp"

namespace garment::modeller {

/// Lays `panel` on the placed panel `other`, `gap` (m) towards its face, or towards its back where it is negative: the two
/// patterns are brought together at the particles that they share, by a rotation or, where that fits better, by turning the
/// panel over; then each vertex takes the place of `other` there, and lies off it. `flat` [n_vertices] holds the panel's own
/// shape, its pleats folded: places in its plane, and the distance from it, m. Fills `place` [n_vertices]; false where they
/// share fewer than two particles.
bool lay_panel(const model::Model& model, std::size_t panel, std::size_t other, const std::vector<Eigen::Vector3d>& flat, double gap,
               std::vector<Eigen::Vector3d>& place);

/// True where `panel`, brought onto `other` like that, lies face down and reaches beyond it: it is a collar's leaf rather than a flap.
bool turns_beyond(const model::Model& model, std::size_t panel, std::size_t other, const std::vector<Eigen::Vector3d>& flat);

}  // namespace garment::modeller
