#pragma once
// The list of near pairs that a drape or a motion keeps from step to step.
#include <vector>

#include "runtime/base/archive.hpp"
#include "runtime/simulator/candidates.hpp"

namespace garment::simulator {

/// Candidates that are listed anew when they may no longer be complete, with as much room as lets a list serve for some
/// positions: much room makes long lists, little room makes many. All depends on the positions alone.
class KeptCandidates {
 public:
  /// `spacing`: of the particles, m.
  KeptCandidates(const ContactMesh& mesh, double spacing) : mesh_(mesh), spacing_(spacing), room_(spacing / 4) {}

  const Candidates& list() const { return candidates_; }
  Candidates& list() { return candidates_; }
  /// Makes the list complete for contacts at x; true where it was made anew.
  bool refresh(const std::vector<Vector3d>& x);
  /// Makes the list anew, with more room: it was too short for a step from x.
  void renew(const std::vector<Vector3d>& x);
  /// The next refresh makes a new one.
  void forget() { known_ = false; }
  bool known() const { return known_; }
  void keep(Archive& a);  ///< in a checkpoint; what is exempt is not kept

 private:
  void rebuild(const std::vector<Vector3d>& x);

  const ContactMesh& mesh_;
  Candidates candidates_;
  double spacing_, room_;
  int served_ = 0;  // positions since the list was made
  bool known_ = false;
};

}  // namespace garment::simulator
