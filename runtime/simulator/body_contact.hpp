#pragma once
// Bodies push cloth out along the normals of their surface, particle by particle: a garment may start inside one.
#include <Eigen/Core>
#include <array>
#include <vector>

#include "runtime/base/archive.hpp"
#include "runtime/body/body.hpp"
#include "runtime/model/model.hpp"
#include "runtime/model/motion.hpp"
#include "runtime/simulator/block_matrix.hpp"
#include "runtime/simulator/friction.hpp"

namespace garment::simulator {

/// A plane that keeps a particle away from a body, as it stands at the beginning of a step.
struct Push {
  std::size_t particle;
  Eigen::Vector3d normal;  ///< unit, out of the body
  double plane;            ///< signed distance of x is normal . x - plane, m
  double offset;           ///< m, distance at which the push begins
  double friction;         ///< Coulomb: geometric mean of cloth and body
  bool foreseen = false;   ///< not pressed yet, but the step would press it
  int body = -1;

  double depth(const std::vector<Eigen::Vector3d>& x) const { return offset - (normal.dot(x[particle]) - plane); }
};

inline constexpr double kHardening = 20;  ///< of pushes 0.3 mm from a surface

/// How a body pushes a particle that is `depth` (m) nearer than `offset` (m), k in N/m; convex, the force is continuous.
///   first 0.1 mm           softly, so that cloth which only lies on the body does not rattle between touching and not touching
///   then                   with stiffness k
///   0.3 mm from the body   much stiffer, so that cloth drawn into a wedge (between thighs) stops before its end
///   deeper inside          with k again: who starts inside is led out, not shot out
struct PushLaw {
  double energy = 0, force = 0, stiffness = 0;  ///< J, N, N/m
  PushLaw(double depth, double offset, double k);
};

struct BodyContactSettings {
  double offset = 1.5e-3;  ///< m, distance of the cloth's surface at which a body begins to repel it
  double stiffness = 1e7;  ///< N/m per m^2 of cloth
};

/// All pushes on a garment.
class BodyContact {
 public:
  /// `spacing`: mean edge length of the cloth, m. Keeps references to model and bodies.
  BodyContact(const model::Model& model, const std::vector<body::Body>& bodies, double spacing,
              const BodyContactSettings& settings);

  /// Finds the pushes at x, sorted by particle, those of narrow places last.
  void find(const std::vector<Eigen::Vector3d>& x);

  /// Lets narrow places that are not found any more be forgotten after a while: once after every step made.
  void next_step();

  /// Of the pushes as planes, J.
  double energy(const std::vector<Eigen::Vector3d>& x) const;
  void add_forces(const std::vector<Eigen::Vector3d>& x, std::vector<Eigen::Vector3d>& force, BlockMatrix& matrix) const;
  void add_normal_forces(const std::vector<Eigen::Vector3d>& x, BodyFriction& friction) const;
  /// A particle just off a body feels nothing of it, and a linear system would send it inside: counts those that the step
  /// `dx` would press as touching, with their forces and stiffness. Returns how many are new.
  std::size_t foresee(const std::vector<Eigen::Vector3d>& x, const std::vector<Eigen::Vector3d>& dx, const Holds& holds,
                      std::vector<Eigen::Vector3d>& force, BlockMatrix& matrix);

  /// By how much more than the settings' offset bodies keep each particle away, m [n_particles].
  std::vector<double>& extra_offset() { return extra_offset_; }
  /// Particle i knows of the bodies what particle `at` of another garment by the same bodies knows.
  void copy(std::size_t i, const BodyContact& other, std::size_t at);
  double stiffness() const { return stiffness_; }  ///< of one particle, N/m
  double least_distance() const;                   ///< at which a body begins to push a particle, over all of them, m

  /// Moves the bodies [n_bodies]: from where they are given to where they are now. Anchors of `friction` on a body go with it.
  void place(const std::vector<model::Placement>& placements, BodyFriction& friction);
  /// Work that the bodies have done on pressed cloth at x by going from `before` to where they are, by the forces at x, J.
  double work_of_motion(const std::vector<model::Placement>& before, const std::vector<Eigen::Vector3d>& x,
                        const BodyFriction& friction) const;
  /// Those of the last `find`, of pressed particles and of particles near a body.
  const std::vector<Push>& pushes() const { return pushes_; }
  /// Which particles are pressed at x [n_particles].
  void pressed(const std::vector<Eigen::Vector3d>& x, std::vector<char>& out) const;
  /// Lower bound of the distance (m) from particle i at x to the surface of every body, as far as the last `find` knows.
  double room(std::size_t i, const Eigen::Vector3d& x) const;
  /// In a checkpoint: all but where the bodies are.
  void keep(Archive& a);

 private:
  struct Pushes {  // of one particle by one body
    std::array<Push, 3> push;
    int n = 0;
  };
  struct Sounding {  // the last distance query of a particle against one body
    Eigen::Vector3d at{0, 0, 0};
    double distance = 0;  // signed, m; at least the search radius where nothing was found
    bool known = false;
  };
  struct Memory {  // of the last narrow place that a particle was in
    Push push;
    Eigen::Vector3d at{0, 0, 0};  // where the particle was
    int age = -1;  // steps since; below zero: nothing to remember
  };
  void find_of(std::size_t body, const std::vector<Eigen::Vector3d>& x);
  void give_room(const std::vector<Eigen::Vector3d>& x, std::size_t begin, std::size_t end);
  void remember_narrow(const std::vector<Eigen::Vector3d>& x);

  const model::Model& model_;
  const std::vector<body::Body>& bodies_;
  double offset_, stiffness_;
  std::vector<double> extra_offset_;
  std::vector<double> padding_;  // of every particle, m
  std::vector<std::vector<double>> friction_;  // Coulomb [n_bodies][n_particles]
  std::vector<Push> pushes_, narrow_;
  std::vector<Pushes> found_;
  std::vector<Memory> memory_;                    // [n_particles]
  std::vector<std::vector<Sounding>> soundings_;  // [n_bodies][n_particles], in the body's own space
  std::vector<model::Placement> placements_;  // [n_bodies]; none: all stand where they are given
};

}  // namespace garment::simulator
