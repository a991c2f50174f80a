#include "interpreter/service/rename.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "grammar/text.hpp"
#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/declarations.hpp"
#include "interpreter/language/function_table.hpp"
#include "interpreter/service/locate.hpp"

namespace garment::service {
namespace {

using namespace interpreter;

constexpr std::size_t kMaxName = 200;

Diagnostic refuse(std::string code, std::string message, Span span, std::string help) {
  return Message(std::move(code), std::move(message), span).help(std::move(help)).diagnostic;
}

bool is_name(const std::string& text) {
  if (text.empty() || text.size() > kMaxName || !grammar::is_word_start(text[0])) return false;
  return std::all_of(text.begin(), text.end(), grammar::is_word_char);
}

/// Why this text can be no name at all; nothing if it can.
std::optional<Diagnostic> refuse_name(const std::string& name, Span span) {
  if (!is_name(name))
    return refuse("G1560", "`" + grammar::escape_controls(name.substr(0, kMaxName)) + "` is no name", span,
                  "names are letters, digits and _, and do not begin with a digit");
  for (const char* word : {"and", "or", "not", "minus", "is", "if", "else", "true", "false", "start", "end",
                           "left", "right", "resolution"})
    if (name == word)
      return refuse("G0303", "`" + name + "` has a meaning of its own and cannot be a name", span,
                    "take a longer name");
  if (find_unit(name))
    return refuse("G0303", "`" + name + "` is a unit and cannot be a name", span, "take a longer name");
  if (find_function(name) != nullptr)
    return refuse("G0303", "`" + name + "` is a builtin and cannot be a name", span, "take a longer name");
  return std::nullopt;
}

/// A thing of the same home that has this name already.
const Named* taken_by(const Names& names, const Named& thing, const std::string& name) {
  for (const Named& other : names.things) {
    const bool same_home = other.definition.source == thing.definition.source && other.owner == thing.owner &&
                           (other.part_of >= 0) == (thing.part_of >= 0);
    if (other.name == name && same_home && &other != &thing) return &other;
  }
  return nullptr;
}

/// Messages by code and text, names left out: how many of each an interpretation gave.
std::map<std::string, int> counted(const grammar::Diagnostics& diagnostics) {
  std::map<std::string, int> counts;
  for (const Diagnostic& d : diagnostics) ++counts[d.code];
  return counts;
}

/// Where a place of the text lies after the edits, none of which it lies in.
std::uint32_t moved(std::uint32_t offset, const std::vector<Edit>& edits) {
  std::int64_t shift = 0;
  for (const Edit& edit : edits)
    if (edit.span.end <= offset)
      shift += static_cast<std::int64_t>(edit.text.size()) -
               static_cast<std::int64_t>(edit.span.end - edit.span.begin);
  return static_cast<std::uint32_t>(offset + shift);
}

/// Which name stands for which declaration: (place, place of the declaration), both in the script; others are
/// left out.
using Meaning = std::set<std::pair<std::uint32_t, std::uint32_t>>;

Meaning meaning_of(const Names& names, grammar::SourceId source, const std::vector<Edit>& edits) {
  Meaning meaning;
  for (const NameUse& use : names.uses) {
    const Span definition = names.things[static_cast<std::size_t>(use.thing)].definition;
    if (use.span.source != source) continue;
    const bool inside = definition.source == source;
    meaning.insert({moved(use.span.begin, edits), inside ? moved(definition.begin, edits) : UINT32_MAX});
  }
  return meaning;
}

/// What would be wrong with the edited text; empty if it gives the messages that it gave, and each of its
/// names stands for what it stood for.
std::string what_changes(const grammar::Sources& sources, grammar::SourceId source,
                         const std::vector<Edit>& edits, const Interpretation& before, const Names& names,
                         Host& host, const InterpretOptions& options) {
  grammar::Sources edited;
  const grammar::SourceId id = edited.add(sources[source].name, apply_edits(sources[source].text, edits));
  const Interpretation after = interpret(edited, id, host, options);
  std::map<std::string, int> left = counted(before.diagnostics);
  for (const Diagnostic& d : after.diagnostics)
    if (--left[d.code] < 0) return d.message;
  if (meaning_of(names_of(after), id, {}) != meaning_of(names, source, edits))
    return "another thing would be taken for it";
  return "";
}

}  // namespace

std::string apply_edits(std::string_view text, std::vector<Edit> edits) {
  std::sort(edits.begin(), edits.end(),
            [](const Edit& a, const Edit& b) { return a.span.begin < b.span.begin; });
  std::string out;
  std::size_t at = 0;
  for (const Edit& edit : edits) {
    if (edit.span.begin < at || edit.span.end > text.size()) continue;
    out += text.substr(at, edit.span.begin - at);
    out += edit.text;
    at = edit.span.end;
  }
  return out + std::string(text.substr(at));
}

Renamable renamable_at(grammar::SourceId source, std::uint32_t offset, const Interpretation& interpretation,
                       const Names& names) {
  Renamable found;
  for (const NameUse* use : names.at(source, offset))
    if (!found.use || use->span.begin > found.use->span.begin) found.use = *use;
  if (!found.use) {
    found.why = "no declared name stands here";
    return found;
  }
  const Named& thing = names.things[static_cast<std::size_t>(found.use->thing)];
  if (thing.in_library || interpretation.program->in_library(found.use->span))
    found.why = "`" + thing.name + "` belongs to a library, and other scripts may use it";
  if (thing.composed) found.why = "`" + thing.name + "` is made of parts; change the text around its braces";
  if (!found.why.empty()) found.use.reset();
  return found;
}

Rename rename_at(const grammar::Sources& sources, grammar::SourceId source, std::uint32_t offset,
                 const std::string& name, const Interpretation& interpretation, const Names& names,
                 Host& host, const InterpretOptions& options) {
  Rename rename;
  const Renamable at = renamable_at(source, offset, interpretation, names);
  const Span here{source, offset, offset};
  if (!at.use) {
    rename.refused = refuse("G1561", at.why, here, "rename what this script declares");
    return rename;
  }
  const Named& thing = names.things[static_cast<std::size_t>(at.use->thing)];
  if (thing.name == name) return rename;
  rename.refused = refuse_name(name, at.use->span);
  if (rename.refused) return rename;
  if (const Named* other = taken_by(names, thing, name)) {
    rename.refused =
        refuse("G0302", "the name `" + name + "` is taken", at.use->span, "every name is declared once");
    rename.refused->labels.push_back({other->definition, "declared here"});
    return rename;
  }
  for (const NameUse* use : names.of(at.use->thing))
    if (use->span.source == source) rename.edits.push_back({use->span, name});
  const std::string wrong = what_changes(sources, source, rename.edits, interpretation, names, host, options);
  if (!wrong.empty()) {
    rename.refused =
        refuse("G1562", "with the name `" + name + "` the script would not mean the same: " + wrong,
               at.use->span, "take another name");
    rename.edits.clear();
  }
  return rename;
}

std::vector<Fix> fixes_of(const Diagnostic& diagnostic, const grammar::Sources& sources) {
  std::vector<Fix> fixes;
  if (diagnostic.labels.empty()) return fixes;
  const Span span = diagnostic.labels[0].span;
  const std::string found(sources.text(span));
  for (const std::string_view lead : {"did you mean `", "give it a unit: `"}) {
    const std::size_t begin = diagnostic.help.find(lead);
    if (begin == std::string::npos) continue;
    const std::size_t text = begin + lead.size(), end = diagnostic.help.find('`', text);
    if (end == std::string::npos) continue;
    const std::string meant = diagnostic.help.substr(text, end - text);
    Span place = span;
    if (lead.starts_with("did")) {
      // The message may show more than the misspelt word: then its last word is meant, if it alone is near.
      std::size_t word = found.size();
      while (word > 0 && grammar::is_word_char(found[word - 1])) --word;
      place.begin = span.begin + static_cast<std::uint32_t>(word);
      const std::string written = found.substr(word);
      if (written.empty() || nearest_name(written, {meant}).empty()) continue;
    }
    fixes.push_back({"write `" + meant + "`", {place, meant}});
  }
  return fixes;
}

}  // namespace garment::service
