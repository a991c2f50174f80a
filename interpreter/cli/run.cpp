#include "interpreter/cli/run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "interpreter/cli/modelling.hpp"
#include "interpreter/cli/outputs.hpp"
#include "interpreter/cli/run_state.hpp"
#include "interpreter/cli/run_summary.hpp"
#include "interpreter/cli/study.hpp"
#include "interpreter/session/drape_act.hpp"
#include "interpreter/session/drape_answers.hpp"
#include "runtime/base/hash.hpp"
#include "runtime/base/number.hpp"
#include "runtime/modeller/holds.hpp"
#include "runtime/modeller/modeller.hpp"
#include "runtime/results/report.hpp"
#include "runtime/simulator/moved_bodies.hpp"

namespace garment::cli {
namespace {

/// Adds up the wall time of the phases of a run.
class Stopwatch {
 public:
  Stopwatch(Host& host, std::vector<results::PhaseTime>& phases) : host_(host), phases_(phases), last_(host.seconds()) {}
  double lap(const char* phase) {
    double now = host_.seconds(), taken = now - last_;
    phases_.push_back({phase, taken});
    last_ = now;
    return taken;
  }

 private:
  Host& host_;
  std::vector<results::PhaseTime>& phases_;
  double last_;
};

void fill_sources(results::Report& report, const Project& project) {
  for (std::size_t i = 0; i < project.sources.size(); ++i) {
    const grammar::Source& s = project.sources[static_cast<grammar::SourceId>(i)];
    std::string name = s.name.substr(s.name.find_last_of('/') + 1);
    (i == project.source ? report.sources : report.library).push_back({name, sha256(s.text)});
  }
  for (const interpreter::SolvedValue& s : project.result.solved)
    report.solves.push_back({s.name, s.value, s.residual_value, s.text, s.residual, s.bound});
  for (const interpreter::Parameter& p : project.result.parameters) report.parameters.push_back({p.name, p.value, p.given});
}

ExitCode exit_code_of(simulator::DrapeStatus status) {
  switch (status) {
    case simulator::DrapeStatus::at_rest:
    case simulator::DrapeStatus::ran: return kOk;
    case simulator::DrapeStatus::interrupted: return kInterrupted;
    case simulator::DrapeStatus::not_settled:
    case simulator::DrapeStatus::tangled:
    case simulator::DrapeStatus::diverged: return kSimulationFailed;
    case simulator::DrapeStatus::not_resumed: return kInputOutput;
  }
  return kSimulationFailed;
}

/// A drape that failed leaves the state that it came to.
void name_last_state(grammar::Diagnostics& told, const RunOptions& options, const std::string& folder) {
  for (grammar::Diagnostic& d : told)
    if (d.severity == Severity::error)
      d.message += fmt::format("; how the garment lies then is written to `{}/garment.obj`{}", folder,
                               options.pictures ? fmt::format(" and `{}/drape.png`", folder) : "");
}

/// One run under way; each act of the script is one call.
struct Run {
  const RunOptions& options;
  Host& host;
  Terminal& terminal;
  Project& project;
  model::Model& model;
  OutputFolder& out;
  results::Report& report;
  design::Garment holding;  ///< less what was released
  std::vector<body::Body> bodies;  ///< at time 0; the project's are where they are now
  session::Recorder recorder;
  RunCheckpoints& checkpoints;
  std::size_t at = 0;       ///< act at hand
  std::string resume{};     ///< of the first drape: what its simulator goes on from
  model::State begun{};     ///< where the drape at hand began
  model::State state{};
  bool draped = false;
  ExitCode code = kOk;

  void drape(const interpreter::DrapeAct& act, grammar::Span span) {
    session::DrapeScene scene{project.result, bodies, model, draped, {}, &recorder};
    if (options.max_steps > 0) scene.settings.max_steps = options.max_steps;
    scene.settings.self_collision = options.self_collision;
    scene.settings.progress = [this](const simulator::DrapeProgress& p) { terminal.progress(p, host); };
    scene.settings.interrupted = [this] { return host.interrupted(); };
    scene.settings.checkpoints.resume = resume;
    begun = state;
    if (checkpoints.writes()) {
      scene.settings.checkpoints.due = [this] { return checkpoints.due(); };
      scene.settings.checkpoints.keep = [this](const std::string& drape_state) { keep_drape(drape_state); };
    }
    report.settle = act.settle;
    report.drape = session::perform_drape(act, scene, state);
    resume.clear();
    terminal.end_progress();
    draped = true;
    if (!model.motions.empty()) project.result.bodies = simulator::bodies_at(bodies, model, state.time);
    if (grammar::Diagnostics troubles = recorder.take_diagnostics(); !troubles.empty()) {
      show(troubles, project.sources, terminal);
      code = kDiagnostics;
    }
    grammar::Diagnostics told = session::told_by(report.drape, project.result, span);
    const ExitCode came_to = exit_code_of(report.drape.status);
    if (came_to == kSimulationFailed) name_last_state(told, options, out.folder());
    show(told, project.sources, terminal);
    code = std::max(code, came_to);
    if (code == kOk && session::rests_otherwise(report.drape)) code = kExpectFailed;
  }

