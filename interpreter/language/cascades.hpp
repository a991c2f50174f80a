#pragma once
// One mistake, one error: what only follows from another error is taken out before a person reads it.
#include "grammar/diagnostic.hpp"
#include "grammar/source.hpp"

namespace garment::interpreter {

/// Takes out of `diagnostics` (in the order of the text) what follows from other errors in it:
/// - everything about meaning, where a mistake hides what statements there are (an open block, an unknown
/// keyword);
///   where a mistake stays inside its statement, what is said about its own and the neighbouring lines;
/// - a further error at the very same place;
/// - the same unknown name again, and an unknown name that stands in the line of another error: it may be
/// what that
///   line should have declared.
/// At least one error stays where there was one.
void drop_cascades(grammar::Diagnostics& diagnostics, const grammar::Sources& sources);

}  // namespace garment::interpreter
