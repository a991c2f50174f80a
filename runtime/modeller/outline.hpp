#pragma once
// The border of a panel after its darts are cut: closed loops of pieces, each walked with the cloth to the left: the outline
// counter-clockwise, holes and darts inside clockwise.
#include <optional>
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/design/edge_part.hpp"

namespace garment::modeller {

using design::Point2;

/// Part of an edge, or a leg of a dart. Positions t on it run from 0 to length().
struct Piece {
  geometry::Curve curve;       ///< the whole edge as drawn, or the leg
  int edge = -1;               ///< index into Panel::edges, hole_edges or lines; -1 on a leg and on a line that nobody drew
  design::EdgePart::On on = design::EdgePart::On::outline;  ///< whose edge
  int dart = -1;               ///< index into Panel::darts; -1 elsewhere
  int inside_dart = -1;        ///< index into Panel::inside_darts; -1 elsewhere
  bool towards_apex = false;   ///< of a leg of a dart on an edge
  double from = 0, to = 0;     ///< arc lengths on `curve`; from > to where the loop walks the edge backwards
  std::vector<double> breaks;  ///< positions t where a particle must be, ascending; both ends included

  double length() const { return from < to ? to - from : from - to; }
  double arc(double t) const { return from < to ? from + t : from - t; }
  double position(double arc_length) const { return from < to ? arc_length - from : from - arc_length; }
  Point2 at(double t) const { return curve.point_at(arc(t)); }
  bool straight() const { return std::holds_alternative<geometry::Line>(curve.shape()); }
  /// Signed area between the piece from t0 to t1 and its chord, positive where the curve bulges out of the
  /// panel, m^2.
  double bulge(double t0, double t1) const;
};

/// A line inside a panel that the mesh follows: cloth on both sides, particles along it. Of a line that leaves the cloth - over
/// a dart, a hole, a corner - each part inside is one.
struct InnerLine {
  geometry::Curve curve;
  double from = 0, to = -1;  ///< arc lengths of the part; the whole curve where to < from
  int line = -1;   ///< index into Panel::lines; -1: nobody drew it
  int pleat = -1;  ///< index into laid_pleats(panel) of the pleat that it belongs to; -1: to none
  double at = 0;   ///< arc length on the pleat's edge where it begins, m
};

/// One place of two pieces: where a line meets the border or another line. Both positions are breaks.
struct Joint {
  std::size_t piece[2] = {0, 0};
  double t[2] = {0, 0};
};

struct Outline {
  std::vector<Piece> pieces;           ///< loop by loop, the outline first; then the inner lines, one piece each
  std::vector<std::size_t> loops{0};   ///< where each loop begins in `pieces`
  std::size_t n_closed = 1;            ///< loops from here on are inner lines
  std::vector<InnerLine> lines;        ///< the inner lines: of loop n_closed + k
  std::vector<Joint> joints;
  double area = 0;  ///< exact: edges by Green's theorem, darts and holes cut away, m^2
  /// On a panel symmetric about its fold: pieces [0, n_half) are the half of larger x from its lower fold
  /// point up, and piece k mirrors piece n - 1 - k. Zero on all other panels, and with holes or inner lines.
  std::size_t n_half = 0;

  /// Of loop `l`: its first piece, and the one after its last.
  std::size_t begin_of(std::size_t l) const { return loops[l]; }
  std::size_t end_of(std::size_t l) const { return l + 1 < loops.size() ? loops[l + 1] : pieces.size(); }
  /// The loop of piece `k`.
  std::size_t loop_of(std::size_t k) const;
};

/// The point where piece `k` starts (where the one before it in its loop ends).
Point2 corner(const Outline& outline, std::size_t k);

/// Cuts the darts and holes, orders the loops and adds the lines. `h` is the grid spacing, which sets how finely crossings
/// are looked for. Nothing, with findings at the panel, edge or dart, where the loop is open, crosses itself, has no
/// area, or a dart does not fit.
std::optional<Outline> cut_outline(const design::Panel& panel, double h, const std::vector<InnerLine>& lines,
                                   Findings& findings);

/// The break at `t` of a piece: one within `tolerance`, or a new one, m.
double break_at(Piece& piece, double t, double tolerance);

}  // namespace garment::modeller
