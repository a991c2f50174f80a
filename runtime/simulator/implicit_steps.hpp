#pragma once
// Implicit steps in time: BDF2, and implicit Euler where there is no step before to go on from.
#include "runtime/simulator/stepper.hpp"

namespace garment::simulator {

/// One step of h seconds by Newton's method on the potential
///     |x - x^|^2_M / (2 beta^2) + E(x) + D(x),   M (x - x^) / beta^2 = f
///     implicit Euler   beta = h,      x^ = x_n + h v_n
///     BDF2             beta = 2h/3,   x^ = (4 x_n - x_(n-1)) / 3 + 2h (4 v_n - v_(n-1)) / 9
/// It begins at x_n + h v_n + h^2 g, so that a free fall needs no iteration. Every
/// iteration is cut back by walls between near parts and goes on until none is and the residual is small, so no momentum is
/// lost to them. A step in which something comes to touch is made by implicit Euler: BDF2 would throw it back.
class ImplicitSteps {
 public:
  enum class Effort {
    converged,  ///< Newton's method to the tolerance
    one_solve,  ///< implicit Euler linearised once (semi-implicit, Baraff & Witkin 1998); again only where walls cut the step
  };
  /// `tolerance`: of the residual, RMS over RMS weight.
  ImplicitSteps(MovingCloth& cloth, double tolerance, Effort effort) : cloth_(cloth), tolerance_(tolerance), effort_(effort) {}

  TimeStep step(MotionState& state, double h);
  void keep(Archive& a);  ///< in a checkpoint

 private:
  enum class Scheme { euler, bdf2 };
  void set_scheme(const MotionState& s, double h, Scheme scheme);
  bool solve(const MotionState& s, double h, TimeStep& report);
  void guess(const MotionState& s, double h);
  double inertia(const std::vector<Eigen::Vector3d>& x) const;
  const std::vector<Eigen::Vector3d>& velocity(const MotionState& s, const std::vector<Eigen::Vector3d>& x, double h);
  double search(double before, double h);
  void look(const MotionState& s, double h, bool with_matrix, TimeStep& report);
  bool is_single() const { return effort_ == Effort::one_solve; }
  void finish(MotionState& s, double h, TimeStep& report);

  MovingCloth& cloth_;
  double tolerance_;
  Effort effort_;
  bool flies_ = true;  // nothing but its weight moved it in the last step
  Scheme scheme_ = Scheme::euler;
  int euler_steps_ = 0;  // still to come
  double beta_ = 0;
  Energies energies_;
  std::vector<Eigen::Vector3d> x_, aim_, v_, residual_, dx_, trial_;
};

}  // namespace garment::simulator
