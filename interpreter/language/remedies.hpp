#pragma once
// What to do: the help of a diagnostic that has none of its own.
#include <vector>

#include "grammar/diagnostic.hpp"
#include "grammar/syntax_tree.hpp"

namespace garment::interpreter {

/// Gives each error and warning without a help the form of the statement or function that holds its primary place, where
/// the code is about forms; else what the table of codes says is to be done. `scripts` are the trees the places lie in.
void add_remedies(grammar::Diagnostics& diagnostics, const std::vector<const grammar::Script*>& scripts);

}  // namespace garment::interpreter
