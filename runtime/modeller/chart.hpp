#pragma once
// Developing the neighbourhood of a particle into a plane, and the curvature stencil found there.
#include <map>
#include <optional>

#include "runtime/modeller/sheet.hpp"

namespace garment::modeller {

/// The plane round one particle, which lies at the origin: the triangles of its fan by polar unfolding (rest
/// lengths, angles scaled to add up to 2 pi), the triangles beyond them unfolded rigidly over the ring's
/// sides, in `layers` rounds.
struct Chart {
  struct Point {
    model::Index particle;
    Eigen::Vector2d at;
  };
  std::vector<Point> points;  ///< without the centre; ring first
  std::vector<FanTriangle> fan;
  std::vector<std::array<Eigen::Vector2d, 2>>
      fan_at;  ///< of fan triangle k: places of its `here` and `ahead` corners
};

/// Nothing where the fan is no plain disc, or its angles add up to less than half or more than twice a full
/// turn.
std::optional<Chart> develop(const Sheet& sheet, const model::Model& model, model::Index centre, int layers);

/// Curvature from a quadratic fitted by weighted least squares: kappa_ab = sum_j weight_j x_j over
/// `particle`, whose last entry is the centre with the weight that makes the sum zero. Axes are those of the
/// chart.
struct CurvatureFit {
  std::vector<model::Index> particle;
  std::vector<Eigen::Vector3d> weight;  ///< (11, 22, 12), 1/m^2
  /// On demand: what no quadratic describes, as groups of three weights like `weight`, 1/m^2, parallel to `particle`: zero on every
  /// quadratic, together the weighted residual of the fit. A seam that is folded sharply, or goes to and fro from particle
  /// to particle, has little curvature in the mean, and all of it here.
  std::vector<std::vector<Eigen::Vector3d>> residual;
  bool complete = false;  ///< exact on every quadratic; else the least solution of a small neighbourhood
};
CurvatureFit fit_curvature(const Chart& chart, model::Index centre, bool with_residual);

}  // namespace garment::modeller
