#include "interpreter/session/drape_act.hpp"

#include <algorithm>

#include "interpreter/session/models.hpp"
#include "runtime/model/motion.hpp"
#include "runtime/modeller/holds.hpp"
#include "runtime/modeller/layer_order.hpp"
#include "runtime/modeller/modeller.hpp"
#include "runtime/simulator/drape_levels.hpp"
#include "runtime/simulator/motion.hpp"
#include "runtime/simulator/moved_bodies.hpp"

namespace garment::session {
namespace {

simulator::DrapeReport to_rest(const DrapeScene& scene, const simulator::DrapeSettings& settings, model::State& state) {
  std::vector<model::Model> coarse;
  if (!scene.from_present) coarse = coarse_models(scene.script.garment, scene.bodies, scene.model);
  if (scene.model.motions.empty()) return simulator::drape_levels(coarse, scene.model, scene.bodies, state, settings);
  for (model::Model& level : coarse) level = model::at_time(level, state.time);
  return simulator::drape_levels(coarse, model::at_time(scene.model, state.time),
                                 simulator::bodies_at(scene.bodies, scene.model, state.time), state, settings);
}

simulator::MotionMethod method_of(const design::Garment& garment) {
  if (!garment.scene.solver) return simulator::MotionMethod::implicit;
  switch (garment.scene.solver->method) {
    case design::SolverChoice::Method::quasi_static: return simulator::MotionMethod::quasi_static;
    case design::SolverChoice::Method::explicit_steps: return simulator::MotionMethod::explicit_steps;
    case design::SolverChoice::Method::dynamic_constraints: return simulator::MotionMethod::dynamic_constraints;
    case design::SolverChoice::Method::semi_implicit: return simulator::MotionMethod::semi_implicit;
    case design::SolverChoice::Method::implicit: break;
  }
  return simulator::MotionMethod::implicit;
}

simulator::DrapeReport for_a_time(double duration, const DrapeScene& scene, model::State& state) {
  simulator::MotionSettings settings;
  settings.duration = duration;
  settings.method = method_of(scene.script.garment);
  if (scene.script.garment.scene.solver) settings.step = scene.script.garment.scene.solver->step;
  settings.self_collision = scene.settings.self_collision;
  settings.progress = scene.settings.progress;
  settings.interrupted = scene.settings.interrupted;
  settings.checkpoints = scene.settings.checkpoints;
  Recorder* recorder = scene.recorder;
  if (recorder != nullptr && !recorder->idle()) {
    settings.next_frame = [recorder](double after) { return recorder->next(after); };
    settings.frame = [&](const model::State& now, const simulator::DrapeReport& report) {
      recorder->sample(now, report, simulator::bodies_at(scene.bodies, scene.model, now.time));
    };
  }
  simulator::DrapeReport report = simulator::move_on(scene.model, scene.bodies, state, settings);
  if (recorder != nullptr && report.status != simulator::DrapeStatus::not_resumed) recorder->write_tables();
  return report;
}

}  // namespace

void take_stated(const interpreter::Interpretation& script, const std::vector<body::Body>& bodies, simulator::DrapeSettings& settings) {
  const design::Scene& scene = script.garment.scene;
  settings.hysteresis = scene.slides_to_rest();
  // Only people are asked to wear it evenly: what hangs from a pin, or over a table, buckles as it may.
  settings.symmetric = scene.symmetric() && std::any_of(bodies.begin(), bodies.end(), [](const body::Body& b) { return !b.levels.empty(); });
}

simulator::DrapeReport perform_drape(const interpreter::DrapeAct& act, const DrapeScene& scene, model::State& state) {
  if (!act.until_rest) return for_a_time(act.duration, scene, state);
  simulator::DrapeSettings settings = scene.settings;
  settings.settle = act.settle;
  take_stated(scene.script, scene.bodies, settings);
  simulator::DrapeReport report = to_rest(scene, settings, state);
  look_at_layers(scene.script.garment, scene.model, state, report);
  return report;
}

void look_at_layers(const design::Garment& garment, const model::Model& model, const model::State& state, simulator::DrapeReport& report) {
  if (report.status != simulator::DrapeStatus::at_rest) return;
  for (Finding& finding : modeller::rested_out_of_order(garment, model, state.position)) report.findings.push_back(std::move(finding));
}

bool rests_otherwise(const simulator::DrapeReport& report) {
  return report.status == simulator::DrapeStatus::at_rest && has_errors(report.findings);
}

Findings let_go(const interpreter::ReleaseAct& act, const std::vector<body::Body>& bodies, design::Garment& holding, model::Model& model) {
  if (act.pin >= 0) holding.pins[static_cast<std::size_t>(act.pin)].panel = -1;
  if (act.clamp >= 0) holding.scene.clamps[static_cast<std::size_t>(act.clamp)].released = true;
  design::Garment left = holding;
  std::erase_if(left.pins, [](const design::Pin& pin) { return pin.panel < 0; });
  modeller::ModelResult built = modeller::build_model(left, bodies);
  if (!built.model) return std::move(built.findings);
  modeller::take_holds(*built.model, model);
  return {};
}

grammar::Diagnostics told_by(const simulator::DrapeReport& report, const interpreter::Interpretation& script, grammar::Span act) {
  grammar::Diagnostics told = interpreter::to_diagnostics(report.findings, script.origins);
  for (grammar::Diagnostic& d : told)
    if (d.labels.empty()) d.labels.push_back({act, ""});
  return told;
}

}  // namespace garment::session
