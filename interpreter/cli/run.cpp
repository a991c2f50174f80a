#include "interpreter/cli/run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "interpreter/cli/modelling.hpp"
#include "interpreter/cli/outputs.hpp"
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
  }
  return kSimulationFailed;
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
  model::State state{};
  bool draped = false;
  ExitCode code = kOk;

  void drape(const interpreter::DrapeAct& act, grammar::Span span) {
    session::DrapeScene scene{project.result, bodies, model, draped, {}, &recorder};
    if (options.max_steps > 0) scene.settings.max_steps = options.max_steps;
    scene.settings.progress = [this](const simulator::DrapeProgress& p) { terminal.progress(p, host); };
    scene.settings.interrupted = [this] { return host.interrupted(); };
    report.settle = act.settle;
    report.drape = session::perform_drape(act, scene, state);
    terminal.end_progress();
    draped = true;
    if (!model.motions.empty()) project.result.bodies = simulator::bodies_at(bodies, model, state.time);
    if (grammar::Diagnostics told = recorder.take_diagnostics(); !told.empty()) {
      show(told, project.sources, terminal);
      code = kDiagnostics;
    }
    show(session::told_by(report.drape, project.result, span), project.sources, terminal);
    code = std::max(code, exit_code_of(report.drape.status));
  }

  /// The holds of the garment without what was released; all else of the model stays.
  void release(const interpreter::ReleaseAct& act) {
    if (act.pin >= 0) holding.pins[static_cast<std::size_t>(act.pin)].panel = -1;
    if (act.clamp >= 0) {
      holding.scene.clamps[static_cast<std::size_t>(act.clamp)].parts.clear();
      holding.scene.clamps[static_cast<std::size_t>(act.clamp)].region = -1;
    }
    design::Garment left = holding;
    std::erase_if(left.pins, [](const design::Pin& pin) { return pin.panel < 0; });
    std::erase_if(left.scene.clamps, [](const design::Clamp& c) { return c.region < 0 && c.parts.empty(); });
    modeller::ModelResult built = modeller::build_model(left, bodies);
    if (!built.model || built.model->n_particles() != model.n_particles()) {
      show(interpreter::to_diagnostics(built.findings, project.result.origins), project.sources, terminal);
      code = kDiagnostics;
      return;
    }
    modeller::take_holds(*built.model, model);
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

void perform(Run& run) {
  for (const interpreter::Act& act : run.project.result.acts) {
    if (run.code == kInterrupted || run.code == kSimulationFailed || run.code == kDiagnostics) break;
    if (auto* drape = std::get_if<interpreter::DrapeAct>(&act.act)) run.drape(*drape, act.span);
    if (std::holds_alternative<interpreter::ExpectAct>(act.act)) run.expect(act);
    if (std::holds_alternative<interpreter::MeasureAct>(act.act)) run.measure(act);
    if (auto* release = std::get_if<interpreter::ReleaseAct>(&act.act)) run.release(*release);
    if (auto* record = std::get_if<interpreter::RecordAct>(&act.act)) run.recorder.add(*record);
    if (auto* vary = std::get_if<interpreter::VaryAct>(&act.act))
      run.code = std::max(run.code, run_study(run.options, *vary, run.out.folder(), run.host, run.terminal));
    if (auto* save = std::get_if<interpreter::SaveAct>(&act.act))
      for (const std::string& name : save->paths)
        if (!save_file(name, run.project, run.model, run.state, run.out, run.options.paper, run.terminal)) run.code = kInputOutput;
  }
}

void summarise_motion(const simulator::DrapeReport& drape, double taken, Terminal& terminal) {
  const simulator::MotionReport& m = drape.motion;
  auto joule = [](double x) { return format_number(x, 3) + " J"; };
  const std::string steps = m.steps == 0 ? fmt::format("{} steps, at rest at every moment", drape.steps)
                                         : fmt::format("{} steps of {} to {} ms", m.steps, format_number(1000 * m.least_step, 3),
                                                       format_number(1000 * m.largest_step, 3));
  terminal.note(fmt::format("{}: {} s in {}, {}, {} intersections", results::status_name(drape.status), format_number(m.seconds, 4),
                            steps, say_seconds(taken), drape.self_intersections + drape.body_intersections + drape.inside_body));
  if (m.stable_step > 0) terminal.note(fmt::format("       explicit steps are stable up to {} ms", format_number(1000 * m.stable_step, 3)));
  if (m.steps > 0)
    terminal.note(fmt::format("       energy: kinetic {}, stored {}; work {}, damping {}, friction {}, lost to the steps {}",
                              joule(m.balance.kinetic), joule(m.balance.stored), joule(m.balance.work), joule(m.balance.damping),
                              joule(m.balance.friction), joule(m.balance.numerical)));
}

void summarise(const results::Report& report, const OutputFolder& out, bool draped, Terminal& terminal) {
  double drape_seconds = 0;
  for (const results::PhaseTime& p : report.phases)
    if (p.phase == "drape") drape_seconds = p.seconds;
  if (draped && report.drape.motion.seconds > 0) summarise_motion(report.drape, drape_seconds, terminal);
  else if (draped)
    terminal.note(fmt::format("{}: {} particles, {} steps in {}, residual {} of the weight, largest strain {}%, {}",
                              results::status_name(report.drape.status), say_count(report.particles), report.drape.steps,
                              say_seconds(drape_seconds), format_number(report.drape.residual, 2),
                              format_number(100 * report.strain.all.any.largest, 2),
                              report.drape.self_intersections + report.drape.body_intersections + report.drape.inside_body == 0
                                  ? "nothing intersects"
                                  : fmt::format("{} intersections", report.drape.self_intersections +
                                                                        report.drape.body_intersections +
                                                                        report.drape.inside_body)));
  for (const results::TieMeasure& t : report.measures.ties)
    if (draped && t.gap > results::kOpenTie)
      terminal.note(fmt::format("`{}` does not close: {} mm are missing", t.closure, format_number(1000 * t.gap, 2)));
  for (const results::MeasureOutcome& m : report.stated_measures) terminal.note(fmt::format("       {} = {}", m.name, m.shown));
  for (const results::ExpectOutcome& e : report.expects)
    terminal.note(fmt::format("{} {}: found {}", e.passed ? "ok    " : "FAILED", e.text, e.shown));
  terminal.note(fmt::format("results in {}/", out.folder()));
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
  Run under_way{options, host, terminal, project, *model, out, report, project.result.garment, project.result.bodies, std::move(recorder)};
  under_way.state.position = model->start;
  under_way.state.velocity.assign(model->n_particles(), Eigen::Vector3d::Zero());
  for (const interpreter::MeasureValue& m : project.result.measures) under_way.keep_measure(m);
  perform(under_way);
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
  summarise(report, out, under_way.draped, terminal);
  if (out.failed()) return kInputOutput;
  return under_way.code;
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
