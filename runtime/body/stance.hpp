#pragma once
// How a scan stands: its unit, which way is up, which way it looks, whether its head is there. Brings it into
// the stance that everything else takes for granted: metres, y up, facing +z, soles at y = 0, upright plane
// of symmetry x = 0.
#include <optional>
#include <string>

#include "runtime/body/anatomy.hpp"

namespace garment::body {

struct Stance {
  TriangleMesh mesh;      ///< turned, scaled and moved
  Landmarks marks;        ///< of `mesh`; `stature` is an estimate where the head is missing
  double unit = 1;        ///< m for one unit of the file
  std::string unit_name;  ///< "m", "cm", "mm", "inch", or the number that was given
  std::string up, front;  ///< axes of the file nearest to these: "+y", "-z"
  bool head = true;
};

struct StanceResult {
  std::optional<Stance> stance;
  Findings findings;
};

/// Finds the stance of a mesh with one vertex a place and agreeing faces. `unit` (m for one unit of the file)
/// is guessed from the height where it is not given: 0.7 .. 2.6 is metres, 45 .. 90 inches, 90 .. 260
/// centimetres, 700 .. 2600 millimetres. Errors: G0714, no upright body, with what is missing. Notes: G0715 a
/// guessed unit other than the metre, G0716 the body was turned, G0717 no head.
StanceResult find_stance(const TriangleMesh& mesh, std::optional<double> unit, const std::string& name);

}  // namespace garment::body
