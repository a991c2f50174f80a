#pragma once
// What an editor tells of the word under the pointer: kind, unit, value, lengths, what it is sewn to,
// documentation.
#include <optional>
#include <string>
#include <vector>

#include "grammar/source.hpp"
#include "interpreter/language/interpret.hpp"
#include "interpreter/service/names.hpp"

namespace garment::service {

struct Hover {
  std::string text;    ///< Markdown
  grammar::Span span;  ///< what it speaks of
};

/// Of byte `offset` of a source of the interpretation; nothing where nothing is to be told.
std::optional<Hover> hover_at(const grammar::Sources& sources, grammar::SourceId source, std::uint32_t offset,
                              const interpreter::Interpretation& interpretation, const Names& names);

/// A side that an edge is sewn to.
struct Partner {
  std::string seam;                        ///< name of the seam
  std::string edges;                       ///< the other side: "back.left.side"
  grammar::Span side;                      ///< where it stands in the seam's statement
  std::vector<grammar::Span> definitions;  ///< where its edges are drawn
};

/// What the edge at a place is sewn to: an edge where it is drawn, or as an expression names it.
std::vector<Partner> partners_at(const grammar::Sources& sources, grammar::SourceId source,
                                 std::uint32_t offset, const interpreter::Interpretation& interpretation,
                                 const Names& names);

/// The call around a place and which of its arguments the place is in.
struct Signature {
  std::string form, doc;
  std::vector<std::string> parameters;  ///< texts within `form`
  int active = 0;                       ///< of parameters
};
std::optional<Signature> signature_at(const grammar::Sources& sources, grammar::SourceId source,
                                      std::uint32_t offset,
                                      const interpreter::Interpretation* interpretation);

}  // namespace garment::service
