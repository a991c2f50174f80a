#pragma once
// Declared garment -> script text that declares it again.
#include <string>
#include <vector>

#include "runtime/design/garment.hpp"

namespace garment::interpreter {

struct UnparseOptions {
  std::string title;                  ///< empty: the garment's own
  std::vector<std::string> comments;  ///< lines at the top, without `#`
  /// Right side of `body NAME = ...` for the bodies that attachments and placements name and the garment does
  /// not declare: `mesh("body.obj")`, `bodies.woman(size: 40)`; a garment without any body gets it as
  /// `body_name`. Empty: what speaks of such bodies is written as comments, to be taken up once a body is
  /// declared.
  std::string body;
  std::string body_name = "form";
  std::string fabric;  ///< right side of the first fabric's statement; empty: all its figures
  std::vector<std::string> trailer;   ///< lines at the end, comments with their `#`
  std::vector<std::string> acts = {"drape until rest"};  ///< last lines
};

/// A readable script that evaluates to the same garment: coordinates within 5e-13 m, angles within 1e-9
/// degrees, seam relations within 1e-12. Laid out as the formatter would. Names that the language keeps for
/// itself get a `_1` behind them, and the dots of halves become underscores (a panel on the fold comes out
/// unfolded). A relation that is not a number (sides of whatever lengths) is left out.
std::string unparse(const design::Garment& garment, const UnparseOptions& options = {});

}  // namespace garment::interpreter
