#pragma once
// The values of a script's names as a person reads them; for tests and reports.
#include <map>
#include <string>

#include "interpreter/language/interpret.hpp"

namespace garment::interpreter {

/// What each `let`, `param` and `measure` of the script is, as a report prints it ("58 cm"), by the line it
/// stands on. Those that ask a drape or have no value are left out.
std::map<std::size_t, std::string> values_by_line(Interpretation& interpretation,
                                                  const grammar::Sources& sources);

}  // namespace garment::interpreter
