#pragma once
// All that acts on cloth in motion, at any position: elastic and damping forces, weight, loads, contacts, bodies, friction; with
// the matrix that an implicit step needs. The integrators (implicit_steps, explicit_steps) decide where it goes.
#include <Eigen/Core>
#include <vector>

#include "runtime/body/body.hpp"
#include "runtime/model/model.hpp"
#include "runtime/model/motion.hpp"
#include "runtime/simulator/body_contact.hpp"
#include "runtime/simulator/cloth_friction.hpp"
#include "runtime/simulator/contact.hpp"
#include "runtime/simulator/contact_mesh.hpp"
#include "runtime/simulator/elastic.hpp"
#include "runtime/simulator/friction.hpp"
#include "runtime/simulator/inner_friction.hpp"
#include "runtime/simulator/kelvin_damping.hpp"
#include "runtime/simulator/kept_candidates.hpp"
#include "runtime/simulator/linear_solver.hpp"
#include "runtime/simulator/loads.hpp"

namespace garment::simulator {

/// Energies of one position, J.
struct Energies {
  double stored = 0;       ///< elastic, weight, contacts with cloth and bodies, springs of friction and of sliders inside the cloth
  double dissipation = 0;  ///< potential D of the dashpots over the step; the heat is 2 D
  double dead_loads = 0;   ///< potential of the loads, taken as constant
  double sum() const { return stored + dissipation + dead_loads; }
};

class MovingCloth {
 public:
  enum class Acts {
    all,
    without_constraints,  ///< neither ties nor contacts nor friction: who steps sees to them
  };
  /// Keeps references to model and bodies, which are where they are at time 0.
  MovingCloth(const model::Model& model, const std::vector<body::Body>& bodies, bool self_collision, double time,
              Acts acts = Acts::all);
  /// A temporary list would be gone before the first step.
  MovingCloth(const model::Model& model, const std::vector<body::Body>&& bodies, bool self_collision, double time,
              Acts acts = Acts::all) = delete;

  const model::Model& model() const { return moved_; }
  const Holds& holds() const { return holds_; }
  std::size_t n() const { return moved_.n_particles(); }
  double rms_weight() const { return rms_weight_; }

  /// Moves holds and bodies to where they are at `time`, s.
  void go_to(double time);
  /// What a step from x takes as given: strains and stiffness of the dashpots (those of `strained`, where it is given), axes of
  /// folds, limits and anchors of friction.
  void begin_step(const std::vector<Eigen::Vector3d>& x, const std::vector<Eigen::Vector3d>* strained = nullptr);
  /// Forces at x of cloth with velocity v, all but what holds bear; with `with_matrix` also their derivatives, in the matrix
  /// that `solve` uses. `h`: the step's length, s.
  Energies assemble(const std::vector<Eigen::Vector3d>& x, const std::vector<Eigen::Vector3d>& v, double h, double time,
                    bool with_matrix);
  /// Energies at x by the planes, contact weights and loads of the last assemble.
  Energies energies(const std::vector<Eigen::Vector3d>& x, double h);
  const std::vector<Eigen::Vector3d>& force() const { return force_; }
  BlockMatrix& matrix() { return matrix_; }
  const Loads& loads() const { return loads_; }
  const KelvinDamping& damping() const { return damping_; }
  InnerFriction& inner_friction() { return inner_; }
  LinearResult solve(const std::vector<Eigen::Vector3d>& b, double tolerance, int iterations, const std::vector<Eigen::Vector3d>& x,
                     std::vector<Eigen::Vector3d>& dx) {
    LinearResult result = linear_.solve(matrix_, contact_stiffness_, b, tolerance, iterations, dx, &x);
    for (int k = 0; k < InnerFriction::kRevisions && !inner_.idle(); ++k) {
      inner_.foresee(x, dx, matrix_);
      result = linear_.solve(matrix_, contact_stiffness_, b, tolerance, iterations, dx, &x);
    }
    return result;
  }

