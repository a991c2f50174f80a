#pragma once
// Every name of a script and of the files it uses: what declares it and where it is used.
#include <cstdint>
#include <string>
#include <vector>

#include "grammar/syntax_tree.hpp"
#include "interpreter/language/interpret.hpp"

namespace garment::service {

using grammar::Span;

/// Something that a script gives a name. Both halves that `both` and a fold make, all rounds of a loop, and
/// what a `like` panel takes over are one thing: they have one name in the text.
struct Named {
  std::string name;     ///< as written: "side", "gore_{i}"
  std::string keyword;  ///< of its construct: "panel", "edge"; "parameter" of a function, "variable" of a
                        ///< loop, "library"
  std::string owner;    ///< the panel, component or function that it belongs to, "" at the top level
  Span definition;      ///< its name where it is declared; a library: the start of its file
  Span statement;       ///< the statement that declares it, or its parameter
  std::string doc;
  int part_of = -1;  ///< a member's panel, among the things
  bool in_library = false;
  bool composed = false;  ///< the name holds `{...}`
};

struct NameUse {
  Span span;
  int thing = -1;  ///< index into Names::things
  bool declares = false;
};

struct Names {
  std::vector<Named> things;
  std::vector<NameUse> uses;  ///< ordered by source and place; one place may be the use of several things

  /// The uses that touch this place; a place just behind a name touches it.
  std::vector<const NameUse*> at(grammar::SourceId source, std::uint32_t offset) const;
  /// All uses of a thing, in order.
  std::vector<const NameUse*> of(int thing) const;
};

/// The names of a script and its libraries. Works on scripts with mistakes: names are resolved as the
/// evaluator resolves them, from the text of the declarations.
Names names_of(const interpreter::Interpretation& interpretation);

}  // namespace garment::service
