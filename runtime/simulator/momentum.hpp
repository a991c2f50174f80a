#pragma once
// Acceleration of a descent in steps whose matrix is too stiff for the way ahead: Nesterov's momentum, begun anew wherever the
// energy rose or the force has turned against the way (O'Donoghue and Candes, "Adaptive restart for accelerated gradient
// schemes", Found. Comput. Math. 15, 2015).
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "runtime/base/archive.hpp"

namespace garment::simulator {

/// The matrix of a step leaves out what folds lose in stiffness under compression. Along a fold that travels it can be fifty
/// times too stiff, and one step after another then goes a fiftieth of the way in the same direction. Going on along the last
/// step before the next one is taken, ever farther while it pays, cuts their number to its root.
class Momentum {
 public:
  using Vectors = std::vector<Eigen::Vector3d>;

  /// Which share of the last way to go on by before the next step; 0 where nothing is known of it.
  double share() {
    if (way_.empty()) return 0;
    const double next = 0.5 * (1 + std::sqrt(1 + 4 * pace_ * pace_));
    const double share = std::min(kMostShare, (pace_ - 1) / next);
    pace_ = next;
    return share;
  }
  /// From the end of the step before the last to the end of the last, m [n], or empty.
  const Vectors& way() const { return way_; }
  /// Is this energy above that at the end of the last step?
  bool rose(double energy) const { return energy > energy_ + kRounding * std::abs(energy); }

  /// After a step to x, at this energy; `before` is where the last one had ended, `force` acted where this one began.
  void went(const Vectors& before, const Vectors& x, const Vectors& force, double energy) {
    way_.resize(x.size());
    double along = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      way_[i] = x[i] - before[i];
      along += force[i].dot(way_[i]);
    }
    if (along < 0) pace_ = 1;
    energy_ = energy;
  }

  void forget() {
    way_.clear();
    pace_ = 1;
  }

  /// In a checkpoint, between two steps.
  void keep(Archive& a, std::size_t n);

 private:
  static constexpr double kMostShare = 0.95;
  static constexpr double kRounding = 1e-9;

  Vectors way_;
  double pace_ = 1, energy_ = 0;  // J
};

}  // namespace garment::simulator
