#pragma once
// When cloth counts as being at rest, whatever brought it there.

namespace garment::simulator {

inline constexpr double kRestStep = 0.5e-3;     ///< m, largest Newton step of a garment at rest
inline constexpr double kRestTimeStep = 0.25;   ///< s, the step is judged with little regularisation only
inline constexpr double kSlidingStep = 1e-8;    ///< m, instead where cloth has friction of its own: loops are differences of forces

}  // namespace garment::simulator
