#pragma once
// The 2D/3D Modeller: declared garment in, particle Model out (source paper, section 3 and Table 1).
#include <optional>
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/base/limits.hpp"
#include "runtime/body/body.hpp"
#include "runtime/design/garment.hpp"
#include "runtime/model/model.hpp"

namespace garment::modeller {

struct ModelOptions {
  double resolution = 0;  ///< grid spacing for every panel, m; 0: what each panel states
  /// Factor on the grid spacings, for coarse grids of a garment: 2, 4. A panel too narrow for that keeps a
  /// grid of two spacings across its mean width, or what it states if that is coarser still.
  double coarsen = 1;
  std::size_t max_particles = kMaxParticles;
  /// Keep placed panels out of the bodies. False where the shape comes from elsewhere, and the start with its places of
  /// pins is not used: it takes most of the time.
  bool dress = true;
};

struct ModelResult {
  std::optional<model::Model> model;  ///< nothing when there are errors
  Findings findings;
};

/// Grids every panel, closes darts, sews (merges) the seams, gives masses, springs and bending stencils,
/// places the garment on its bodies. `bodies` are the built bodies of `garment.bodies`, in the same order.
ModelResult build_model(const design::Garment& garment, const std::vector<body::Body>& bodies,
                        const ModelOptions& options = {});

}  // namespace garment::modeller
