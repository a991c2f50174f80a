#pragma once
// How pleats and tucks lie: what of the cloth lies under what, where it is folded, and the folded piece from which a drape
// starts.
#include <vector>

#include "runtime/design/garment.hpp"
#include "runtime/modeller/outline.hpp"

namespace garment::modeller {

/// One pleat or tuck. Its stretch of the edge, `from` to `to`, closes to one point; everything is told in arc lengths of the
/// edge as drawn, which the lines inside the panel carry on square to the edge's middle.
struct LaidPleat {
  /// Cloth between two folds, as it lies when folded: at arc length s of the flat edge it is at `shift` + s, or where it is
  /// turned over at `shift` - s. Layer 0 is the cloth beside the pleat; 1 and 2 lie under it (of folds at the face, on it).
  struct Strip {
    double from, to;
    bool turned;
    double shift;
    int layer;
  };
  struct Fold {
    double at;
    int to;  ///< 1 to the back, -1 to the face
  };
  /// Three layers that the edge's seam holds together: the cloth beside the pleat, walked from `beside` for `depth` in the
  /// direction `way` (1 with the edge), and two layers of the pleat from their starts towards `fold`, where they meet.
  struct Layers {
    double beside;
    int way;
    double start[2], fold;
  };
  int pleat = -1;     ///< index into Panel::pleats
  int edge = -1;      ///< index into Panel::edges
  double from = 0, to = 0;
  double depth = 0;   ///< of the underlay, m
  Point2 origin{0, 0}, along{1, 0}, in{0, 1};  ///< middle of the stretch; unit vectors with the edge and into the cloth
  double middle = 0;  ///< arc length at `origin`
  double sewn = 0;    ///< where the stretch closes: arc length of the edge with all its pleats folded
  int ramp = 0;       ///< side of the stretch (1: beyond `to`, -1: before `from`) whose cloth comes up from under the pleat; 0 of
                      ///< box and inverted pleats, which have none
  int side = 1;       ///< 1: the folds lie at the back, -1: at the face
  bool opposite = false;  ///< the other end of a pleat on another edge that is listed before: what lies between folds once
  int under = -1;     ///< the pleat that this one reaches under, where they stand close: index into the list; -1: none
  std::vector<Strip> strips;
  std::vector<Fold> folds;
  std::vector<Layers> layers;

  double take() const { return to - from; }
};

/// Arc lengths of one place on an edge, whatever the last bits say.
inline bool same_place(double a, double b) { return a - b < 1e-9 && b - a < 1e-9; }

/// The pleats of a panel one by one, in the order in which they are stated; those on no edge of the panel are left out.
std::vector<LaidPleat> laid_pleats(const design::Panel& panel);

/// The lines of a panel's pleats that the mesh follows: where they are folded, and where they are stitched down.
std::vector<InnerLine> pleat_lines(const design::Panel& panel);

/// How strongly an ironed pleat keeps its folds: share of a half turn (docs/physics.md, pressing: 0.6 to 0.8 of wool).
inline constexpr double kPleatSet = 0.8;

/// Where a point of the flat panel lies when its pleats are folded: (x, y) in the panel's plane and the distance from it towards
/// the face, m. `gap` is the distance of neighbouring layers, m. What lies to both sides of a pleat moves together evenly.
Eigen::Vector3d fold_pleats(const std::vector<LaidPleat>& pleats, const Point2& flat, double gap);

}  // namespace garment::modeller
