#pragma once
// Bilateral constraints C(r, t) = 0 of a Model as rows, and the reactive forces that keep them (Barzel & Barr 1988; docs/physics.md,
// section 3.8).
#include <Eigen/Core>
#include <vector>

#include "runtime/simulator/moving_cloth.hpp"

namespace garment::simulator {

/// One row: C, its gradients J_i by the particles it speaks of, and what else its second derivative in time has.
struct ConstraintRow {
  int n = 0;                                  ///< particles
  Indices<6> particle{};
  std::array<Eigen::Vector3d, 6> gradient{};  ///< J
  double value = 0;                           ///< C, m
  double drift = 0;                           ///< C_t, m/s: by what moves it
  double bend = 0;                            ///< Jdot v, m/s^2
  double give = 0;                            ///< of a thread by its force, m/N: C is its length less that
  int hold = -1;                              ///< index into holds, or -1
  bool pulls_only = false;                    ///< a thread: its force may only shorten it
};

struct Reactive {
  std::vector<Eigen::Vector3d> force;         ///< F_r = JT lambda, N [n_particles]
  std::vector<Eigen::Vector3d> of_holds;      ///< the holds' part of it
  std::size_t redundant = 0;                  ///< rows that say what others say already
};

/// Rows of the holds (three of a point, one of a plane), the rods and the threads that are taut, at x and v.
std::vector<ConstraintRow> constraint_rows(const model::Model& model, const MovingCloth& cloth, const std::vector<Eigen::Vector3d>& x,
                                           const std::vector<Eigen::Vector3d>& v, double h);

/// Solves  (J W JT) lambda = -(J W F + Jdot v + (2/tau)(J v + C_t) + C/tau^2)  for the forces F that act, W the inverse masses.
/// Rows that repeat others are kept from dividing by nothing by 1e-9 of their diagonal, and counted. Threads whose force would
/// push are dropped and the rest is solved again.
Reactive reactive_forces(const model::Model& model, const std::vector<ConstraintRow>& rows, const std::vector<Eigen::Vector3d>& active,
                         const std::vector<Eigen::Vector3d>& v, double tau);

}  // namespace garment::simulator
