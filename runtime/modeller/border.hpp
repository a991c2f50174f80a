#pragma once
// Particles on the outlines: corners always, between them where grid lines meet the border, evenly spaced.
#include <array>
#include <vector>

#include "runtime/modeller/matching.hpp"

namespace garment::modeller {

/// The grid of one panel: lines p = i hp and q = j hq in a frame turned by the grain. p is weft and q is
/// warp, turned on by `quarter` right angles: panels whose grain is a multiple of 90 deg keep the panel's
/// axes, so that their symmetry about the fold survives to the bit.
struct GridFrame {
  Point2 origin{0, 0};
  double cos = 1, sin = 0;
  int quarter = 0;  ///< weft is p turned counter-clockwise by this many right angles, 0..3
  double hp = 0.01, hq = 0.01;
  bool symmetric = false;  ///< the fold is the line p = 0

  Eigen::Vector2d to_grid(const Point2& x) const {
    Eigen::Vector2d d = x - origin;
    return {cos * d.x() + sin * d.y(), cos * d.y() - sin * d.x()};
  }
  Point2 to_panel(const Eigen::Vector2d& g) const {
    return origin + Point2(cos * g.x() - sin * g.y(), sin * g.x() + cos * g.y());
  }
  /// Unit directions of weft and warp in panel coordinates.
  Point2 weft() const;
  Point2 warp() const { return {-weft().y(), weft().x()}; }
};

/// Spacings near `h` that divide the panel's extent (from the fold where it is symmetric), lines through its
/// lowest point.
GridFrame make_frame(const design::Panel& panel, const Outline& outline, double h);

/// A panel's border particles, loop by loop, with the cloth to the left; then those of its inner lines, line by line. Segment
/// k runs from vertex k to vertex next[k].
struct Border {
  std::vector<Point2> at;
  std::vector<int> next;      ///< k + 1, at the end of a loop its first vertex, at the end of a line -1
  std::vector<int> loops;     ///< first vertex of each loop and line
  std::size_t n_closed = 0;   ///< number of loops that are closed
  std::vector<int> same;      ///< the vertex that stands for this one where lines meet the border or each other; else itself
  std::vector<double> bulge;  ///< area between segment and curve, positive outside the polygon, m^2
  std::vector<int> piece;     ///< of segment k
  std::vector<double> arc_from, arc_to;  ///< ends of segment k as arc lengths on its piece's curve, m
  std::size_t half =
      0;  ///< symmetric panels: vertex `half` is the upper fold point, vertex 0 the lower; else 0

  /// Number of vertices on closed loops; the others lie on lines.
  std::size_t n_outline() const { return n_closed < loops.size() ? static_cast<std::size_t>(loops[n_closed]) : at.size(); }
  /// One past the last vertex of loop or line `l`.
  int end_of(std::size_t l) const { return l + 1 < loops.size() ? loops[l + 1] : static_cast<int>(at.size()); }
};

struct Borders {
  std::vector<Border> panels;
  std::vector<int> stretch_first;  ///< of every stretch: its first vertex in its panel's border
  std::vector<int> stretch_loop;   ///< the loop it belongs to
  std::vector<int>
      stretch_count;  ///< number of its segments; 0: shorter than 0.2 h, drawn together to one point
};

Borders make_borders(const std::vector<BorderPanel>& panels, const std::vector<GridFrame>& frames,
                     const Matched& matched);

/// Border vertices that lie on a part of an edge or line, within 0.2 h, in the border's order.
std::vector<int> vertices_on(const design::EdgePart& part, const BorderPanel& outline, const Border& border);

/// Fractions 0 = f_0 < ... < f_n = 1 for a border `length` grid spacings long: candidates (fraction, weight
/// 0..1) where they fit, evenly filled between, steps near one spacing and none under 0.55 where the length
/// allows it.
std::vector<double> choose_fractions(std::vector<std::array<double, 2>> candidates, double length);

}  // namespace garment::modeller
