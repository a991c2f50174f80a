#include "interpreter/cli/reference_library.hpp"

#include <algorithm>

#include "grammar/syntax_tree.hpp"
#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/interpret.hpp"
#include "interpreter/language/standard_libraries.hpp"

namespace garment::cli {
namespace {

constexpr std::uint64_t kMostBytes = 4 << 20;

/// The text up to the first line end or the first sentence's end, without line breaks.
std::string first_sentence(const std::string& doc) {
  std::string line = doc.substr(0, doc.find('\n'));
  const std::size_t stop = line.find(". ");
  return stop == std::string::npos ? line : line.substr(0, stop + 1);
}

std::string in_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::string out;
  for (char c : text)
    if (c != ' ' || out.empty() || out.back() != ' ') out += c;
  return out;
}

/// A figure of a fabric's record as it is written.
std::string figure(const grammar::Statement& fabric, const std::string& name, const grammar::Sources& sources) {
  for (const grammar::Clause& clause : fabric.clauses)
    for (const grammar::Expr& record : clause.values)
      for (std::size_t k = 0; k < record.labels.size() && k < record.children.size(); ++k)
        if (record.labels[k].text == name) return std::string(sources.text(record.children[k].span));
  return "";
}

std::string fabric_rows(const grammar::Script& script, const grammar::Sources& sources) {
  std::string rows;
  for (const grammar::Statement& s : script.statements) {
    if (s.keyword.text != "fabric" || !s.name) continue;
    std::string kind = figure(s, "kind", sources);
    kind.erase(std::remove(kind.begin(), kind.end(), '"'), kind.end());
    rows += "| `" + s.name->text + "` | " + first_sentence(s.doc) + " | " + figure(s, "W", sources) + " | " + kind + " |\n";
  }
  return rows.empty() ? "" : "| fabric | what it is | weight | figures |\n|---|---|---|---|\n" + rows + '\n';
}

std::string callables(const grammar::Script& script, const std::string& library, const grammar::Sources& sources) {
  std::string text;
  for (const grammar::Statement& s : script.statements) {
    const bool callable = s.keyword.text == "fn" || s.keyword.text == "component";
    if (!callable || s.doc.empty() || s.operands.empty()) continue;
    std::string ports;
    for (const grammar::Statement& inner : s.body ? *s.body : grammar::Block{})
      if (inner.keyword.text == "port" && inner.name) ports += (ports.empty() ? "`" : ", `") + inner.name->text + '`';
    text += "#### " + library + '.' + s.operands[0].children[0].text + "\n\n```\n" + std::string(sources.text(s.operands[0].span)) +
            "\n```\n\n" + in_one_line(s.doc) + (ports.empty() ? "" : " Ports: " + ports + '.') + "\n\n";
  }
  return text;
}

template <class Map>
std::string names_of(const Map& map) {
  std::string text;
  for (const auto& [name, value] : map) text += (text.empty() ? "`" : ", `") + name + '`';
  return text;
}

/// Levels and parts of a person, as a script names them.
std::string places_of_a_person(const std::string& folder, Host& host) {
  grammar::Sources sources;
  const grammar::SourceId source = sources.add("person", "use bodies\nbody form = bodies.woman(size: 40)\n");
  interpreter::InterpretOptions options;
  options.stdlib_dir = folder;
  const interpreter::Interpretation result = interpreter::interpret(sources, source, host, options);
  if (result.bodies.empty()) return "";
  return "Levels of a person (`form.waist`, with `.girth` and `.height`): " + names_of(result.bodies[0].levels) +
         ".\n\nParts of a person (`form.arm.left`): " + names_of(result.bodies[0].parts) + ".\n\n";
}

}  // namespace

std::string library_chapter(const std::string& folder, Host& host) {
  std::string text = "## The standard library\n\nNames of a library are written with it, after `use`: `fabrics.denim`.\n\n";
  for (const interpreter::StandardLibrary& standard : interpreter::kStandardLibraries) {
    const std::string library(standard.name);
    const HostResult<std::string> file = host.read_file(folder + '/' + library + ".garment", kMostBytes);
    if (!file) continue;
    grammar::Sources sources;
    const grammar::SourceId source = sources.add(library, *file.value);
    const grammar::Script script = grammar::parse(sources, source, interpreter::vocabulary()).script;
    text += "### " + library + "\n\n" + fabric_rows(script, sources) + callables(script, library, sources);
    if (library == "bodies") text += places_of_a_person(folder, host);
  }
  return text;
}

}  // namespace garment::cli
