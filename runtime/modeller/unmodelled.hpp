#pragma once
// What a garment may declare and the modeller has no particles for yet.
#include "runtime/base/finding.hpp"
#include "runtime/design/garment.hpp"

namespace garment::modeller {

/// One finding (G0460) for each declared thing that the modeller or the simulator would have to leave out, at its
/// place in the script. A model of such a garment is refused: it would be another garment than the declared one.
Findings find_unmodelled(const design::Garment& garment, Severity severity = Severity::error);

/// The findings with those of G0460 drawn together into the first of them, which names all and has a label at each place: what
/// a person reads. Two places or fewer stay as they are.
Findings in_one(const Findings& findings);

}  // namespace garment::modeller
