// What the commands of the prompt do to the session.
#include <fmt/format.h>

#include <filesystem>

#include "interpreter/language/construct_table.hpp"
#include "interpreter/session/commands.hpp"
#include "interpreter/session/line_diff.hpp"
#include "runtime/base/number.hpp"
#include "runtime/base/parallel.hpp"
#include "runtime/render/pictures.hpp"

namespace garment::session {
namespace {

constexpr int kMostThreads = 256, kMostStepsOfADrape = 1'000'000;

std::string trimmed(const std::string& text) {
  const std::size_t a = text.find_first_not_of(" \t\r\n"), b = text.find_last_not_of(" \t\r\n");
  return a == std::string::npos ? "" : text.substr(a, b - a + 1);
}

/// A file name, with or without quotes.
std::string file_argument(const std::string& text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') return text.substr(1, text.size() - 2);
  return text;
}

std::optional<int> count_argument(const std::string& text, int most) {
  const auto number = parse_number(text);
  if (!number || !(*number >= 1) || *number > most || *number != static_cast<int>(*number))
    return std::nullopt;
  return static_cast<int>(*number);
}

std::string first_line(const std::string& text) {
  const std::size_t end = text.find('\n');
  return end == std::string::npos ? text : text.substr(0, end) + " ...";
}

}  // namespace

Answer Session::command(const std::string& line) {
  const std::string text = trimmed(line);
  const std::size_t blank = text.find_first_of(" \t");
  const std::string name = text.substr(0, blank);
  const std::string argument = blank == std::string::npos ? "" : trimmed(text.substr(blank));
  const SessionCommand* found = find_command(name);
  if (found == nullptr) {
    std::vector<std::string> names;
    for (const SessionCommand& c : session_commands()) names.emplace_back(c.name);
    std::string help = interpreter::did_you_mean(name, names);
    if (!help.empty()) help = "did you mean `:" + interpreter::nearest_name(name, names) + "`?";
    return refuse("G1501", fmt::format("there is no command `:{}`", name),
                  help.empty() ? "`:help` lists them" : help);
  }
  if (found->takes.empty() && !argument.empty())
    return refuse("G1502", fmt::format("`:{}` takes nothing, `{}` was given", found->name, argument), "");
  return found->run(*this, argument);
}

Answer Session::undo(int steps) {
  if (undo_.empty()) return refuse("G1505", "there is nothing to undo", "");
  Answer answer;
  for (int k = 0; k < steps && !undo_.empty(); ++k) {
    answer.text += fmt::format("undone: {}\n", first_line(stage_.entry));
    redo_.push_back(std::move(stage_));
    stage_ = std::move(undo_.back());
    undo_.pop_back();
  }
  stage_ = restored(std::move(stage_));
  return answer;
}

Answer Session::redo(int steps) {
  if (redo_.empty())
    return refuse("G1505", "there is nothing to do again",
                  "an entry that changes something forgets what was undone");
  Answer answer;
  for (int k = 0; k < steps && !redo_.empty(); ++k) {
    undo_.push_back(std::move(stage_));
    stage_ = std::move(redo_.back());
    redo_.pop_back();
    answer.text += fmt::format("done again: {}\n", first_line(stage_.entry));
  }
  stage_ = restored(std::move(stage_));
  return answer;
}

Answer Session::diff() const {
  const std::string name = file_.empty() ? "<session>" : file_;
  const std::string text = unified_diff(saved_text_, stage_.text, name, name + " (edited)");
  return {Outcome::done, text.empty() ? "no difference\n" : text};
}

Answer Session::save(std::string file, bool force) {
  const bool own = file.empty() || file == file_;
  if (file.empty()) file = file_;
  if (file.empty())
    return refuse("G1506", "the script has no file yet", "give it one: `:save skirt.garment`");
  const HostResult<std::string> there = host_.read_file(file, kMaxScriptBytes);
  if (!force && there && own && *there.value != saved_text_)
    return refuse(
        "G1507", fmt::format("`{}` was changed by someone else since it was read", file),
        "`:save! FILE` writes over it, `:reload` reads it and forgets your edits, `:diff` shows them");
  if (!force && there && !own)
    return refuse("G1507", fmt::format("`{}` exists already", file),
                  fmt::format("`:save! {}` writes over it", file));
  if (const HostResult<bool> written = host_.write_file(file, stage_.text); !written)
    return {Outcome::failed,
            fault("G0902", fmt::format("cannot write `{}`: {}", file, written.error.message), "")};
  saved_text_ = stage_.text;
  file_ = file;
  return {Outcome::done, fmt::format("wrote {}\n", file)};
}

Answer Session::remove(const std::string& name) {
  if (name.empty())
    return refuse("G1502", "`:remove` takes the name of a declaration", "as in `:remove side_left`");
  Patch patch(stage_.text);
  if (!remove_statement(patch, name)) {
    std::vector<std::string> names;
    for (const interpreter::DeclaredThing& thing : interpreter::declared_things(stage_.evaluated->result))
      names.push_back(thing.name);
    return refuse("G0301", fmt::format("no statement of the script declares `{}`", name),
                  interpreter::did_you_mean(name, names));
  }
  Answer answer = commit(std::move(patch), ":remove " + name, {});
  if (answer.outcome != Outcome::refused) answer.text = fmt::format("removed {}\n", name) + answer.text;
  return answer;
}

/// The panels at their places, every pin and clamp held.
void Session::start_again(const std::string& entry) {
  dress();
  Stage fresh = stage_;
  fresh.entry = entry;
  if (!fresh.released.empty()) {
    fresh.released.clear();
    fresh.modelled = std::make_shared<Modelled>(workshop_.build(*fresh.evaluated, {}));
  }
  fresh.shape = {start_state(*fresh.modelled->model), {}, simulator::Settle::equilibrium, false, false};
  take(std::move(fresh));
}

Answer Session::run_script() {
  if (!stage_.modelled->model)
    return refuse("G1504", "there is no model to drape or ask", "`:warnings` says why");
  if (stage_.evaluated->result.acts.empty())
    return refuse("G1504", "the script has no acts", "type `drape until rest`");
  start_again(acts_entry_ = ":run");
  const std::size_t steps = undo_.size();
  const std::shared_ptr<Evaluated> evaluated = stage_.evaluated;
  const Answer answer = run_acts(*evaluated, evaluated->result.acts);
  while (undo_.size() > steps) undo_.pop_back();  // one step to undo, however many drapes
  return answer;
}

Answer Session::reset_shape() {
  if (!stage_.modelled->model) return refuse("G1504", "there is no model", "`:warnings` says why");
  start_again(":reset");
  return {Outcome::done, "the panels are back at their places\n"};
}

Answer Session::view(std::string file) {
  if (!stage_.modelled->model) return refuse("G1504", "there is no model to show", "`:warnings` says why");
  if (file.empty()) file = (std::filesystem::path(out_folder()) / "view.png").string();
  if (std::filesystem::path(file).extension() != ".png")
    return refuse("G1502", fmt::format("`:view` writes a picture, `{}` does not end in .png", file), "");
  const std::string bytes = render::render_sheet(
      render::make_scene(*stage_.modelled->model, *stage_.shape.state, stage_.evaluated->result.bodies));
  if (const HostResult<bool> written = host_.write_file(file, bytes); !written)
    return {Outcome::failed,
            fault("G0902", fmt::format("cannot write `{}`: {}", file, written.error.message), "")};
  return {Outcome::done, fmt::format("wrote {}\n", file)};
}

std::vector<std::string> setting_names() { return {"auto", "steps", "threads"}; }

Answer Session::settings() const {
  return {Outcome::done, fmt::format("auto {}      drape again after an edit\nsteps {}    at most, of one "
                                     "drape (0: the simulator's own limit)\n"
                                     "threads {}  (results do not depend on it)\n",
                                     automatic_ ? "on " : "off", options_.max_steps,
                                     options_.timing ? std::to_string(thread_count()) : "N")};
}

Answer Session::set(const std::string& name, const std::string& value) {
  if (name == "auto") {
    if (value != "on" && value != "off")
      return refuse("G1502", fmt::format("`:set auto` takes on or off, `{}` was given", value), "");
    automatic_ = value == "on";
    return {Outcome::done, fmt::format("auto {}\n", value)};
  }
  if (name != "threads" && name != "steps")
    return refuse("G1502", fmt::format("there is no setting `{}`", name),
                  interpreter::did_you_mean(name, setting_names()).empty()
                      ? "`:set` lists them"
                      : interpreter::did_you_mean(name, setting_names()));
  const int most = name == "threads" ? kMostThreads : kMostStepsOfADrape;
  const auto count = count_argument(value, most);
  if (!count)
    return refuse(
        "G1502",
        fmt::format("`:set {}` takes a whole number from 1 to {}, `{}` was given", name, most, value), "");
  if (name == "threads")
    set_thread_count(*count);
  else
    options_.max_steps = *count;
  return {Outcome::done, fmt::format("{} {}\n", name, *count)};
}

const std::vector<SessionCommand>& session_commands() {
  static const std::vector<SessionCommand> commands = {
      {"help", "[NAME]", "what a word of the language, a command or all of this does",
       [](Session& s, const std::string& a) { return s.help(a); }},
      {"info", "NAME", "what a name means now: value, length, place, what depends on it",
       [](Session& s, const std::string& a) { return s.info(a); }},
      {"list", "[KIND | NAME]", "what the script declares",
       [](Session& s, const std::string& a) { return s.list(a); }},
      {"text", "[NAME]", "the script, or the statement that declares a name",
       [](Session& s, const std::string& a) { return s.text(a); }},
      {"warnings", "", "what is said against the script as it stands",
       [](Session& s, const std::string&) { return s.warnings(); }},
      {"model", "", "counts, mass, areas and lengths of the particle model",
       [](Session& s, const std::string&) { return s.model(); }},
      {"where", "", "how the garment hangs: steps, residual, strain, hash of the state",
       [](Session& s, const std::string&) { return s.where(); }},
      {"run", "", "runs the acts of the script from the placed panels",
       [](Session& s, const std::string&) { return s.run_script(); }},
      {"reset", "", "takes the garment back to the places of its panels",
       [](Session& s, const std::string&) { return s.reset_shape(); }},
      {"view", "[FILE.png]", "draws the garment as it hangs and says where the picture is",
       [](Session& s, const std::string& a) { return s.view(file_argument(a)); }},
      {"undo", "[N]", "takes back the last step: text, model and shape",
       [](Session& s, const std::string& a) { return s.step(a, true); }},
      {"redo", "[N]", "does again what was undone",
       [](Session& s, const std::string& a) { return s.step(a, false); }},
      {"remove", "NAME", "takes a declaration out of the script",
       [](Session& s, const std::string& a) { return s.remove(a); }},
      {"diff", "", "your edits, against the file", [](Session& s, const std::string&) { return s.diff(); }},
      {"save", "[FILE]", "writes the script; only what you edited differs",
       [](Session& s, const std::string& a) { return s.save(file_argument(a), false); }},
      {"save!", "[FILE]", "the same, over whatever is there",
       [](Session& s, const std::string& a) { return s.save(file_argument(a), true); }},
      {"load", "FILE", "opens another script",
       [](Session& s, const std::string& a) { return s.load(file_argument(a)); }},
      {"reload", "", "reads the file again; edits that were not saved are forgotten",
       [](Session& s, const std::string&) { return s.reload(); }},
      {"set", "[NAME VALUE]", "settings: auto on | off, steps N, threads N",
       [](Session& s, const std::string& a) {
         const std::size_t blank = a.find_first_of(" \t");
         if (a.empty()) return s.settings();
         return s.set(a.substr(0, blank), blank == std::string::npos ? "" : trimmed(a.substr(blank)));
       }},
      {"quit", "", "leaves",
       [](Session&, const std::string&) {
         return Answer{Outcome::leave, ""};
       }},
  };
  return commands;
}

const SessionCommand* find_command(std::string_view name) {
  const SessionCommand* found = nullptr;
  for (const SessionCommand& command : session_commands()) {
    if (command.name == name) return &command;
    if (name.empty() || command.name.substr(0, name.size()) != name || command.name.back() == '!') continue;
    if (found != nullptr) return nullptr;
    found = &command;
  }
  return found;
}

Answer Session::step(const std::string& argument, bool back) {
  const auto count = argument.empty() ? std::optional(1) : count_argument(argument, 1000);
  if (!count)
    return refuse("G1502",
                  fmt::format("`:{}` takes a number of steps from 1 to 1000, `{}` was given",
                              back ? "undo" : "redo", argument),
                  "");
  return back ? undo(*count) : redo(*count);
}

Answer Session::load(const std::string& file) {
  if (file.empty())
    return refuse("G1502", "`:load` takes the name of a script", "as in `:load skirt.garment`");
  if (unsaved() && !warned_of_edits_) {
    warned_of_edits_ = true;
    return refuse("G1508", "there are edits that were not saved",
                  "`:save` keeps them; the same command again forgets them");
  }
  warned_of_edits_ = false;
  return open(file);
}

Answer Session::reload() {
  if (file_.empty()) return refuse("G1506", "the script has no file yet", "`:load FILE` opens one");
  return load(file_);
}

}  // namespace garment::session
