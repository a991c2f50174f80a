#pragma once
// The source system's method (Rizzi, Fontana, Cugini 2004): dynamic constraints and impulses, `solver dynamic_constraints`
// (docs/physics.md, section 3.8).
#include "runtime/simulator/bilateral.hpp"
#include "runtime/simulator/stepper.hpp"
#include "runtime/simulator/unilateral.hpp"

namespace garment::simulator {

/// Explicit steps in which holds, rods and taut threads are kept by reactive forces, contacts by impulses. What is off its
/// constraint comes back within tau = 5 h.
class ConstraintSteps {
 public:
  /// `cloth` must have been made with MovingCloth::Acts::without_constraints, of `model`.
  ConstraintSteps(MovingCloth& cloth, const model::Model& model) : cloth_(cloth), start_(model) {}

  TimeStep step(MotionState& state, double h);
  std::size_t redundant() const { return reactive_.redundant; }  ///< rows of the last step that repeat others

 private:
  void find_active_forces(const MotionState& s, double h, TimeStep& report);
  void find_reactive_forces(const MotionState& s, double h);
  void find_velocities(const MotionState& s, double h);
  void find_collisions(const MotionState& s, double h);
  void resolve_collisions(double h, TimeStep& report);
  bool move(MotionState& s, double h, TimeStep& report);

  MovingCloth& cloth_;
  const model::Model& start_;
  Reactive reactive_;
  std::vector<Touching> touching_;
  std::vector<Eigen::Vector3d> v_, dx_;
};

}  // namespace garment::simulator
