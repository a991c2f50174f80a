#pragma once
// Where the pieces and edges of a pattern stand in space, and what they are sewn to: the facts from which
// names and attachments are guessed.
#include <string>
#include <vector>

#include "runtime/design/garment.hpp"
#include "runtime/io/pattern_json.hpp"

namespace garment::io {

struct EdgePlace {
  Eigen::Vector3d start, end, middle;         ///< m, as placed
  double length = 0;                          ///< m
  int partner_panel = -1, partner_edge = -1;  ///< of its first seam; -1: free
  bool sewn() const { return partner_panel >= 0; }
  /// More up and down than along: |dy| over the horizontal distance of its ends.
  bool upright() const;
};

struct PanelPlace {
  std::vector<EdgePlace> edges;
  Eigen::Vector3d low, high;  ///< corners of its box, m
  int piece = 0;              ///< panels sewn together have one number
  Eigen::Vector3d center() const { return (low + high) / 2; }
  bool spans_middle() const { return low.x() < -0.03 && high.x() > 0.03; }
  double widest() const { return std::max(std::abs(low.x()), std::abs(high.x())); }
};

struct GarmentPlace {
  std::vector<PanelPlace> panels;
  std::vector<double> piece_low, piece_high;  ///< lowest and highest y of each piece, m
};

GarmentPlace garment_place(const design::Garment& garment);

/// Height of the bust in a frame (m): what reaches above it hangs from the shoulders.
inline double bust_height(PatternFrame frame) { return frame == PatternFrame::floor ? 1.2 : 0.1; }

}  // namespace garment::io
