#pragma once
// The particle model of a script, with what is worth telling of it: for all commands alike.
#include <vector>

#include "interpreter/language/interpret.hpp"
#include "runtime/modeller/modeller.hpp"

namespace garment::interpreter {

/// Models `garment`, that of a script with these acts or what was released of it left out. What only a drape minds - cloth that starts
/// through cloth (G0608) or on the wrong side of other cloth (G0609) - is told where the script drapes; patterns may lie piled up.
/// Otherwise it goes to `of_start`, for who drapes all the same.
modeller::ModelResult model_of(const design::Garment& garment, const std::vector<body::Body>& bodies, const std::vector<Act>& acts,
                               const modeller::ModelOptions& options = {}, Findings* of_start = nullptr);

}  // namespace garment::interpreter
