#pragma once
// What pushes on the cloth beside its weight, bodies and contacts: constant forces, pressure, air (docs/physics.md, section 3.6).
#include <Eigen/Core>
#include <vector>

#include "runtime/model/model.hpp"
#include "runtime/simulator/block_matrix.hpp"

namespace garment::simulator {

inline constexpr double kAirDensity = 1.204;    ///< kg/m^3, at 20 degrees and 101.3 kPa
inline constexpr double kSkinShare = 0.01;      ///< of the drag coefficient, that acts along a sheet (both sides, laminar, Re 5e4)

/// Wind at `time`, m/s: gusts come and go every three seconds, wind (1 + gust (1 - cos(2 pi t / 3 s)) / 2).
Eigen::Vector3d wind_at(const model::Air& air, double time);

/// Force of the air on a triangle with area vector `a` (its normal times its area) past which air flows with the velocity u:
/// F = rho/2 |u| [(C - C') (u . n) a + C' A u], C = drag, C' = kSkinShare C. Square to the flow a drag of C; at the angle
/// alpha to it a lift C sin(alpha) cos(alpha) and a drag C sin^2(alpha), the normal force of a plate growing with sin(alpha).
Eigen::Vector3d air_force(const Eigen::Vector3d& a, const Eigen::Vector3d& u, double drag);

/// The loads of a Model. Pressure and air follow the cloth; they have no potential. A solver that seeks the minimum of an
/// energy takes them as constant through a step: force and energy are those of the last `follow`.
class Loads {
 public:
  explicit Loads(const model::Model& model);

  /// Nothing to add, ever.
  bool empty() const { return empty_; }
  /// Forces on cloth that lies at x and moves with `velocity` (m/s; null: it rests), at `time` (s).
  void follow(const std::vector<Eigen::Vector3d>& x, const std::vector<Eigen::Vector3d>* velocity = nullptr, double time = 0);
  void add(std::vector<Eigen::Vector3d>& force, double scale = 1) const;
  /// Adds to the elastic part of a matrix a bound on how the forces of pressure and air change with the cloth: |F| / sqrt(A)
  /// between the corners of a triangle that bears F. Without it cloth that hangs loose would flutter from step to step.
  void add_stiffness(BlockMatrix& matrix, double scale = 1);
  /// Potential of the forces of the last `follow`, taken as constant, J.
  double energy(const std::vector<Eigen::Vector3d>& x, double scale = 1) const;
  /// Upper bound of how the air's force on each particle falls with its velocity, N s/m [n_particles]; empty in still air.
  const std::vector<double>& air_damping() const { return air_damping_; }
  /// N [n_particles]; empty where there are none.
  const std::vector<Eigen::Vector3d>& force() const { return force_; }

 private:
  const model::Model& model_;
  bool empty_;
  std::vector<Eigen::Vector3d> force_;
  std::vector<double> air_damping_;
  std::vector<double> triangle_stiffness_;               // N/m [n_triangles]; of those that bear something
  std::vector<model::Indices<3>> triangle_blocks_;       // upper blocks 01 12 20 of each triangle, -1: none
};

}  // namespace garment::simulator
