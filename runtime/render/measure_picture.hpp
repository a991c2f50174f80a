#pragma once
// A person with the tapes that measured it, from the front and from the side.
#include <string>
#include <vector>

#include "runtime/body/body.hpp"

namespace garment::render {

struct TapeCourse {
  std::string label;  ///< "waist 81.2"
  std::vector<Eigen::Vector3d> course;
  bool closed = true;      ///< a girth; else a length
  bool from_side = false;  ///< a length that the side view shows
};

/// Bytes of a PNG file, 1600 x 1100. `mesh` stands on y = 0 and faces +z. `caption` stands below. Empty where
/// the mesh is.
std::string render_measures(const body::TriangleMesh& mesh, const std::vector<TapeCourse>& tapes,
                            const std::string& caption);

}  // namespace garment::render
