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

/// The ending of the files that a command takes; empty where it takes none.
std::string_view ending_for(std::string_view command) {
  if (command == "load" || command == "save" || command == "save!") return ".garment";
  return command == "view" ? ".png" : "";
}

/// Names in the folder that `path` has come to; of files only those with `ending`.
void complete_path(const SessionOptions& options, std::string_view path, std::string_view ending,
                   std::vector<Proposal>& out) {
  if (!options.folder_entries) return;
  if (!path.empty() && path.front() == '"') path.remove_prefix(1);
  const std::size_t slash = path.rfind('/');
  const std::string_view folder = slash == std::string_view::npos ? "" : path.substr(0, slash + 1);
  const std::string_view word = path.substr(folder.size());
  for (const std::string& name : options.folder_entries(std::string(folder))) {
    if (name.front() == '.' && word.empty()) continue;
    const bool fits = name.size() >= ending.size() && name.substr(name.size() - ending.size()) == ending;
    if (fits || name.back() == '/') add_matching(out, word, name, "");
  }
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
    rest.remove_prefix(std::min(rest.size(), rest.find_first_not_of(' ', blank)));
    if (const SessionCommand* found = find_command(command); found != nullptr && !ending_for(found->name).empty()) {
      complete_path(options_, rest, ending_for(found->name), out);
      return out;
    }
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
