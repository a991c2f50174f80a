#pragma once
// Seams: sides as chains, orientation, the law of lengths, and what stays unsewn.
#include "interpreter/language/program.hpp"

namespace garment::interpreter {

int reserve_seam(Program& program, const Declaration& declaration);
Value evaluate_seam(Program& program, Declaration& declaration);

/// After all seams: links of chains must meet where other seams join them (G0503); rings are marked closed.
void check_chains(Program& program);

/// "front.side", as the modeller names it.
std::string name_of_part(const Program& program, const design::EdgePart& part);

/// Warns of edges that are neither sewn, attached nor free (G0505), once for each panel, and of edges sewn by two seams (G0508).
void check_unsewn(Program& program);

}  // namespace garment::interpreter
