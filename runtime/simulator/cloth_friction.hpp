#pragma once
// Coulomb friction of cloth with cloth: a spring between the two sides of every contact that slips when it carries more than
// mu N, as BodyFriction has between particles and bodies.
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "runtime/base/archive.hpp"
#include "runtime/model/model.hpp"
#include "runtime/simulator/block_matrix.hpp"
#include "runtime/simulator/contact.hpp"
#include "runtime/simulator/contact_stiffness.hpp"
#include "runtime/simulator/friction.hpp"

namespace garment::simulator {

/// Which contacts rub.
enum class Rubbing {
  stated,  ///< those of panels for which the garment states a friction
  all,     ///< all; the others by the geometric mean of both sides
};

class ClothFriction {
 public:
  /// `give`: by how much a contact gives way before it slips, m; `most_stiffness`: of its spring, N/m.
  ClothFriction(const model::Model& model, Rubbing rubbing, double give, double most_stiffness);

  /// Nothing rubs, ever.
  bool idle() const { return idle_; }
  /// Begins a step where the contacts were found: springs of those that were there before go on, turned into the present tangent plane. The limits mu N
  /// stand for the step, N being the force by which each contact repels now, for the contact stiffness k (N/m).
  void begin(const ContactMesh& mesh, const Candidates& candidates, const std::vector<Contact>& contacts, double k);
  /// Energy of the springs, what slips counted with its limit, J.
  double energy(const std::vector<Vector3d>& x) const;
  /// Adds forces at x, and where they are given the stiffness: its diagonal blocks to the matrix, the rest to `stiffness`.
  void add_force(const std::vector<Vector3d>& x, std::vector<Vector3d>& force, BlockMatrix* matrix,
                 std::vector<ContactStiffness>* stiffness) const;
  /// Springs that slipped let go (after an accepted step to x). Returns the heat, J.
  double follow(const std::vector<Vector3d>& x);
  std::size_t size() const { return touches_.size(); }
  void keep(Archive& a);  ///< in a checkpoint

 private:
  struct Touch {
    std::uint64_t key = 0;           // the two parts of the contact
    Indices<4> p{};
    std::array<double, 4> w{};
    Vector3d normal{0, 0, 0};
    Vector3d stretch{0, 0, 0};       // m, of the spring when the step began
    Vector3d gap{0, 0, 0};           // sum w x when the step began, m
    double limit = 0, stiffness = 0;  // N, N/m
  };
  Vector3d stretch(const Touch& t, const std::vector<Vector3d>& x) const;
  double friction_of(const Contact& contact) const;

  const model::Model& model_;
  Rubbing rubbing_;
  double give_, most_stiffness_;
  bool idle_;
  std::vector<Index> panel_;             // of each particle, its first
  std::vector<double> factor_;           // [n_panels^2], < 0: not stated
  std::vector<Touch> touches_, before_;  // by key, ascending
};

}  // namespace garment::simulator
