#pragma once
// How long the sides of a seam are against each other: `ease`, `gather`, `stretch`, on a whole side or part
// of it.
#include <string>
#include <vector>

#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// A relation on part of a side; positions in metres along the side as it is written.
struct PartRelation {
  const Clause* clause = nullptr;
  double factor = 1;
  double from = 0, to = 0;
};

/// A side of a seam as the statement gives it.
struct SeamSideDraft {
  const Expr* expr = nullptr;
  EdgeValue edge;
  const Clause* relation = nullptr;  ///< on the whole side
  double factor = 1;                 ///< the side is this many times the seam
  std::vector<PartRelation> parts{};
  bool reversed = false;
  bool mirrored = false;  ///< a chain of right halves, walked from the end of what was written; so run its ranges

  bool related() const { return relation != nullptr || !parts.empty(); }
};

/// A run of a side with one fullness, in drawn direction of its edge.
struct SidePiece {
  EdgeSpan span;
  double fullness = 1;
};

/// The side cut where partial relations begin and end, in the order and direction in which the seam walks it:
/// with the loop counter-clockwise, or against it.
std::vector<SidePiece> pieces_along(const Program& program, const SeamSideDraft& side, bool against);

/// Sewn length of the side, each piece divided by its fullness, m.
double plain_length(const Program& program, const SeamSideDraft& side);

/// Takes `ease 6%` or `ease 6% [notch_f .. notch_b]` into the side.
void take_relation(Program& program, Scope& scope, SeamSideDraft& side, const Clause& clause,
                   const Override* change);

/// Reports sides that are too long or too short for each other (G0501); false if there are any.
bool check_side_lengths(Program& program, const std::string& seam, const std::vector<SeamSideDraft>& sides);

}  // namespace garment::interpreter
