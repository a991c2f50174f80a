#pragma once
// What goes wrong while parsing: thrown inside this room only, from the place of the mistake to the statement
// around it.
#include <cstdint>

#include "grammar/diagnostic.hpp"

namespace garment::grammar {

struct SyntaxError {
  Diagnostic diagnostic;
  std::uint32_t position = 0;  ///< where reading stopped
  bool incomplete = false;     ///< at the end of the text, where more text could set it right
  bool fatal = false;          ///< reading does not go on after it
};

}  // namespace garment::grammar
