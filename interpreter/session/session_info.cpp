// What the session tells about the script and the garment.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "interpreter/language/construct_table.hpp"
#include "interpreter/session/commands.hpp"
#include "runtime/base/number.hpp"
#include "runtime/model/dump.hpp"
#include "runtime/results/report.hpp"

namespace garment::session {
namespace {

using grammar::Statement;
using interpreter::DeclaredThing;

constexpr std::size_t kMostDependents = 12;
constexpr const char* kIntroduction =
    "Type a statement of the language to add or replace it, a name or an expression to see its value,\n"
    "NAME = VALUE to change a value where it stands (`long = 70 cm`, `front.waist_dart.depth = 11 cm`),\n"
    "an act to run it now (`drape until rest`, `expect strain(all) < 8%`, `save \"skirt.glb\"`),\n"
    "or a command. `it` is the last value. `:help NAME` tells of one statement, function or command.\n\n";

/// "a" and "a.b" for every name or member in the tree.
std::set<std::string> names_in(const Statement& statement) {
  std::set<std::string> names;
  for_each_expr(statement, [&](const grammar::Expr& expr) {
    const std::vector<std::string> path = path_of(expr);
    std::string name;
    for (std::size_t k = 0; k < std::min<std::size_t>(path.size(), 2); ++k) {
      name += (k > 0 ? "." : "") + path[k];
      names.insert(name);
    }
  });
  return names;
}

std::string title(const DeclaredThing& thing) { return thing.keyword + ' ' + thing.name; }

/// Statements that speak of `name`, as "seam side.left, place front".
std::vector<std::string> dependents(const interpreter::Interpretation& result, const std::string& name) {
  std::vector<std::string> found;
  auto add = [&](std::string text) {
    if (std::find(found.begin(), found.end(), text) == found.end()) found.push_back(std::move(text));
  };
  std::set<const Statement*> declaring;
  for (const DeclaredThing& thing : interpreter::declared_things(result)) {
    declaring.insert(thing.statement);
    if (thing.name != name && names_in(*thing.statement).contains(name)) add(title(thing));
  }
  for (const Statement& statement : result.script->statements) {
    if (declaring.contains(&statement) || !declared_name(statement).empty()) continue;
    if (!names_in(statement).contains(name)) continue;
    const bool assignment = statement.keyword.text == "=";
    std::string what = assignment ? "" : statement.keyword.text;
    if (!statement.operands.empty())
      for (const std::string& word : path_of(statement.operands[0]))
        what += (what.empty() ? "" : what == statement.keyword.text ? " " : ".") + word;
    add(assignment ? what + " = ..." : what);
  }
  return found;
}

std::string line_of(const Evaluated& evaluated, const Statement& statement) {
  return fmt::format("{}:{}", evaluated.sources[evaluated.source].name,
                     evaluated.sources.place(statement.span.source, statement.span.begin).line);
}

std::string short_value(const DeclaredThing& thing) {
  if (thing.value == nullptr) return "";
  const bool tells =
      interpreter::is_plain(*thing.value) || thing.value->as<interpreter::FabricValue>() != nullptr;
  return tells ? interpreter::show(*thing.value) : "";
}

}  // namespace

Answer Session::info(const std::string& name) {
  if (name.empty()) return refuse("G1502", "`:info` takes a name", "as in `:info front.waist`");
  const Entry entry = read_entry(name);
  if (entry.kind != EntryKind::expression)
    return refuse("G1502", fmt::format("`:info` takes a name, `{}` is none", name),
                  "as in `:info front.waist`");
  const interpreter::Interpretation& result = stage_.evaluated->result;
  const std::vector<DeclaredThing> things = interpreter::declared_things(result);
  const std::vector<std::string> path = path_of(entry.expr);
  const DeclaredThing* declared = nullptr;
  for (const DeclaredThing& thing : things) {
    const bool whole = thing.name == name;
    const bool root = !path.empty() &&
                      (thing.name == path[0] || (path.size() > 1 && thing.name == path[0] + '.' + path[1]));
    if (whole || (root && declared == nullptr)) declared = &thing;
  }
  Answer value = ask(entry);
  const std::string words = declared == nullptr ? interpreter::help_text(name) : "";
  if (value.outcome != Outcome::done && declared == nullptr && words.empty()) return value;
  std::string text = value.outcome == Outcome::done ? value.text : "";
  if (text.empty() && declared != nullptr) text = title(*declared) + '\n';
  if (declared != nullptr) {
    text += fmt::format("  declared as {} at {}\n", declared->keyword,
                        line_of(*stage_.evaluated, *declared->statement));
    if (!declared->statement->doc.empty()) text += "  ## " + declared->statement->doc + '\n';
    for (const interpreter::Parameter& p : result.parameters)
      if (p.name == declared->name && declared->keyword == "param")
        text += (p.range.empty() ? "" : "  allowed " + p.range + '\n') +
                (p.doc.empty() ? "" : "  " + p.doc + '\n');
    const std::vector<std::string> users = dependents(result, name);
    if (!users.empty()) {
      std::string list;
      for (std::size_t k = 0; k < std::min(users.size(), kMostDependents); ++k)
        list += (k > 0 ? ", " : "") + users[k];
      if (users.size() > kMostDependents) list += fmt::format(" and {} more", users.size() - kMostDependents);
      text += "  used by " + list + '\n';
    } else {
      text += "  nothing speaks of it\n";
    }
  }
  return {Outcome::done, text + words};
}

Answer Session::list(const std::string& filter) const {
  const std::vector<DeclaredThing> things = interpreter::declared_things(stage_.evaluated->result);
  std::size_t wide = 0, long_name = 0;
  auto shows = [&](const DeclaredThing& thing) {
    return filter.empty() || thing.keyword == filter || thing.name.find(filter) != std::string::npos;
  };
  for (const DeclaredThing& thing : things)
    if (shows(thing)) {
      wide = std::max(wide, thing.keyword.size());
      long_name = std::max(long_name, thing.name.size());
    }
  std::string text;
  for (const DeclaredThing& thing : things) {
    if (!shows(thing)) continue;
    std::string line =
        fmt::format("{:<{}}  {:<{}}  {}", thing.keyword, wide, thing.name, long_name, short_value(thing));
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  if (text.empty())
    text = filter.empty() ? "the script declares nothing yet\n"
                          : fmt::format("nothing is called or named `{}`\n", filter);
  return {Outcome::done, text};
}

Answer Session::text(const std::string& name) const {
  if (name.empty())
    return {Outcome::done,
            stage_.text.empty() || stage_.text.back() == '\n' ? stage_.text : stage_.text + '\n'};
  std::vector<std::string> names;
  for (const DeclaredThing& thing : interpreter::declared_things(stage_.evaluated->result)) {
    names.push_back(thing.name);
    if (thing.name == name)
      return {Outcome::done, std::string(stage_.evaluated->sources.text(thing.statement->span)) + '\n'};
  }
  return refuse("G0301", fmt::format("no statement of the script declares `{}`", name),
                interpreter::did_you_mean(name, names));
}

Answer Session::where() const {
  if (!stage_.modelled->model) return {Outcome::done, "no model\n"};
  const model::Model& model = *stage_.modelled->model;
  std::string text;
  if (stage_.shape.draped) {
    const simulator::DrapeReport& r = stage_.shape.report;
    text += fmt::format("{} after {} steps; residual {} of the weight; energy {} J\n",
                        results::status_name(r.status), r.steps, format_number(r.residual, 3),
                        format_number(r.energy, 6));
    const results::StrainReport strain = results::measure_strain(model, *stage_.shape.state);
    text +=
        fmt::format("largest strain {}%; {} self-intersections, {} with bodies, {} particles inside one\n",
                    format_number(100 * strain.all.any.largest, 3), r.self_intersections,
                    r.body_intersections, r.inside_body);
  } else {
    text += stage_.shape.carried ? "carried over from a drape, not at rest\n"
                                 : "not draped: the panels are at their places\n";
  }
  const std::size_t before = undo_.size(), after = redo_.size();
  text += fmt::format("state {} of {} particles; {} step{} to undo, {} to do again\n", state_hash(),
                      with_commas(model.n_particles()), before, before == 1 ? "" : "s", after);
  return {Outcome::done, text};
}

Answer Session::model() {
  dress();
  if (!stage_.modelled->model)
    return {Outcome::done,
            "no model" + std::string(stage_.modelled->diagnostics.empty() ? "" : "; `:warnings` says why") +
                '\n'};
  return {Outcome::done, model::summary_text(*stage_.modelled->model)};
}

Answer Session::warnings() const {
  const std::string text =
      shown(stage_.evaluated->result.diagnostics, stage_.evaluated->sources, Severity::warning) +
      shown(stage_.modelled->diagnostics, stage_.evaluated->sources, Severity::warning);
  return {Outcome::done, text.empty() ? "none\n" : text};
}

Answer Session::help(const std::string& name) const {
  if (!name.empty()) {
    const std::string bare = name[0] == ':' ? name.substr(1) : name;
    std::string text = name[0] == ':' ? "" : interpreter::help_text(name);
    if (text.empty())
      if (const SessionCommand* command = find_command(bare))
        text = fmt::format(":{} {}\n  {}\n", command->name, command->takes, command->doc);
    if (!text.empty()) return {Outcome::done, text.back() == '\n' ? text : text + '\n'};
    std::vector<std::string> names;
    for (const interpreter::ConstructRecord& record : interpreter::construct_table())
      names.emplace_back(record.keyword);
    for (const SessionCommand& command : session_commands()) names.emplace_back(command.name);
    return refuse("G1501", fmt::format("there is no help on `{}`", name),
                  interpreter::did_you_mean(name, names).empty()
                      ? "`:info` tells of what the script declares, `:help` lists all"
                      : interpreter::did_you_mean(name, names));
  }
  std::string text = kIntroduction;
  for (const SessionCommand& command : session_commands())
    text += fmt::format("  {:<24}{}\n", fmt::format(":{} {}", command.name, command.takes), command.doc);
  text += "\nstatements:";
  std::size_t column = 11;
  for (const interpreter::ConstructRecord& record : interpreter::construct_table()) {
    if (!record.supported || !record.top) continue;
    if (column + record.keyword.size() + 1 > 100) {
      text += "\n           ";
      column = 11;
    }
    text += ' ' + std::string(record.keyword);
    column += record.keyword.size() + 1;
  }
  return {Outcome::done, text + '\n'};
}

}  // namespace garment::session
