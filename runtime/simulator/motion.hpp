#pragma once
// How a garment moves in time: `drape for` (docs/physics.md, section 3.7).
#include <functional>
#include <vector>

#include "runtime/simulator/drape.hpp"

namespace garment::simulator {

inline constexpr double kSameTime = 1e-9;  ///< s: moments that are nearer to each other are one

enum class MotionMethod {
  implicit,        ///< BDF2, implicit Euler where contacts change
  semi_implicit,   ///< implicit Euler, linearised once a step
  explicit_steps,  ///< symplectic Euler, below its stability bound
  dynamic_constraints,  ///< explicit, with reactive forces for holds and ties and impulses for contacts
  quasi_static,    ///< at rest at every moment: paths are followed slowly
};

struct MotionSettings {
  double duration = 1;     ///< s
  MotionMethod method = MotionMethod::implicit;
  double step = 0;         ///< s; 0: chosen by the method
  double tolerance = 5e-3; ///< of an implicit step: RMS of what is left of the equations over RMS weight
  bool self_collision = true;
  int max_steps = 10'000'000;
  std::function<void(const DrapeProgress&)> progress;  ///< called between steps; may be empty
  std::function<bool()> interrupted;                   ///< asked between steps; may be empty
  Checkpoints checkpoints;
  /// Called at the start and at every time that `next_frame` names; steps end exactly there. Both may be empty. The report has
  /// what is known by then.
  std::function<void(const model::State&, const DrapeReport&)> frame;
  std::function<double(double after)> next_frame;      ///< s, later than `after`; infinite: none
};

/// Moves `state` on by the settings' duration, from its own time, positions and velocities. `bodies` are where they are at
/// time 0; motions of the model move them. On return `state` holds the last consistent positions, whatever the status.
/// Refuses a garment that is still open (G0805) and an explicit step beyond its bound (G0806); a step that fails after six
/// halvings ends the motion (G0807).
DrapeReport move_on(const model::Model& model, const std::vector<body::Body>& bodies, model::State& state,
                    const MotionSettings& settings);

}  // namespace garment::simulator