  /// Cuts dx back so that x + t dx starts no intersection of cloth with cloth and no particle passes a body. Returns how many particles it changed.
  std::size_t keep_apart(const std::vector<Eigen::Vector3d>& x, std::vector<Eigen::Vector3d>& dx);
  /// The cloth is put back to where it was before: what lies near what is to be found again.
  void put_back() {
    candidates_.forget();
    looked_ = false;
  }
  /// How far each held particle goes in a step that begins at x: with its hold, and what it is off by at 1 m/s at most.
  void held_motion(const std::vector<Eigen::Vector3d>& x, double h, std::vector<Eigen::Vector3d>& dx) const;

  /// What was found by the last assemble: planes of bodies near particles, contacts of cloth with cloth.
  const std::vector<Push>& pushes() const { return bodies_.pushes(); }
  const std::vector<Contact>& contacts() const { return contacts_; }
  /// How far hold k has moved since the last accepted step, m.
  Eigen::Vector3d hold_motion(std::size_t k) const { return moved_.hold_point[k] - last_holds_[k]; }
  /// Velocity of a body at x, m/s, in a step of h seconds.
  Eigen::Vector3d body_velocity(const Push& push, const Eigen::Vector3d& x, double h) const;

  /// Share of the particles that touch now which did not after the last accepted step.
  double new_contacts(const std::vector<Eigen::Vector3d>& x);
  /// Lets what touches a body at x rub already in this step, which began at x0.
  void rub(const std::vector<Eigen::Vector3d>& x, const std::vector<Eigen::Vector3d>& x0);
  /// Lets slipped friction go; what the step from `before` to x cost, beside the dashpots.
  struct Accepted {
    double friction_heat = 0, work_of_bodies = 0;  ///< J
  };
  Accepted accept(const std::vector<Eigen::Vector3d>& x);

  /// Speed of the fastest part of a body near the cloth at x, between two times, m/s (0: none moves).
  double body_speed(const std::vector<Eigen::Vector3d>& x, double from, double to) const;
  /// Least distance at which bodies begin to push a particle, m.
  double push_distance() const { return bodies_.least_distance(); }
  /// Bound on the stiffness that contacts may add to one particle, N/m.
  double largest_contact_stiffness() const;
  /// In a checkpoint between two steps, at `time`, s.
  void keep(Archive& a, double time);

 private:
  void weigh_contacts(const std::vector<Eigen::Vector3d>& x);
  void look_around(const std::vector<Eigen::Vector3d>& x);
  double contact_energy_sum(const std::vector<Contact>& contacts) const;
  double weight_energy(const std::vector<Eigen::Vector3d>& x) const;

  const model::Model& start_;
  const std::vector<body::Body>& bodies_given_;
  bool constrained_;                         // by what acts here
  bool fine_bodies_ = true;                  // all facets are small: corners tell where a surface is
  model::Model moved_;                       // holds where they are now
  std::vector<Eigen::Vector3d> last_holds_;  // their points at the last accepted step
  ElasticModel elastic_;
  KelvinDamping damping_;
  InnerFriction inner_;
  Holds holds_;
  BlockMatrix matrix_;
  LinearSolver linear_;
  ContactMesh mesh_;
  KeptCandidates candidates_;
  BodyContact bodies_;
  BodyFriction friction_;
  ClothFriction cloth_friction_;
  Loads loads_;
  std::size_t stop_at_bodies(const std::vector<Eigen::Vector3d>& x, std::vector<Eigen::Vector3d>& dx);
  bool looked_ = false;                      // what lies near looked_at_ is known
  std::vector<Eigen::Vector3d> looked_at_;
  double rms_weight_ = 0;
  std::vector<Contact> contacts_, trial_contacts_;
  std::vector<float> shares_;
  std::vector<ContactStiffness> contact_stiffness_;
  std::vector<model::Placement> placements_, last_placements_;
  std::vector<char> touching_, touched_;
  std::vector<Eigen::Vector3d> force_;
};

}  // namespace garment::simulator
