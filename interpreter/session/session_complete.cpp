// What may come next in an entry.
#include <algorithm>

#include "interpreter/service/completion.hpp"
#include "interpreter/session/commands.hpp"

namespace garment::session {
namespace {

/// Those that begin as the word does.
void add_matching(std::vector<Proposal>& out, std::string_view word, std::string_view text,
                  std::string_view detail) {
  if (text.size() >= word.size() && text.substr(0, word.size()) == word)
    out.push_back({std::string(text), std::string(detail), word.size()});
}

/// The words that an argument of a command may be; false where it is written as the language is.
bool complete_argument(std::string_view command, std::string_view word, std::vector<Proposal>& out) {
  if (command == "help") {
    for (const SessionCommand& c : session_commands()) add_matching(out, word, c.name, c.doc);
    return false;  // and the words of the language
  }
  if (command != "set")
    return command != "info" && command != "list" && command != "text" && command != "remove";
  for (const std::string& name : setting_names()) add_matching(out, word, name, "");
  return true;
}

}  // namespace

std::vector<Proposal> Session::complete(const std::string& text) const {
  std::vector<Proposal> out;
  std::string_view rest = text;
  if (!text.empty() && text[0] == ':') {
    const std::size_t blank = text.find(' ');
    if (blank == std::string::npos) {
      for (const SessionCommand& command : session_commands())
        add_matching(out, rest.substr(1), command.name, command.doc);
      return out;
    }
    const std::string_view command = rest.substr(1, blank - 1);
    rest.remove_prefix(blank + 1);
    if (complete_argument(command, rest, out)) return out;
  }
  if (rest.find_first_of(" \t\n.([{=:") ==
      std::string_view::npos)  // an entry may begin with what it asks for or changes
    for (const interpreter::DeclaredThing& thing : interpreter::declared_things(stage_.evaluated->result))
      add_matching(out, rest, thing.name, thing.keyword);
  grammar::Sources sources;
  const grammar::SourceId source = sources.add("<prompt>", std::string(rest));
  const std::uint32_t end = static_cast<std::uint32_t>(rest.size());
  for (service::Completion& c : service::complete(sources, source, end, &stage_.evaluated->result))
    if (std::none_of(out.begin(), out.end(), [&](const Proposal& p) { return p.text == c.text; }))
      out.push_back({c.text, c.kind + (c.detail.empty() ? "" : "  " + c.detail), end - c.replace_begin});
  return out;
}

}  // namespace garment::session
