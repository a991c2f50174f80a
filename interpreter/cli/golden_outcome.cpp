#include "interpreter/cli/golden_outcome.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "interpreter/cli/modelling.hpp"
#include "interpreter/cli/project.hpp"
#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/interpret.hpp"
#include "interpreter/language/modelling.hpp"
#include "interpreter/language/script_values.hpp"
#include "interpreter/session/drape_act.hpp"
#include "interpreter/session/drape_answers.hpp"
#include "runtime/base/number.hpp"
#include "runtime/model/dump.hpp"
#include "runtime/modeller/unmodelled.hpp"
#include "runtime/results/report.hpp"
#include "runtime/simulator/moved_bodies.hpp"

namespace garment::cli {
namespace {

void add(grammar::Diagnostics& all, grammar::Diagnostics more) {
  for (grammar::Diagnostic& d : more) all.push_back(std::move(d));
}

/// Is any of those from `first` on an error?
bool has_error(const grammar::Diagnostics& diagnostics, std::size_t first) {
  for (std::size_t k = first; k < diagnostics.size(); ++k)
    if (diagnostics[k].severity == Severity::error) return true;
  return false;
}

/// Drapes the model and answers the script's questions, in the order of the script.
class GoldenRun {
 public:
  GoldenRun(GoldenOutcome& outcome, interpreter::Interpretation& script, model::Model& model, Host& host)
      : outcome_(outcome),
        first_(outcome.diagnostics.size()),
        script_(script),
        model_(model),
        host_(host),
        holding_(script.garment),
        bodies_(script.bodies),
        recorder_(script, model, [](const std::string&, const std::string&) {}) {
    state_.position = model.start;
    state_.velocity.assign(model.n_particles(), Eigen::Vector3d::Zero());
  }

  void perform() {
    for (const interpreter::Act& act : script_.acts) {
      if (has_error(outcome_.diagnostics, first_) || host_.interrupted()) return;
      if (const auto* drape = std::get_if<interpreter::DrapeAct>(&act.act)) this->drape(*drape, act.span);
      if (const auto* release = std::get_if<interpreter::ReleaseAct>(&act.act))
        add(outcome_.diagnostics, interpreter::to_diagnostics(session::let_go(*release, bodies_, holding_, model_), script_.origins));
      if (const auto* record = std::get_if<interpreter::RecordAct>(&act.act)) recorder_.add(*record);
      const bool asks = std::holds_alternative<interpreter::ExpectAct>(act.act) ||
                        (std::holds_alternative<interpreter::MeasureAct>(act.act) && !measures_in_rounds(script_.acts));
      if (asks && !draped_)
        refuse("G0325", "stands before any `drape`, so there is nothing to ask", "write `drape until rest` above it", act.span);
      else if (asks)
        answer(act);
    }
  }

 private:
  void refuse(const char* code, const char* message, const char* help, grammar::Span span) {
    grammar::Diagnostic d = plain_error(code, message, help);
    d.labels.push_back({span, ""});
    outcome_.diagnostics.push_back(std::move(d));
  }

  void drape(const interpreter::DrapeAct& act, grammar::Span span) {
    session::DrapeScene scene{script_, bodies_, model_, draped_, {}, &recorder_};
    scene.settings.interrupted = [this] { return host_.interrupted(); };
    const double begun = host_.seconds();
    report_ = session::perform_drape(act, scene, state_);
    if (!model_.motions.empty()) script_.bodies = simulator::bodies_at(bodies_, model_, state_.time);
    add(outcome_.diagnostics, recorder_.take_diagnostics());
    outcome_.drape_seconds += host_.seconds() - begun;
    draped_ = true;
    add(outcome_.diagnostics, session::told_by(report_, script_, span));
    outcome_.text += fmt::format("drape: {}\n", results::status_name(report_.status));
  }

  void answer(const interpreter::Act& act) {
    session::DrapeAnswers answers(script_.garment, script_.bodies, model_, state_, report_, &recorder_);
    if (std::holds_alternative<interpreter::ExpectAct>(act.act)) {
      interpreter::ExpectResult r = interpreter::evaluate_expect(script_, act, answers);
      ++outcome_.n_expects;
      outcome_.text += fmt::format("expect {}: {}, {}\n", r.text, r.found, r.passed ? "holds" : "does not hold");
      return add(outcome_.diagnostics, std::move(r.diagnostics));
    }
    interpreter::MeasureResult r = interpreter::evaluate_measure(script_, act, answers);
    outcome_.text += fmt::format("measure {}: {}\n", r.measure.name, r.measure.text);
    outcome_.values[outcome_.sources.place(act.span.source, act.span.begin).line] = r.measure.text;
    add(outcome_.diagnostics, std::move(r.diagnostics));
  }

