#pragma once
// The lines along which cloth cuts cloth, and which side of which line should go back.
#include <cstdint>
#include <vector>

#include "runtime/simulator/contact_mesh.hpp"
#include "runtime/simulator/untangle.hpp"

namespace garment::simulator {

/// A contour is a connected curve where two pieces of cloth cut each other; it draws one line on each of them
/// (or two on one). Every line has two banks. The particles nearest to a bank are its region; the bank with
/// the smallest region of all lines of a contour is astray: that cloth has gone through and comes back.
/// (Baraff, Witkin, Kass 2003, Untangling cloth, fill the banks of closed paths only; nearest regions serve
/// lines that end inside the cloth as well.)
struct Contours {
  std::vector<Index> contour;  ///< per hit; -1 where a body takes part
  std::vector<Index> astray;   ///< per hit: the end of the edge that goes back, -1: none
  std::vector<Index>
      region;   ///< per particle: the contour in whose astray region it lies, near the line; else -1
  Index n = 0;  ///< contours
};

Contours find_contours(const ContactMesh& mesh, const std::vector<Vector3d>& x, const Tangle& tangle);

}  // namespace garment::simulator
