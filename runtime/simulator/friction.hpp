#pragma once
// Coulomb friction between particles and bodies, quasi-static: every touching particle is tied to an anchor by a
// spring that slips when it carries more than mu N (return mapping; docs/physics.md, section 3.3: a velocity
// regularisation would creep).
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "runtime/base/archive.hpp"
#include "runtime/simulator/block_matrix.hpp"
#include "runtime/simulator/holds.hpp"

namespace garment::simulator {

inline constexpr double kLeastAnchorStiffness = 1e-3;  ///< N/m
inline constexpr double kSlipShare = 0.01;  ///< of the stiffness that is left along the slip, so that the matrix stays definite

class BodyFriction {
 public:
  /// A contact gives way by `give` (m) before it slips, so that its spring is as stiff as its load asks for, and no more: with
  /// one high stiffness for all, sliding particles creep and a drape takes four times as many steps. `most_stiffness`: of
  /// one particle's anchor, N/m.
  BodyFriction(std::size_t n_particles, double give, double most_stiffness)
      : give_(give), most_stiffness_(most_stiffness), touch_(n_particles) {}

  /// Begins a step: forgets the normal forces; `add_normal_force` collects them anew.
  void begin_step();
  /// Particle i is pressed by `force` (N, along the outward normal of the body) with friction coefficient mu.
  void add_normal_force(std::size_t i, const Eigen::Vector3d& force, double mu);
  /// Fixes normals and slip limits for the coming step; particles that touch for the first time anchor at x.
  void freeze(const std::vector<Eigen::Vector3d>& x);

  double energy(const std::vector<Eigen::Vector3d>& x) const;
  /// Adds the friction force at x, and the stiffness to the matrix when one is given.
  void add_force(const std::vector<Eigen::Vector3d>& x, std::vector<Eigen::Vector3d>& force, BlockMatrix* matrix) const;
  /// Takes from `force` (all forces but those of bodies) what touching bodies can bear: the part that presses on the body,
  /// and of the tangential part up to mu N. What is left is what moves the cloth, whatever path it came by.
  /// Both act along what `holds` leave free: `force` must be filtered by them, and comes out filtered.
  void absorb(std::vector<Eigen::Vector3d>& force, const Holds& holds) const;
  /// Lets the anchors of slipping particles follow (after an accepted step). Returns the heat of the slip, J.
  double follow(const std::vector<Eigen::Vector3d>& x);
  /// Friction on particle i at x, N.
  Eigen::Vector3d force_on(std::size_t i, const Eigen::Vector3d& x) const {
    const Touch& t = touch_[i];
    if (!t.anchored) return Eigen::Vector3d::Zero();
    const Eigen::Vector3d u = slip(t, x);
    const double size = u.norm();
    return -(t.stiffness * size <= t.limit ? t.stiffness : t.limit / size) * u;
  }
  /// Moves the anchor of particle i, if it has one: the body that it rubs on has moved.
  template <class Move>
  void carry(std::size_t i, const Move& move) {
    if (touch_[i].anchored) touch_[i].anchor = move(touch_[i].anchor);
  }
  /// Particle i has what particle `at` of another garment has.
  void copy(std::size_t i, const BodyFriction& other, std::size_t at) { touch_[i] = other.touch_[at]; }
  /// Forgets all anchors.
  void clear();
  const std::vector<std::uint32_t>& touching() const { return active_; }
  void keep(Archive& a);  ///< in a checkpoint

 private:
  struct Touch {
    Eigen::Vector3d anchor{0, 0, 0}, sum{0, 0, 0}, normal{0, 0, 0};
    std::array<Eigen::Vector3d, 8> pressing;  // directions of the normal forces, the first n_pressing
    int n_pressing = 0;
    double weighted_mu = 0, total = 0, bearable = 0, limit = 0, stiffness = 0;  // bearable = mu N
    bool anchored = false;
  };
  Eigen::Vector3d left_by(const Touch& t, Eigen::Vector3d f, std::size_t i, const Holds& holds) const;
  Eigen::Vector3d slip(const Touch& t, const Eigen::Vector3d& x) const {
    Eigen::Vector3d u = x - t.anchor;
    return u - u.dot(t.normal) * t.normal;
  }
  double give_, most_stiffness_;
  std::vector<Touch> touch_;
  std::vector<std::uint32_t> active_;
};

}  // namespace garment::simulator
