#pragma once
// One drape under way: inexact implicit steps towards the minimum of elastic, gravity and contact energy, none of which
// starts an intersection of cloth with cloth (docs/physics.md, section 3). Bodies push particles out along the
// normals of their surface, so a garment may start inside one; the drape looks at the exact certificate before it ends.
#include <Eigen/Core>
#include <vector>

#include "runtime/body/body.hpp"
#include "runtime/model/model.hpp"
#include "runtime/simulator/body_contact.hpp"
#include "runtime/simulator/cloth_contact.hpp"
#include "runtime/simulator/cloth_friction.hpp"
#include "runtime/simulator/contact.hpp"
#include "runtime/simulator/contact_mesh.hpp"
#include "runtime/simulator/elastic.hpp"
#include "runtime/simulator/friction.hpp"
#include "runtime/simulator/inner_friction.hpp"
#include "runtime/simulator/kept_candidates.hpp"
#include "runtime/simulator/linear_solver.hpp"
#include "runtime/simulator/loads.hpp"
#include "runtime/simulator/mirror.hpp"
#include "runtime/simulator/momentum.hpp"
#include "runtime/simulator/truncate.hpp"
#include "runtime/simulator/untangle.hpp"

namespace garment::simulator {

struct RelaxationSettings {
  bool self_collision = true;
  double self_offset = kSelfOffset;  ///< m, least contact distance of cloth with cloth
  double contact_stiffness = kContactStiffness;  ///< N/m, cloth against cloth
  BodyContactSettings body;
  double friction_give = 3e-4;      ///< m, by which a contact with a body gives way before it slips
  double gravity_scale = 1;
  bool hysteresis = false;          ///< the sliders inside the cloth act, where the model has any
};

struct StepReport {
  double residual = 0;       ///< RMS net force over RMS weight, before the step
  double newton_step = 0;    ///< m, largest displacement that the linear system asked for
  double largest_motion = 0; ///< m, largest displacement made, with what x had coasted
  double time_step = 0;      ///< s, of the regularisation
  double energy = 0;         ///< J
  int linear_iterations = 0;
  std::size_t contacts = 0;
  std::size_t limited = 0;   ///< particles whose motion a wall cut back
  double scale = 1;          ///< share of the displacement that the line search took
  bool accepted = true;
};

class Relaxation {
 public:
  Relaxation(const model::Model& model, const std::vector<body::Body>& bodies, const RelaxationSettings& settings);

  /// Moves x ahead on the way of the last steps, along paths that start no intersection. The next step goes from there, and ends
  /// where x was before if that did not pay.
  void coast(std::vector<Eigen::Vector3d>& x);
  /// One step from `x`; changes it. `x` is only ever moved along paths that start no intersection.
  StepReport step(std::vector<Eigen::Vector3d>& x);

  /// Net force on every particle at x, N: what bodies can bear by pressure and friction, and what holds carry, taken out.
  /// Returns the residual: RMS net force over RMS weight.
  double residual(const std::vector<Eigen::Vector3d>& x, std::vector<Eigen::Vector3d>& force);

  /// Elastic and gravity energy at x, J.
  double energy(const std::vector<Eigen::Vector3d>& x) const;
  /// With which each holder pulled on the cloth at the last `residual`, N, and its moment, N m.
  const std::vector<Eigen::Vector3d>& reactions() const { return reactions_; }
  const std::vector<Eigen::Vector3d>& moments() const { return moments_; }
  /// The sliders inside the cloth: frozen in steps, they go on where `slip` is called.
  InnerFriction& inner_friction() { return inner_; }
  const InnerFriction& inner_friction() const { return inner_; }

