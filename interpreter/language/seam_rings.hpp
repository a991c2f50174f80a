#pragma once
// Checks of seams against each other: which corners come together, where rings start, whether the cloth is
// twisted.
#include <utility>
#include <vector>

#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// Corners of panels, joined where seams begin and end. Points of a panel within 1 mm are one corner.
class SeamCorners {
 public:
  explicit SeamCorners(const Program& program) : program_(program) {}

  std::size_t of_point(int panel, const design::Point2& p);
  std::size_t of(const design::EdgePart& part, bool at_end);
  void join(std::size_t a, std::size_t b);
  /// The outer ends of a drawn dart's legs come together.
  void join_legs(int panel);

 private:
  std::size_t root(std::size_t k) const;

  const Program& program_;
  std::vector<std::pair<int, design::Point2>> points_;
  std::vector<std::size_t> parent_;
};

/// Turns the closed sides of a seam to begin where `start at` says (G0512 where no ring passes there), and
/// reports rings whose beginning nothing tells (G0511).
void settle_rings(Program& program, SeamCorners& corners, SeamInfo& info);

/// Walks the panels over the seams: reports a seam that would join them with the face on both sides (G0510).
void check_twists(Program& program);

}  // namespace garment::interpreter
