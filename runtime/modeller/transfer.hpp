#pragma once
// The shape of a garment carried over to the garment as it was changed, by material coordinates.
#include <string>
#include <vector>

#include "runtime/design/garment.hpp"
#include "runtime/model/model.hpp"

namespace garment::modeller {

/// A garment with its model; both outlive the transfer.
struct ModelledGarment {
  const design::Garment& garment;
  const model::Model& model;
};

/// The panel of that name; -1 where there is none.
inline model::Index find_panel(const model::Model& model, const std::string& name) {
  for (std::size_t p = 0; p < model.panels.size(); ++p)
    if (model.panels[p].name == name) return static_cast<model::Index>(p);
  return -1;
}

struct Transferred {
  std::vector<model::Vector3d> position;  ///< m [n_particles of the new model]
  std::size_t n_kept = 0;                 ///< particles that lie exactly where they lay
  std::size_t n_fresh = 0;                ///< particles of panels that were not there before
};

/// Positions of the changed garment's particles on the old garment's shape `position` [n_particles of the old
/// model]. Panels are known by name. A particle finds its place in the old pattern by PatternWarp, takes the
/// point of the old triangle there (carried on beyond the border), and the mean of its panels where a seam
/// merges several. A panel that was not changed keeps its positions bit for bit. A new panel keeps its
/// placement, moved as its seams are moved.
Transferred transfer(const ModelledGarment& before, const std::vector<model::Vector3d>& position,
                     const ModelledGarment& now);

}  // namespace garment::modeller
