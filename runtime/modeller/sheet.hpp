#pragma once
// The sewn sheet as bending sees it: triangles with their rest shapes, and who lies beside whom once the
// seams are merged.
#include <array>
#include <vector>

#include "runtime/modeller/elements.hpp"

namespace garment::modeller {

struct Sheet {
  std::vector<model::Indices<3>> vertex;  ///< of triangle t, counter-clockwise in its panel
  std::vector<model::Indices<3>> particle;
  std::vector<std::array<model::Index, 3>> next;  ///< triangle beyond the side opposite corner k; -1 on a
                                                  ///< border; where more than two meet, of those of one panel
  std::vector<model::Index> first;                  ///< CSR over particles [n + 1] into `corner`
  std::vector<std::array<model::Index, 2>> corner;  ///< (triangle, corner) at each particle

  std::size_t n_particles() const { return first.size() - 1; }
};

Sheet make_sheet(const model::Model& model);

/// Triangles round a particle in order, closed: of several sheets that meet there the first that goes all round; empty on free
/// borders and where none does.
/// Entry k: triangle, and its corners (centre, this ring particle, next ring particle) as corner numbers.
struct FanTriangle {
  model::Index triangle;
  int centre, here, ahead;
};
std::vector<FanTriangle> closed_fan(const Sheet& sheet, model::Index particle);

}  // namespace garment::modeller
