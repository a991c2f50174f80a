#pragma once
// The cloth's own damper: beside every elastic stiffness k a dashpot tau k (docs/physics.md, section 3.7).
#include <Eigen/Core>
#include <vector>

#include "runtime/simulator/elastic.hpp"

namespace garment::simulator {

/// Dashpots on the strains s of the elastic stencils: stretch of springs and of threads in cut cells, trellis angles, the
/// length of the twist vector, of the kink of bends, of the curvature vectors of fits. Over a step of h seconds each has the
/// potential
///     D = tau k (s - s0)^2 / (2 h),      force -tau k (s - s0) / h grad s,
/// (lengths rounded off near zero), s0 and k = d2E/ds2 being those of the step's begin. The strains do not change when the cloth moves as a rigid body, so
/// that forces and torques sum to zero and nothing brakes a free fall. The heat of a step is 2 D. Ties have no dashpots.
///
/// All functions give the same bits for any number of threads.
class KelvinDamping {
 public:
  /// Keeps a reference to `elastic`. tau of a stencil: the mean over its particles (model.damping).
  KelvinDamping(const model::Model& model, const ElasticModel& elastic);

  /// No cloth is damped.
  bool idle() const { return idle_; }
  double largest_time() const { return largest_; }  ///< tau, s
  /// Remembers strains and stiffness at x.
  void begin(const std::vector<Eigen::Vector3d>& x);
  /// D at x, J.
  double potential(const std::vector<Eigen::Vector3d>& x, double h) const;
  /// Adds the forces at x, N; returns D.
  double add_force(const std::vector<Eigen::Vector3d>& x, double h, std::vector<Eigen::Vector3d>& force) const;
  /// The same, and the curvature tau k / h grad s grad sT to a matrix that
  /// `elastic.energy_force_hessian` has just filled.
  double add_force_hessian(const std::vector<Eigen::Vector3d>& x, double h, std::vector<Eigen::Vector3d>& force,
                           BlockMatrix& hessian) const;

 private:
  struct Dashpot {
    double s = 0, eta = 0;  // strain when the step began, tau k
  };
  template <class Work>
  double run(const Work& pass) const;
  enum Wanted : int { kBegin, kPotential, kForce, kHessian };
  template <int kWanted>
  class Pass;

  const ElasticStencils& stencils_;
  bool idle_ = true;
  double largest_ = 0;
  std::vector<double> tau_;  // s [n_particles]
  std::vector<std::size_t> fit_places_;  // of each fit's first pair
  std::vector<std::int32_t> pair_places_;  // BlockPlace codes of all pairs of a fit's particles
  std::vector<Dashpot> springs_, cells_, membranes_, bends_, fits_;  // 1, 5, 3, 1, 3 of each stencil
};

}  // namespace garment::simulator