  /// What the acts before the drape at hand have left, in a checkpoint. A release is made again.
  void keep(Archive& a) {
    a.keep(at);
    a.demand(at < project.result.acts.size());
    if (!a.ok() || !std::holds_alternative<interpreter::DrapeAct>(project.result.acts[at].act)) return a.refuse();
    if (a.reading()) catch_up();
    a.keep(draped);
    auto so_far = static_cast<std::int32_t>(code);  // a `save` or an `expect` that failed does not end a run
    a.keep(so_far);
    a.demand(so_far == kOk || so_far == kInputOutput || so_far == kExpectFailed);
    cli::keep(a, begun, model.n_particles());
    keep_answers(a, report);
    recorder.keep(a);
    out.keep(a);
    if (!a.reading() || !a.ok()) return;
    state = begun;
    code = std::max(code, static_cast<ExitCode>(so_far));
    if (draped && !model.motions.empty()) project.result.bodies = simulator::bodies_at(bodies, model, state.time);
  }

  /// What the acts before mean for those that come: what is released, recorded, and the rounds of studies.
  void catch_up() {
    for (std::size_t k = 0; k < at; ++k) {
      const interpreter::Act& before = project.result.acts[k];
      if (auto* release_act = std::get_if<interpreter::ReleaseAct>(&before.act)) release(*release_act);
      if (auto* record = std::get_if<interpreter::RecordAct>(&before.act)) recorder.add(*record);
      if (auto* vary = std::get_if<interpreter::VaryAct>(&before.act)) add_rounds(*vary);
    }
  }
  void add_rounds(const interpreter::VaryAct& vary) {
    for (const std::string& folder : round_folders(vary, out.folder())) checkpoints.add_round(folder);
  }

  /// A record that went wrong is told after the drape: from then on nothing is kept.
  void keep_drape(const std::string& drape_state) {
    if (recorder.troubled()) return;
    Archive a;
    keep(a);
    checkpoints.write(a.take() + drape_state);
  }

  /// Goes to where the checkpoint was written; false where it is none of this run (told).
  bool go_to(const std::string& kept) {
    Archive a(kept);
    keep(a);
    resume = std::string(a.rest());
    if (a.ok() && !resume.empty()) {
      terminal.note(fmt::format("going on from a checkpoint, in act {} of {}", at + 1, project.result.acts.size()));
      return true;
    }
    show({plain_error("G0810", "the checkpoint holds no state that this run could have been in", "run it from the start, without `--resume`")},
         project.sources, terminal);
    return false;
  }

  void release(const interpreter::ReleaseAct& act) {
    const Findings findings = session::let_go(act, bodies, holding, model);
    if (findings.empty()) return;
    show(interpreter::to_diagnostics(findings, project.result.origins), project.sources, terminal);
    code = kDiagnostics;
  }

  void expect(const interpreter::Act& act) {
    session::DrapeAnswers answers(project.result.garment, project.result.bodies, model, state, report.drape, &recorder);
    interpreter::ExpectResult r = interpreter::evaluate_expect(project.result, act, answers);
    show(r.diagnostics, project.sources, terminal);
    report.expects.push_back({r.text, r.value, r.found, r.expected, r.passed});
    if (!r.passed && code == kOk) code = kExpectFailed;
  }

  void keep_measure(const interpreter::MeasureValue& m) {
    report.stated_measures.push_back({m.name, m.value, m.unit, m.text});
  }

