#pragma once
// Friction inside the cloth (hysteresis): sliders beside the elastic laws (docs/physics.md, section 2).
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "runtime/base/archive.hpp"
#include "runtime/simulator/elastic.hpp"
#include "runtime/simulator/slider.hpp"

namespace garment::simulator {

/// Sliders (slider.hpp) on the strains s of the cloth, each frozen between two calls of `slip`, so that the potential
///     E = sum of w (U(s) - L(s))
/// has a gradient; L is what the elastic law is lowered by, that the cloth loaded for the first time follows its record:
///   springs, cut cells  s the strain; yield f N(s), L = f Psi(s)
///   trellis corners     s = phi; yield HG + m (|phi| - 0.5 deg), L = m phi^2 / 2
///   bends               s = d . n theta / |d|, d the kink, n the cloth's normal: the turn with a sign; yield HB
///   fits                s = n . (K way); yield HB
/// n is the normal of the fan of triangles round the particle, and E's gradient has its part: none of it changes in rigid
/// motions, so forces and torques sum to zero. Fits that are folded at rest have no sliders.
///
/// Works on one thread, in the order of the Model. Sizes are those of the Model, which may go.
class InnerFriction {
 public:
  using Vectors = std::vector<Eigen::Vector3d>;
  static constexpr int kRevisions = 2;  ///< of the matrix, by `foresee`, in one step

  InnerFriction(const model::Model& model, const ElasticModel& elastic);

  /// Nothing slides: the Model has no friction, or `set_active` took them away.
  bool idle() const { return idle_; }
  /// Takes the sliders away, or lets them act again as they were.
  void set_active(bool active) { idle_ = !active || !present_; }

  /// Potential at x, J.
  double energy(const Vectors& x) const;
  /// Adds the forces at x, N; returns the potential.
  double add_force(const Vectors& x, Vectors& force) const;
  /// The same, and the curvature without that of the normals, to a matrix that `elastic.energy_force_hessian` has just filled.
  double add_force_hessian(const Vectors& x, Vectors& force, BlockMatrix& hessian) const;
  /// Corrects the matrix that was filled at x for a step dx that it gave: where a slider would begin to slip or to hold on the way,
  /// its slope becomes the secant. Solved again, the step no longer goes to and fro between the two.
  void foresee(const Vectors& x, const Vectors& dx, BlockMatrix& hessian);
  /// Lets what slipped at x stay there; returns the heat, J. Forces at x do not change.
  double slip(const Vectors& x);

  /// The anchors, in the order springs, cells, membranes, bends, fits; `take_anchors` refuses a list of another length.
  std::vector<double> anchors() const;
  bool take_anchors(const std::vector<double>& anchors);
  void keep(Archive& a);  ///< in a checkpoint

 private:
  enum List : std::size_t { kSprings, kCells, kMembranes, kBends, kFits };
  enum Wanted : int { kEnergy, kForce, kHessian, kSlip, kStrains, kForesee };
  template <int kWanted>
  class Pass;

  struct Spring {
    model::Indices<2> particle;
    model::Index law;
    double rest, width;
    std::int32_t place;
  };
  struct Cell {
    model::Indices<4> particle;
    double area, stiffness;  // a quarter of the cell; of the slider, N/m
    ShearYield yield;
    std::array<std::int32_t, 6> place;
  };
  struct Membrane {
    model::Indices<3> particle;
    model::Indices<2> law;
    std::array<double, 6> weight;
    double area, stiffness;
    ShearYield yield;
    std::array<std::int32_t, 3> place;
  };
  struct Bend {
    model::Indices<3> particle;
    double stiffness, yield;  // by the turn, N m
    model::Index crease;      // into the elastic creases, or -1
    std::array<std::int32_t, 3> place;
  };
  struct Fit {
    std::size_t begin, end;   // into fit_particle_
    std::size_t place;        // into fit_place_, of its first pair
    model::Index particle;
    double stiffness, yield;  // by curvature, N m^3 and N m^2
  };
  struct Law {
    double share, stiffness;  // f; of the slider per width, N/m
  };
  void add_springs(const model::Model& model);
  void add_cells(const model::Model& model);
  void add_membranes(const model::Model& model);
  void add_bends(const model::Model& model);
  void add_fits(const model::Model& model);
  void add_fans(const model::Model& model);
  void reset();
  std::int32_t place(model::Index a, model::Index b) const;

  const ElasticStencils& stencils_;
  bool present_ = false, idle_ = true;
  std::vector<Law> laws_;
  std::vector<Spring> springs_;
  std::vector<Cell> cells_;
  std::vector<Membrane> membranes_;
  std::vector<Bend> bends_;
  std::vector<Fit> fits_;
  std::vector<model::Index> fit_particle_;
  std::vector<double> fit_weight_;
  std::vector<std::int32_t> fit_place_;
  std::vector<model::Index> normal_of_;              // particles that need a normal
  std::vector<std::int32_t> normal_slot_;            // of each particle, -1: none
  std::vector<std::size_t> fan_begin_;               // CSR over normal_of_
  std::vector<model::Indices<2>> fan_;               // the other two corners of each triangle round it
  // Of springs, cells, membranes, bends, fits: 1, 4, 3, 1, 1 of each.
  std::array<std::vector<Slider>, 5> sliders_;
  std::array<std::vector<double>, 5> ahead_;          // strains that a step would come to
  mutable std::array<std::vector<double>, 5> slopes_;  // as they stand in the matrix that was filled last
};

}  // namespace garment::simulator