  /// Moves the bodies from where they are given to where they are now.
  void place_bodies(const std::vector<model::Placement>& placements) {
    bodies_.place(placements, friction_);
    stop();
  }
  /// After the model's holds have moved: planes tilt with what they move with.
  void follow_holds() {
    holds_ = Holds(model_);
    stop();
  }
  void set_gravity_scale(double scale) { settings_.gravity_scale = scale; }
  void set_tensile_scale(double scale) { elastic_.set_tensile_scale(scale); }
  void set_time_step(double seconds) { time_step_ = seconds; }
  /// Frees particles that were damped for going back and forth, and stops all: for when what acts on them has changed.
  void forget_motion() {
    damping_.assign(damping_.size(), 0);
    turns_.assign(turns_.size(), 0);
    stop();
  }
  /// The next step goes from where x is.
  void stop() { momentum_.forget(); }
  /// By how much more than the settings say bodies keep each particle away, m [n_particles].
  std::vector<double>& extra_offset() { return bodies_.extra_offset(); }
  const ContactMesh& mesh() const { return mesh_; }
  /// Exempts what is tangled now from contacts and walls, and remembers to take it apart with every step.
  void set_tangle(Tangle tangle);
  const Tangle& tangle() const { return tangle_; }
  // A garment that is part of another one (awake.hpp): `particle` are the whole's of each of its own.
  /// Takes over what lasts from step to step; time steps and weights are the whole's.
  void borrow(Relaxation& whole, const std::vector<model::Index>& particle);
  /// Gives it back, for the particles that are free. The whole's next step goes from where x is.
  void give_back(Relaxation& whole, const std::vector<model::Index>& particle, const std::vector<char>& free);
  /// No particle goes farther from its place than `leash` (m) from now on.
  void keep_near(std::vector<Eigen::Vector3d> place, double leash) { place_ = std::move(place), leash_ = leash; }
  /// Steps end where the garment lies as its own image.
  void keep_even(Mirror mirror) { mirror_ = std::move(mirror); }
  /// Did the last step begin where it does not?
  bool uneven() const { return uneven_; }
  /// Did the leash cut the last step back?
  bool at_leash() const { return at_leash_; }
  /// No tangle is taken apart, and neither cloth rubs on cloth nor within itself: energy tells all.
  bool plain() const { return tangle_.empty() && inner_.idle() && cloth_friction_.idle(); }
  const RelaxationSettings& settings() const { return settings_; }
  double rms_weight() const { return rms_weight_; }  ///< N, of the particles

  /// In a checkpoint: all that lasts from step to step but the positions and where bodies and holds are.
  void keep(Archive& a);

 private:
  void refresh_candidates(const std::vector<Eigen::Vector3d>& x);
  void exempt_tangle(const std::vector<Eigen::Vector3d>& x);
  void find_contacts(const std::vector<Eigen::Vector3d>& x, std::vector<Contact>& contacts) const;
  void keep_shares();
  double contact_energy_sum(const std::vector<Contact>& contacts) const;
  double gravity_energy(const std::vector<Eigen::Vector3d>& x) const;
  double total_energy(const std::vector<Eigen::Vector3d>& x, std::vector<Contact>& contacts) const;
  void add_external_forces(const std::vector<Eigen::Vector3d>& x, std::vector<Eigen::Vector3d>& force);
  void collect_normal_forces(const std::vector<Eigen::Vector3d>& x);
  double assemble(const std::vector<Eigen::Vector3d>& x, StepReport& report);
  void solve_step(const std::vector<Eigen::Vector3d>& x, StepReport& report);
  std::size_t foresee_contacts(const std::vector<Eigen::Vector3d>& x);
  bool drive(const std::vector<Eigen::Vector3d>& x);
  void pull_back(const std::vector<Eigen::Vector3d>& x);
  TruncateStats keep_apart(const std::vector<Eigen::Vector3d>& x);
  void damp(const std::vector<Eigen::Vector3d>& before, const std::vector<Eigen::Vector3d>& after);
  double search(const std::vector<Eigen::Vector3d>& x, double before, bool driven, StepReport& report);
  double residual_of(std::vector<Eigen::Vector3d>& force) const;
  bool move_held(const std::vector<Eigen::Vector3d>& x, std::vector<Eigen::Vector3d>& dx) const;
  double rms_over_weight(const std::vector<Eigen::Vector3d>& force) const;

  const model::Model& model_;
  RelaxationSettings settings_;
  ElasticModel elastic_;
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
  std::vector<Eigen::Vector3d> reactions_, moments_;
  Tangle tangle_;
  double spacing_ = 0.01;             // mean edge length, m
  double time_step_ = 1.0 / 60;
  double rms_weight_ = 0;
  std::vector<Contact> contacts_, trial_contacts_, coming_;
  std::vector<float> shares_;  // of the contacts of this step, by pair
  std::vector<ContactStiffness> stiffness_;
  std::vector<double> damping_;  // N/m, of particles that swing [n_particles]
  std::vector<int> turns_;       // how often they turned back [n_particles]
  std::vector<Eigen::Vector3d> last_motion_;
  Momentum momentum_;
  std::vector<Eigen::Vector3d> origin_;  // where x was before it coasted; empty: it did not
  BodyFriction rubbed_;                  // friction there
  std::vector<Eigen::Vector3d> place_;   // from which particles go no farther than the leash; empty: wherever they like
  double leash_ = 0;                     // m
  bool at_leash_ = false;
  Mirror mirror_;
  bool uneven_ = false;
  std::vector<Eigen::Vector3d> force_, wish_, net_, dx_, whole_, trial_, untangle_;
};

}  // namespace garment::simulator