  void measure(const interpreter::Act& act) {
    if (!draped) return;  // of the rounds of a study
    session::DrapeAnswers answers(project.result.garment, project.result.bodies, model, state, report.drape, &recorder);
    interpreter::MeasureResult r = interpreter::evaluate_measure(project.result, act, answers);
    show(r.diagnostics, project.sources, terminal);
    if (!r.diagnostics.empty()) code = kDiagnostics;
    if (!r.measure.text.empty()) keep_measure(r.measure);
  }
};

/// Options that a drape depends on; threads, pictures and papers are none.
Identity options_of_drapes(const RunOptions& options) {
  return {{"`--max-steps`", options.max_steps > 0 ? std::to_string(options.max_steps) : "left out"},
          {"`--no-self-collision`", options.self_collision ? "left out" : "given"}};
}

void perform(Run& run) {
  const std::vector<interpreter::Act>& acts = run.project.result.acts;
  for (; run.at < acts.size(); ++run.at) {
    if (run.code == kInterrupted || run.code == kSimulationFailed || run.code == kDiagnostics) break;
    if (run.report.drape.status == simulator::DrapeStatus::not_resumed) break;
    const interpreter::Act& act = acts[run.at];
    if (auto* drape = std::get_if<interpreter::DrapeAct>(&act.act)) run.drape(*drape, act.span);
    if (std::holds_alternative<interpreter::ExpectAct>(act.act)) run.expect(act);
    if (std::holds_alternative<interpreter::MeasureAct>(act.act)) run.measure(act);
    if (auto* release = std::get_if<interpreter::ReleaseAct>(&act.act)) run.release(*release);
    if (auto* record = std::get_if<interpreter::RecordAct>(&act.act)) run.recorder.add(*record);
    if (auto* vary = std::get_if<interpreter::VaryAct>(&act.act)) {
      run.add_rounds(*vary);
      run.code = std::max(run.code, run_study(run.options, *vary, run.out.folder(), run.host, run.terminal));
    }
    if (auto* save = std::get_if<interpreter::SaveAct>(&act.act))
      for (const std::string& name : save->paths)
        if (!save_file(name, run.project, run.model, run.state, run.out, run.options.paper, run.terminal)) run.code = kInputOutput;
  }
}

}  // namespace

ExitCode run_script(const RunOptions& options, results::Report& report, bool& reported, Host& host, Terminal& terminal) {
  Stopwatch watch(host, report.phases);
  Project project;
  ProjectOptions wanted = options.project;
  wanted.worn = true;
  if (ExitCode code = load(project, wanted, host, terminal); code != kOk) return code;
  watch.lap("evaluate");
  // A question before any drape would be answered from the flat start, and pass.
  if (!check_acts(project, terminal)) return kDiagnostics;
  std::optional<model::Model> model = build_model(project, terminal);
  if (!model) return kDiagnostics;
  watch.lap("model");

  OutputFolder out(options.out.empty() ? project.name : options.out, host, terminal, options.project.allow_write);
  session::Recorder recorder(project.result, *model, [&out](const std::string& name, const std::string& bytes) { out.write(name, bytes); });
  RunCheckpoints checkpoints(options.checkpoints, out.folder(), out.granted(), host, terminal);
  Run under_way{options, host, terminal, project, *model, out, report, project.result.garment, project.result.bodies, std::move(recorder), checkpoints};
  under_way.state.position = model->start;
  under_way.state.velocity.assign(model->n_particles(), Eigen::Vector3d::Zero());
  for (const interpreter::MeasureValue& m : project.result.measures) under_way.keep_measure(m);
  std::string kept;
  if (!checkpoints.begin(identity_of(project, options.project, *model, options_of_drapes(options)), kept)) return kInputOutput;
  if (is_ended_round(kept)) {
    ExitCode code = kOk;
    reported = read_ended_round(kept, code, report);
    return reported ? code : kInputOutput;
  }
  if (!kept.empty() && !under_way.go_to(kept)) return kInputOutput;
  perform(under_way);
  if (report.drape.status == simulator::DrapeStatus::not_resumed) return kInputOutput;
  watch.lap("drape");

  write_results({out.folder(), options.pictures, options.ply}, project, *model, under_way.state, out);
  watch.lap("write");
  report.title = project.result.garment.title;
  report.script = project.name;
  fill_sources(report, project);
  results::fill_results(report, *model, under_way.state, project.result.bodies);
  report.outputs = out.files();
  report.peak_memory = host.peak_memory();
  out.write("report.json", results::report_json(report));
  reported = true;
  summarise(report, out.folder(), under_way.draped, terminal);
  const ExitCode code = out.failed() ? kInputOutput : under_way.code;
  if (code == kInterrupted && checkpoints.any()) terminal.note("interrupted: --resume goes on from here");
  if (code != kInterrupted && options.project.study) checkpoints.write(ended_round(code, report));
  if (code != kInterrupted && !options.project.study) checkpoints.finish();
  return code;
}

ExitCode run(const RunOptions& options, Host& host, Terminal& terminal) {
  results::Report report;
  bool reported = false;
  terminal.keep_diagnostics();
  const ExitCode code = run_script(options, report, reported, host, terminal);
  if (terminal.options().json) terminal.document(reported ? results::report_json(report) : "");
  return code;
}

}  // namespace garment::cli
