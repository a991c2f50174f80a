#pragma once
// Where the energy of a motion came from and went to.

namespace garment::simulator {

/// All in J. kinetic + stored - (those at the start) = work - damping - friction - numerical, to rounding.
struct EnergyBalance {
  double kinetic = 0;        ///< at the end
  double stored = 0;         ///< elastic, of weight and of contacts, at the end
  double kinetic_start = 0, stored_start = 0;
  double work = 0;           ///< done on the cloth by forces, pressure, air, moving clamps and bodies
  double damping = 0;        ///< turned to heat by the cloth's own damper
  double friction = 0;       ///< by rubbing on bodies and on cloth
  double numerical = 0;      ///< lost to the steps of the integrator; negative: gained

  double change() const { return kinetic + stored - kinetic_start - stored_start; }
};

/// What `drape for` tells beside the report of a drape.
struct MotionReport {
  double seconds = 0;        ///< simulated
  int steps = 0;             ///< of time, refused ones not counted; 0 of paths followed at rest
  int iterations = 0;        ///< of Newton's method, in all steps
  double least_step = 0, largest_step = 0;  ///< s
  double stable_step = 0;    ///< s, bound of an explicit solver; 0: none
  EnergyBalance balance;
};

}  // namespace garment::simulator
