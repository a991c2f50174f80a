#include "interpreter/session/session.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "interpreter/session/entry.hpp"
#include "runtime/base/number.hpp"
#include "runtime/model/dump.hpp"

namespace garment::session {
namespace {

constexpr std::size_t kMostSteps = 500;         // that can be undone
constexpr std::size_t kMostBytes = 512u << 20;  // of the shapes kept for that
constexpr std::size_t kWhole = 6;  // steps whose models are kept; others are built again when needed

std::size_t shape_bytes(const Stage& stage) {
  return stage.shape.state ? 2 * stage.shape.state->position.size() * sizeof(Eigen::Vector3d) : 0;
}

}  // namespace

Session::Session(Host& host, SessionOptions options)
    : host_(host), options_(std::move(options)), workshop_{host, bodies_, "<session>", options_.stdlib_dir,
                                                           ".", options_.library_dirs, options_.allow_read} {
  stage_.evaluated = workshop_.evaluate("");
  stage_.modelled = std::make_shared<Modelled>();
}

Answer Session::open(const std::string& file) {
  HostResult<std::string> text = host_.read_file(file, kMaxScriptBytes);
  if (!text)
    return refuse("G0901", fmt::format("cannot read `{}`: {}", file, text.error.message), "check the path");
  const double begun = host_.seconds();
  const std::string folder = std::filesystem::path(file).parent_path().string();
  bodies_.forget();
  workshop_.name = file;
  workshop_.script_dir = folder.empty() ? "." : folder;
  file_ = file;
  saved_text_ = *text.value;
  undo_.clear();
  redo_.clear();
  it_.clear();
  it_text_.clear();
  stage_ = Stage{};
  stage_.text = std::move(*text.value);
  stage_.evaluated = workshop_.evaluate(stage_.text);
  stage_.modelled = std::make_shared<Modelled>(workshop_.build(*stage_.evaluated, {}));
  Answer answer;
  answer.text = shown(stage_.evaluated->result.diagnostics, stage_.evaluated->sources, Severity::warning) +
                shown(stage_.modelled->diagnostics, stage_.evaluated->sources, Severity::warning);
  const design::Garment& garment = stage_.evaluated->result.garment;
  if (stage_.modelled->model) {
    stage_.shape.state = start_state(*stage_.modelled->model);
    answer.text += fmt::format("{}: {} panels, {} seams, {} particles{}\n", file, garment.panels.size(),
                               garment.seams.size(), with_commas(stage_.modelled->model->n_particles()),
                               seconds_since(begun));
  } else if (!stage_.evaluated->result.ok() || stage_.modelled->failed) {
    answer.outcome = Outcome::refused;
    answer.text += fmt::format("{}: opened with errors; entries can mend it\n", file);
  } else {
    answer.text += fmt::format("{}: {} panels; no model yet\n", file, garment.panels.size());
  }
  return answer;
}

Answer Session::enter(const std::string& text) {
  Entry entry = read_entry(text);
  if (entry.kind == EntryKind::statements || entry.kind == EntryKind::broken)
    if (const std::string filled = with_it(entry); filled != text) entry = read_entry(filled);
  if (entry.kind != EntryKind::command) warned_of_edits_ = false;
  switch (entry.kind) {
    case EntryKind::nothing:
      return {};
    case EntryKind::command:
      return command(entry.text);
    case EntryKind::statements:
      return is_act(entry.script.statements.front()) ? act(entry) : change(entry);
    case EntryKind::expression:
      return ask(entry);
    case EntryKind::broken:
      return {Outcome::refused, shown(entry.diagnostics, entry.sources, Severity::error)};
  }
  return {};
}

bool Session::wants_more(const std::string& entry) const { return read_entry(entry).incomplete; }

std::string Session::state_hash() const {
  return stage_.shape.state ? model::hash_text(model::state_hash(*stage_.shape.state)) : "";
}

void Session::take(Stage stage) {
  undo_.push_back(std::move(stage_));
  stage_ = std::move(stage);
  redo_.clear();
  if (undo_.size() > kWhole) shed(undo_[undo_.size() - 1 - kWhole]);
  std::size_t bytes = 0;
  for (const Stage& old : undo_) bytes += shape_bytes(old);
  while (undo_.size() > kMostSteps || (bytes > kMostBytes && undo_.size() > 1)) {
    bytes -= shape_bytes(undo_.front());
    undo_.pop_front();
  }
}

/// What follows from the text is forgotten; the text and the shape are not.
void Session::shed(Stage& stage) {
  stage.evaluated = nullptr;
  stage.modelled = nullptr;
}

/// The model as it starts, where an edit of the hanging garment left that out.
void Session::dress() {
  if (stage_.modelled->model && !stage_.modelled->dressed)
    stage_.modelled = std::make_shared<Modelled>(workshop_.build(*stage_.evaluated, stage_.released));
}

Stage Session::restored(Stage stage) {
  if (!stage.evaluated) stage.evaluated = workshop_.evaluate(stage.text);
  if (!stage.modelled) stage.modelled = std::make_shared<Modelled>(workshop_.build(*stage.evaluated, stage.released));
  return stage;
}

std::string Session::shown(const grammar::Diagnostics& diagnostics, const grammar::Sources& sources,
                           Severity least) const {
  std::string text;
  for (const grammar::Diagnostic& d : diagnostics)
    if (d.severity == Severity::error || least != Severity::error) {
      text += grammar::render(d, sources, options_.color);
      if (text.back() != '\n') text += '\n';
    }
  return text;
}

std::string Session::fault(const std::string& code, const std::string& message,
                           const std::string& help) const {
  grammar::Diagnostic d;
  d.code = code;
  d.message = message;
  d.help = help;
  return shown({d}, grammar::Sources{}, Severity::error);
}

Answer Session::refuse(const std::string& code, const std::string& message, const std::string& help) const {
  return {Outcome::refused, fault(code, message, help)};
}

std::string Session::seconds_since(double begin) const {
  if (!options_.timing) return "";
  const double seconds = host_.seconds() - begin;
  return fmt::format(", {} s", format_number(std::round(seconds * 100) / 100));
}

std::string Session::out_folder() const {
  if (!options_.out.empty()) return options_.out;
  return file_.empty() ? "session" : std::filesystem::path(file_).stem().string();
}

}  // namespace garment::session
