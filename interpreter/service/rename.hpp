#pragma once
// One name for another, everywhere at once; and what a message's remedy says, done.
#include <optional>
#include <string>
#include <vector>

#include "grammar/diagnostic.hpp"
#include "interpreter/language/interpret.hpp"
#include "interpreter/service/names.hpp"

namespace garment::service {

/// Bytes `span` become `text`.
struct Edit {
  grammar::Span span;
  std::string text;
};

/// What the name at a place is; nothing where none stands that could be changed, and then why.
struct Renamable {
  std::optional<NameUse> use;
  std::string why;  ///< "`cm` is a unit and keeps its name"
};
Renamable renamable_at(grammar::SourceId source, std::uint32_t offset,
                       const interpreter::Interpretation& interpretation, const Names& names);

/// The edits that give the thing at a place another name, or the one diagnostic that says why not: names that
/// are taken or have a meaning of their own are refused, and so is what would change the garment's meaning:
/// the edited script is interpreted, and must give no message that it did not give before.
struct Rename {
  std::vector<Edit> edits;
  std::optional<grammar::Diagnostic> refused;
};
Rename rename_at(const grammar::Sources& sources, grammar::SourceId source, std::uint32_t offset,
                 const std::string& name, const interpreter::Interpretation& interpretation,
                 const Names& names, Host& host, const interpreter::InterpretOptions& options);

/// The text with edits made that do not overlap.
std::string apply_edits(std::string_view text, std::vector<Edit> edits);

/// A remedy that is a plain replacement: "did you mean `side`?", "give it a unit: `45 deg`".
struct Fix {
  std::string title;
  Edit edit;
};
std::vector<Fix> fixes_of(const grammar::Diagnostic& diagnostic, const grammar::Sources& sources);

}  // namespace garment::service
