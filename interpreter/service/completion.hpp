#pragma once
// What may be written at a place of a script: keywords, clause words, names, units.
#include <cstdint>
#include <string>
#include <vector>

#include "grammar/source.hpp"
#include "interpreter/language/interpret.hpp"

namespace garment::service {

/// One proposal. `text` takes the place of bytes [replace_begin, replace_end) of the source.
struct Completion {
  std::string text;    ///< "seam", "front", "cm"
  std::string kind;    ///< "keyword", "clause", "function", "unit", "word", "field", "argument", "member", or
                       ///< the keyword of what is declared: "panel", "edge", "param" ...
  std::string detail;  ///< one line beside it: "LENGTH, 0 cm .. 50 cm", "24.6 cm"
  std::string doc;     ///< what it does; may be empty
  std::uint32_t replace_begin = 0, replace_end = 0;
};

/// Everything that may stand at byte `offset` of a source and begins with the word written there so far, the
/// likeliest first. The text need not parse. `interpretation` tells the members and values of what is
/// declared; it may be of an older text of the script, or null. Nothing is proposed inside comments and
/// strings.
std::vector<Completion> complete(const grammar::Sources& sources, grammar::SourceId source,
                                 std::uint32_t offset, const interpreter::Interpretation* interpretation);

}  // namespace garment::service
