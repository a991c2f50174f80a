#pragma once
// What the integrators of a motion share: the state between two steps, and what a step reports.
#include <Eigen/Core>
#include <vector>

#include "runtime/simulator/moving_cloth.hpp"

namespace garment::simulator {

/// Cloth between two steps.
struct MotionState {
  std::vector<Eigen::Vector3d> x, v;        ///< m, m/s
  std::vector<Eigen::Vector3d> x_before, v_before;  ///< of the step before; empty: there is none to go on from
  double step_before = 0;                   ///< s, its length
  double time = 0;                          ///< s
};

/// One step of time.
struct TimeStep {
  bool done = false;       ///< else the state is as it was
  double residual = 0;     ///< RMS of what is left of the equations over RMS weight
  int iterations = 0;      ///< of Newton's method
  double stored = 0;       ///< J, after the step
  double work = 0;         ///< J, of loads, holds and bodies
  double damping = 0, friction = 0;  ///< J, turned to heat
  std::vector<Eigen::Vector3d> unborne;  ///< N, force less mass times acceleration: what holds must bear [n_particles]
};

/// Kinetic energy, J.
double kinetic_energy(const model::Model& model, const std::vector<Eigen::Vector3d>& v);

}  // namespace garment::simulator