  GoldenOutcome& outcome_;
  std::size_t first_;  // of the diagnostics, that is this round's
  interpreter::Interpretation& script_;
  model::Model& model_;
  Host& host_;
  design::Garment holding_;         // less what was released
  std::vector<body::Body> bodies_;  // at time 0
  session::Recorder recorder_;
  model::State state_;
  simulator::DrapeReport report_;
  bool draped_ = false;
};

/// A script, or with a `study` one round of it, of which only what goes wrong is told.
void interpret_golden(GoldenOutcome& o, const std::string& path, grammar::SourceId id, GoldenStage stage,
                      const GoldenLibraries& libraries, Host& host, const std::optional<interpreter::Study>& study = {}) {
  interpreter::InterpretOptions options;
  options.stdlib_dir = libraries.stdlib_dir;
  options.library_dirs = libraries.before;
  options.script_dir = folder_of(path);
  options.warn_unused = !study;
  options.study = study;
  interpreter::Interpretation result = interpreter::interpret(o.sources, id, host, options);
  const std::size_t first = o.diagnostics.size();  // a round that fails keeps no other from its drape
  if (!study || !result.ok()) add(o.diagnostics, result.diagnostics);
  if (!result.ok()) return;
  if (!study) o.values = interpreter::values_by_line(result, o.sources);
  modeller::ModelResult built;
  if (stage == GoldenStage::check) built.findings = modeller::find_unmodelled(result.garment, Severity::warning);
  if (built.findings.empty()) built = interpreter::model_of(result.garment, result.bodies, result.acts);
  if (!study || !built.model) add(o.diagnostics, interpreter::to_diagnostics(built.findings, result.origins));
  if (built.model && stage == GoldenStage::model) o.text = model::summary_text(*built.model);
  if (built.model && stage == GoldenStage::run && !has_error(o.diagnostics, first)) {
    if (study) o.text += fmt::format("{} = {}\n", study->target, study->value);
    for (const interpreter::MeasureValue& m : result.measures) o.text += fmt::format("measure {}: {}\n", m.name, m.text);
    GoldenRun(o, result, *built.model, host).perform();
    for (const interpreter::Act& act : study ? std::vector<interpreter::Act>{} : result.acts)
      if (const auto* vary = std::get_if<interpreter::VaryAct>(&act.act))
        for (const std::string& value : vary->values) {
          if (host.interrupted()) return;
          const std::size_t before = o.diagnostics.size();
          interpret_golden(o, path, id, stage, libraries, host, interpreter::Study{vary->ordinal, vary->target, value});
          for (std::size_t k = before; k < o.diagnostics.size(); ++k)  // all rounds speak of the same lines
            o.diagnostics[k].message += fmt::format(", in the round {} = {}", vary->target, value);
        }
  }
}

}  // namespace

bool has_drape(const std::string& script) {
  grammar::Sources sources;
  const grammar::SourceId id = sources.add("script", script);
  for (const grammar::Statement& s : grammar::parse(sources, id, interpreter::vocabulary()).script.statements) {
    if (s.keyword.text == "drape") return true;
    if (s.keyword.text != "vary" || !s.body) continue;
    for (const grammar::Statement& act : *s.body)
      if (act.keyword.text == "drape") return true;
  }
  return false;
}

GoldenOutcome run_golden(const std::string& path, const std::string& script, GoldenStage stage,
                         const GoldenLibraries& libraries, Host& host) {
  GoldenOutcome o;
  const grammar::SourceId id = o.sources.add(std::filesystem::path(path).filename().string(), script);
  if (stage == GoldenStage::parse) {
    grammar::ParseResult parsed = grammar::parse(o.sources, id, interpreter::vocabulary());
    o.diagnostics = std::move(parsed.diagnostics);
    o.text = grammar::to_outline(parsed.script);
  } else if (stage == GoldenStage::format) {
    grammar::FormatResult formatted = grammar::format(o.sources, id, interpreter::vocabulary());
    o.diagnostics = std::move(formatted.diagnostics);
    if (o.diagnostics.empty()) o.text = std::move(formatted.text);
  } else {
    interpret_golden(o, path, id, stage, libraries, host);
  }
  for (const grammar::Diagnostic& d : o.diagnostics) o.text += grammar::render(d, o.sources, false);
  return o;
}

}  // namespace garment::cli
