#pragma once
// Explicit steps in time: symplectic Euler.
#include "runtime/simulator/stepper.hpp"

namespace garment::simulator {

/// v' = v + h M^-1 f(x, v), x' = x + h v'. Stable for h <= (2 / omega) (sqrt(1 + z^2) - z), z = omega tau / 2, omega the largest
/// frequency of cloth and contacts and tau the largest time of its dampers.
class ExplicitSteps {
 public:
  explicit ExplicitSteps(MovingCloth& cloth) : cloth_(cloth) {}

  /// The bound at x, s; by power iteration on M^-1 K, with 5 % to spare in omega^2.
  double stable_step(const std::vector<Eigen::Vector3d>& x);
  /// Not done where cloth would pass cloth or a body: the step is then to be made in parts.
  TimeStep step(MotionState& state, double h);

 private:
  MovingCloth& cloth_;
  std::vector<Eigen::Vector3d> v_, dx_;
  std::vector<Eigen::Vector3f> p_, q_;
};

/// (2 / omega) (sqrt(1 + z^2) - z), z = omega tau / 2; omega in rad/s, tau in s.
double stability_bound(double omega, double tau);

}  // namespace garment::simulator
