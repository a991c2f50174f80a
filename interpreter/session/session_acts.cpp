// Acts at the prompt: they run at once, on the shape as it hangs.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "interpreter/session/drape_act.hpp"
#include "interpreter/session/models.hpp"
#include "interpreter/session/result_files.hpp"
#include "interpreter/session/session.hpp"
#include "runtime/base/number.hpp"
#include "runtime/modeller/reshape.hpp"
#include "runtime/modeller/transfer.hpp"
#include "runtime/results/report.hpp"
#include "runtime/results/strain.hpp"
#include "runtime/simulator/approach.hpp"
#include "runtime/simulator/certificate.hpp"
#include "runtime/simulator/drape_again.hpp"
#include "runtime/simulator/drape_levels.hpp"
#include "runtime/simulator/moved_bodies.hpp"

namespace garment::session {
namespace {

using interpreter::Act;

Outcome outcome_of(const simulator::DrapeReport& report) {
  const simulator::DrapeStatus status = report.status;
  if (rests_otherwise(report)) return Outcome::unmet;
  if (status == simulator::DrapeStatus::at_rest || status == simulator::DrapeStatus::ran) return Outcome::done;
  return status == simulator::DrapeStatus::interrupted ? Outcome::interrupted : Outcome::failed;
}

std::string summary(const model::Model& model, const model::State& state,
                    const simulator::DrapeReport& report) {
  const std::size_t cuts = report.self_intersections + report.body_intersections + report.inside_body;
  return fmt::format("{}: {} step{}, residual {} of the weight, largest strain {}%, {}",
                     results::status_name(report.status), report.steps, report.steps == 1 ? "" : "s",
                     format_number(report.residual, 2),
                     format_number(100 * results::measure_strain(model, state).all.any.largest, 2),
                     cuts == 0 ? "nothing intersects" : fmt::format("{} intersections", cuts));
}

/// The shape of `before` on the model of `stage`, every part of the cloth at its new size, as far as cloth does not meet cloth on
/// the way there from how it lay.
model::State carried_state(const Stage& before, const Stage& stage) {
  const model::Model& model = *stage.modelled->model;
  const modeller::ModelledGarment was{before.evaluated->result.garment, *before.modelled->model},
      is{stage.evaluated->result.garment, model};
  const modeller::Transferred laid = modeller::transfer(was, before.shape.state->position, is);
  model::State state;
  state.velocity.assign(model.n_particles(), Eigen::Vector3d::Zero());
  state.position = modeller::reshape(was, before.shape.state->position, is, laid, stage.evaluated->result.bodies);
  if (state.position != laid.position && simulator::certify(model, state, {}).self_intersections > 0)
    state.position = simulator::approach(model, laid.position, state.position);
  return state;
}

}  // namespace

Answer Session::act(const Entry& entry) {
  for (const grammar::Statement& statement : entry.script.statements)
    if (!is_act(statement))
      return refuse(
          "G1503", fmt::format("`{}` stands among acts in one entry", statement.keyword.text),
          "type it as an entry of its own: declarations are written into the script, acts run at once");
  // Understood as if it stood at the end of the script; the script itself stays as it is. What the script would release
  // is released only where `:run` came to it.
  Patch patch(stage_.text + "\n");
  const grammar::Block& script = stage_.evaluated->result.script->statements;
  for (std::size_t k = script.size(); k-- > 0;)
    if (script[k].keyword.text == "release") patch.remove({script[k].span.begin, script[k].span.end});
  const std::uint32_t end = static_cast<std::uint32_t>(patch.text().size());
  patch.insert(end, "", {entry.text, 0}, "\n");
  const std::shared_ptr<Evaluated> evaluated = workshop_.evaluate(patch.text());
  grammar::Diagnostics diagnostics = evaluated->result.diagnostics;
  show_as_typed(*evaluated, diagnostics, patch, entry.text);
  if (!evaluated->result.ok())
    return {Outcome::refused, shown(diagnostics, evaluated->sources, Severity::error)};
  acts_entry_ = entry.text;
  std::vector<Act> acts = evaluated->result.acts;
  std::erase_if(acts, [&](const Act& act) {
    return act.span.source != evaluated->source || !patch.in_entry({act.span.begin, act.span.end});
  });
  Answer answer = run_acts(*evaluated, acts);
  if (answer.outcome == Outcome::done && answer.text.empty()) answer.text = "ok\n";  // an `assert` that holds
  return answer;
}

Answer Session::run_acts(Evaluated& evaluated, const std::vector<Act>& acts) {
  Answer all;
  for (const Act& act : acts) {
    const Answer one = perform(evaluated, act);
    all.text += one.text;
    if (one.outcome != Outcome::done) all.outcome = one.outcome;
    if (one.outcome != Outcome::done && one.outcome != Outcome::unmet) break;
  }
  return all;
}

Answer Session::perform(Evaluated& evaluated, const Act& act) {
  if (!stage_.modelled->model || !stage_.shape.state) {
    std::string help = "declare panels, their fabric, seams and places first";
    if (!stage_.modelled->diagnostics.empty()) help = "`:warnings` says why";
    return refuse("G1504", "there is no model to drape or ask", help);
  }
  if (const auto* drape = std::get_if<interpreter::DrapeAct>(&act.act)) {
    return drape->until_rest ? drape_now(drape->settle) : move_now(evaluated, *drape, act.span);
  }
  if (const auto* save = std::get_if<interpreter::SaveAct>(&act.act)) return save_files(*save);
  if (const auto* released = std::get_if<interpreter::ReleaseAct>(&act.act)) {
    const design::Garment& garment = evaluated.result.garment;
    return release(released->pin >= 0 ? garment.pins[static_cast<std::size_t>(released->pin)].name
                                      : garment.scene.clamps[static_cast<std::size_t>(released->clamp)].name);
  }
  if (std::holds_alternative<interpreter::RecordAct>(act.act))
    return refuse("G1325", "the prompt records no curves",
                  "`:save` the script with its `record` and its `drape for`, and `garment run` it");
  const auto* vary = std::get_if<interpreter::VaryAct>(&act.act);
  if (vary != nullptr)
    return refuse("G1504",
                  fmt::format("`vary` makes a script of each value of `{}` and writes a folder for each: `garment run` does that",
                              vary->target),
                  fmt::format("`:save` the script with its `vary` and run it; or try one value here: `{} = {}`", vary->target,
                              vary->values.front()));
  const auto* expect = std::get_if<interpreter::ExpectAct>(&act.act);
  const auto* measure = std::get_if<interpreter::MeasureAct>(&act.act);
  if (expect == nullptr && measure == nullptr) return {};
  if (!stage_.shape.draped)
    return refuse("G0325", "nothing was draped yet, so there is nothing to ask",
                  "type `drape until rest` first");
  const std::vector<body::Body> bodies =
      simulator::bodies_at(evaluated.result.bodies, *stage_.modelled->model, stage_.shape.state->time);
  const DrapeAnswers answers(evaluated.result.garment, bodies, *stage_.modelled->model,
                             *stage_.shape.state, stage_.shape.report);
  if (measure != nullptr) {
    const interpreter::MeasureResult r = interpreter::evaluate_measure(evaluated.result, act, answers);
    return {r.diagnostics.empty() ? Outcome::done : Outcome::refused,
            r.diagnostics.empty() ? fmt::format("{} = {}\n", r.measure.name, r.measure.text)
                                  : shown(r.diagnostics, evaluated.sources, Severity::error)};
  }
  const interpreter::ExpectResult r = interpreter::evaluate_expect(evaluated.result, act, answers);
  if (r.found.empty()) return {Outcome::refused, shown(r.diagnostics, evaluated.sources, Severity::error)};
  return {r.passed ? Outcome::done : Outcome::unmet,
          fmt::format("{} {}: found {}\n", r.passed ? "ok    " : "FAILED", r.text, r.found)};
}

/// What a drape from the start minds; the script itself has none, so that it was not told before.
std::string Session::told_of_start() const {
  if (stage_.shape.draped || stage_.shape.carried) return "";
  return shown(stage_.modelled->of_start, stage_.evaluated->sources, Severity::warning);
}

Answer Session::drape_now(simulator::Settle settle) {
  Answer answer{Outcome::done, told_of_start()};
  Stage next = stage_;
  next.entry = acts_entry_;
  next.shape.settle = settle;
  answer.outcome = drape(next, stage_.shape.draped || stage_.shape.carried, answer.text);
  take(std::move(next));
  return answer;
}

/// Lets the garment move for a time, from where it hangs.
Answer Session::move_now(Evaluated& evaluated, const interpreter::DrapeAct& act, grammar::Span span) {
  const double begun = host_.seconds();
  Answer answer{Outcome::done, told_of_start()};
  Stage next = stage_;
  next.entry = acts_entry_;
  const model::Model& model = *next.modelled->model;
  DrapeScene scene{evaluated.result, next.evaluated->result.bodies, model, true};
  scene.settings.progress = options_.progress;
  scene.settings.interrupted = options_.interrupted;
  auto state = std::make_shared<model::State>(*next.shape.state);
  next.shape.report = perform_drape(act, scene, *state);
  next.shape.draped = true;
  next.shape.carried = false;
  next.shape.state = std::move(state);
  answer.text += shown(told_by(next.shape.report, evaluated.result, span), evaluated.sources, Severity::warning);
  answer.text += fmt::format("{}: {} s in {} steps{}\n", results::status_name(next.shape.report.status),
                             format_number(next.shape.report.motion.seconds, 4), next.shape.report.steps,
                             seconds_since(begun));
  answer.outcome = outcome_of(next.shape.report);
  take(std::move(next));
  return answer;
}

/// Lets a pin or clamp go. The garment stays where it is until it is draped.
Answer Session::release(const std::string& name) {
  if (stage_.released.contains(name))
    return refuse("G1320", fmt::format("`{}` is released already", name), "`:reset` and `:run` take hold of it again");
  Stage next = stage_;
  next.entry = acts_entry_;
  next.released.insert(name);
  next.modelled = std::make_shared<Modelled>(workshop_.build(*next.evaluated, next.released, next.modelled->dressed));
  if (!next.modelled->model || next.modelled->model->n_particles() != next.shape.state->position.size())
    return {Outcome::refused, shown(next.modelled->diagnostics, next.evaluated->sources, Severity::error)};
  next.shape.carried = next.shape.draped || next.shape.carried;
  next.shape.draped = false;
  take(std::move(next));
  return {Outcome::done, fmt::format("released {}; `drape until rest` shows where the garment goes\n", name)};
}

/// Drapes the stage from its shape: from the placed panels by way of coarser grids, else on from where it
/// hangs.
Outcome Session::drape(Stage& stage, bool from_present, std::string& text) {
  const double begun = host_.seconds();
  const model::Model& model = *stage.modelled->model;
  const interpreter::Interpretation& result = stage.evaluated->result;
  simulator::DrapeSettings settings;
  settings.settle = stage.shape.settle;
  take_stated(result, result.bodies, settings);
  if (options_.max_steps > 0) settings.max_steps = options_.max_steps;
  settings.progress = options_.progress;
  settings.interrupted = options_.interrupted;
  auto state = std::make_shared<model::State>(*stage.shape.state);
  if (!model.motions.empty()) {  // what stands on paths stands where it has come to
    const interpreter::DrapeAct act{true, stage.shape.settle, 0};
    stage.shape.report = perform_drape(act, {result, result.bodies, model, from_present, settings}, *state);
    stage.shape.draped = true;
    stage.shape.carried = false;
    text += shown(interpreter::to_diagnostics(stage.shape.report.findings, result.origins), stage.evaluated->sources,
                  Severity::warning);
    text += summary(model, *state, stage.shape.report) + seconds_since(begun) + '\n';
    stage.shape.state = std::move(state);
    return outcome_of(stage.shape.report);
  }
  std::vector<model::Model> coarse;
  if (!from_present || simulator::far_from_rest(model, state->position, stage.shape.strained))
    coarse = coarse_models(result.garment, result.bodies, model, !from_present);
  stage.shape.report = from_present ? simulator::drape_again(coarse, model, result.bodies, *state, settings)
                                    : simulator::drape_levels(coarse, model, result.bodies, *state, settings);
  look_at_layers(result.garment, model, *state, stage.shape.report);
  stage.shape.draped = true;
  stage.shape.carried = false;
  text += shown(interpreter::to_diagnostics(stage.shape.report.findings, result.origins),
                stage.evaluated->sources, Severity::warning);
  text += summary(model, *state, stage.shape.report) + seconds_since(begun) + '\n';
  if (stage.shape.report.status == simulator::DrapeStatus::at_rest)
    stage.shape.strained = simulator::strained_share(model, state->position);
  stage.shape.state = std::move(state);
  if (stage.shape.report.status == simulator::DrapeStatus::interrupted)
    text += "stopped; the shape is kept, `drape until rest` goes on from it\n";
  return outcome_of(stage.shape.report);
}

/// The shape of `before` on the model of `stage`, draped on where that is wanted.
Outcome Session::carry_on(const Stage& before, Stage& stage, std::string& text) {
  const model::Model& model = *stage.modelled->model;
  const bool hangs = before.shape.draped || before.shape.carried;
  if (!hangs) {
    stage.shape.state = start_state(model);
    return Outcome::done;
  }
  auto state = std::make_shared<model::State>(carried_state(before, stage));
  stage.shape = {std::move(state), {}, before.shape.settle, false, true, before.shape.strained};
  if (automatic_) return drape(stage, true, text);
  text += "the shape was carried over; `drape until rest` brings it to rest\n";
  return Outcome::done;
}

Answer Session::save_files(const interpreter::SaveAct& act) {
  Answer answer;
  const interpreter::Interpretation& result = stage_.evaluated->result;
  for (const std::string& name : act.paths) {
    const ResultFile file =
        make_result_file(name, result.garment,
                         simulator::bodies_at(result.bodies, *stage_.modelled->model, stage_.shape.state->time),
                         *stage_.modelled->model, *stage_.shape.state);
    if (!file.bytes) return {Outcome::failed, answer.text + fault("G0905", file.message, file.help)};
    const std::string path = (std::filesystem::path(out_folder()) / name).string();
    std::vector<std::string> granted = options_.allow_write;
    granted.push_back(out_folder());
    if (const HostResult<bool> written = host_.write_below(granted, path, *file.bytes); !written)
      return {Outcome::failed,
              answer.text +
                  fault("G0902", fmt::format("cannot write `{}`: {}", path, written.error.message), "")};
    answer.text += fmt::format("wrote {}\n", path);
  }
  return answer;
}

}  // namespace garment::session
