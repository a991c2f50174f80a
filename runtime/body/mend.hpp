#pragma once
// A scan made fit for slicing: faces that agree, holes closed. Only for measuring; cloth needs a surface that
// is sound.
#include <cstddef>

#include "runtime/body/body.hpp"

namespace garment::body {

struct Mended {
  std::size_t turned =
      0;  ///< triangles that disagreed with their neighbours, or whose component looked inward
  std::size_t holes = 0;  ///< rims that were closed by a fan about their middle
};

/// Lets the faces of every component agree and look outward, then closes its rims. `mesh` has one vertex a
/// place (clean_mesh). Edges of three and more triangles are passed over.
Mended mend(TriangleMesh& mesh);

}  // namespace garment::body
