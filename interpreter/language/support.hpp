#pragma once
// Will the garment stay up?
#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// Warns of parts of the garment that weight would pull off (G0515), in scripts that drape: panels joined by
/// seams and closures that nothing holds. Held is what is attached, pinned, clamped or lies on a plain body;
/// what reaches the shoulders of a person; and what has its topmost ring, the edges placed at one level,
/// narrower than the person somewhere below. Where the script does not say enough to tell, nothing is said.
void check_support(Program& program);

}  // namespace garment::interpreter
