#pragma once
// Paths followed so slowly that the cloth rests at every moment: rigs that pull, shear and bend cloth.
#include "runtime/simulator/motion.hpp"

namespace garment::simulator {

/// `move_on` with MotionMethod::quasi_static. What moves goes on by a quarter of the cloth's spacing at most, then the cloth is
/// brought to rest; anchors of friction last. The state ends without velocity.
DrapeReport follow_paths(const model::Model& model, const std::vector<body::Body>& bodies, model::State& state,
                         const MotionSettings& settings);

}  // namespace garment::simulator
