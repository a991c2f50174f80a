#pragma once
// The outline of a panel after its darts are cut: one closed loop of pieces, walked counter-clockwise.
#include <optional>
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/design/panel.hpp"

namespace garment::modeller {

using design::Point2;

/// Part of an edge, or a leg of a dart, walked counter-clockwise round the panel. Positions t on it run from
/// 0 to length().
struct Piece {
  geometry::Curve curve;       ///< the whole edge as drawn, or the leg
  int edge = -1;               ///< index into Panel::edges; -1 on a leg
  int dart = -1;               ///< index into Panel::darts; -1 on an edge
  bool towards_apex = false;   ///< of a leg
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

struct Outline {
  std::vector<Piece> pieces;
  double area = 0;  ///< exact: edges by Green's theorem, darts cut away, m^2
  /// On a panel symmetric about its fold: pieces [0, n_half) are the half of larger x from its lower fold
  /// point up, and piece k mirrors piece n - 1 - k. Zero on all other panels.
  std::size_t n_half = 0;
};

/// The point where the loop starts piece `k` (the end of piece k - 1).
Point2 corner(const Outline& outline, std::size_t k);

/// Cuts the darts and orders the loop. `h` is the grid spacing, which sets how finely crossings are looked
/// for. Nothing, with findings at the panel, edge or dart, where the loop is open, crosses itself, has no
/// area, or a dart does not fit.
std::optional<Outline> cut_outline(const design::Panel& panel, double h, Findings& findings);

}  // namespace garment::modeller
