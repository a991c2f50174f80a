#pragma once
// Elastic energy of the cloth, its forces and the matrix for the implicit solver (docs/physics.md, section
// 2). The stencils and their energies are defined in runtime/model/model.hpp; the kernels stand in
// elastic_kernels.hpp.
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "runtime/model/model.hpp"
#include "runtime/simulator/block_matrix.hpp"

namespace garment::simulator {

struct ElasticStencils;

/// The elastic part of a Model, rearranged for the hot loop. It copies what it needs, so the Model may go.
/// Gravity, masses, holds and contacts are the solver's business, not in here.
///
/// All functions are const, may run at the same time, and give the same bits for any number of threads:
/// stencils are grouped into fixed chunks of neighbouring particles, chunks that share particles never run at
/// the same time, and every particle receives its terms in one fixed order.
///
/// Failure: positions that are not finite give a result that is not finite; a collapsed stencil (an edge of
/// length zero) gives a finite force. A Model that breaks its own rules (ids out of range) is undefined:
/// validate it first.
class ElasticModel {
 public:
  explicit ElasticModel(const model::Model& model);
  ~ElasticModel();
  ElasticModel(ElasticModel&&) noexcept;
  ElasticModel& operator=(ElasticModel&&) noexcept;

  std::size_t n_particles() const;

  /// Factor on the tensile laws of springs and cut cells and on ties (> 0, 1 at first), for stiffness continuation.
  /// Shear, bending and twist keep theirs. Not to be called while another function runs.
  void set_tensile_scale(double scale);
  double tensile_scale() const;

  /// Elastic energy in J at positions x, m [n_particles].
  double energy(const std::vector<Eigen::Vector3d>& x) const;

  /// The same, and force = -gradient in N [n_particles]; overwrites and resizes `force`.
  double energy_and_force(const std::vector<Eigen::Vector3d>& x, std::vector<Eigen::Vector3d>& force) const;

  /// The same, and a positive semidefinite approximation of the energy's Hessian in N/m; overwrites the
  /// elastic part of `hessian` and clears what was added on its diagonal. `hessian` must come from
  /// make_matrix().
  ///   springs, cut cells, ties   N' n nT + max(N, 0) / l (I - n nT): exact in tension, no transversal part in compression
  ///   shear                      Gauss-Newton, G grad(phi) grad(phi)T
  ///   bends                      Gauss-Newton on the difference of the edge directions, isotropic
  ///   twist, fits                exact (quadratic energies; of folded fits without the part that comes of their turning)
  double energy_force_hessian(const std::vector<Eigen::Vector3d>& x, std::vector<Eigen::Vector3d>& force,
                              BlockMatrix& hessian) const;

  /// Turns creases and what is twisted at rest with the cloth at x, m [n_particles]; energies and forces then hold them until the next
  /// call. Not to be called while another function runs.
  void follow(const std::vector<Eigen::Vector3d>& x);

  /// A zero matrix with this model's pattern.
  BlockMatrix make_matrix() const;
  /// The stencils in the order of the hot loop, for what works on the same ones (KelvinDamping).
  const ElasticStencils& stencils() const { return *stencils_; }

 private:
  std::unique_ptr<ElasticStencils> stencils_;
};

}  // namespace garment::simulator
