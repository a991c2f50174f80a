#include "interpreter/session/stage.hpp"

#include <algorithm>

#include "interpreter/language/modelling.hpp"
#include "runtime/model/dump.hpp"
#include "runtime/modeller/unmodelled.hpp"

namespace garment::session {

std::shared_ptr<Evaluated> Workshop::evaluate(const std::string& text) const {
  auto evaluated = std::make_shared<Evaluated>();
  evaluated->source = evaluated->sources.add(name, text);
  interpreter::InterpretOptions options;
  options.stdlib_dir = stdlib_dir;
  options.script_dir = script_dir;
  options.library_dirs = library_dirs;
  options.allow_read = allow_read;
  options.build_body = [this](const design::Body& declared, Host& with, const std::string& folder) {
    return bodies.build(declared, with, folder);
  };
  evaluated->result = interpreter::interpret(evaluated->sources, evaluated->source, host, options);
  return evaluated;
}

Modelled Workshop::build(const Evaluated& evaluated, const Released& released, bool dress) const {
  Modelled modelled;
  const interpreter::Interpretation& result = evaluated.result;
  if (!result.ok() || result.garment.panels.empty()) return modelled;
  const Findings missing = modeller::find_unmodelled(result.garment, Severity::warning);
  if (!missing.empty()) {
    modelled.diagnostics = interpreter::to_diagnostics(missing, result.origins);
    return modelled;
  }
  modeller::ModelOptions options;
  options.dress = dress;
  Findings of_start;
  modeller::ModelResult built =
      released.empty() ? interpreter::model_of(result.garment, result.bodies, result.acts, options, &of_start)
                       : interpreter::model_of(less(result.garment, released), result.bodies, result.acts, options, &of_start);
  if (!dress && built.model && start_matters(*built.model)) return build(evaluated, released);
  modelled.dressed = dress;
  modelled.diagnostics = interpreter::to_diagnostics(built.findings, result.origins);
  modelled.of_start = interpreter::to_diagnostics(of_start, result.origins);
  modelled.failed = has_errors(built.findings);
  if (!modelled.failed) modelled.model = std::move(built.model);
  return modelled;
}

design::Garment less(const design::Garment& garment, const Released& released) {
  design::Garment left = garment;
  const auto gone = [&](const auto& hold) { return released.contains(hold.name); };
  std::erase_if(left.pins, gone);
  std::erase_if(left.scene.clamps, gone);
  return left;
}

bool start_matters(const model::Model& model) {
  return std::any_of(model.hold_kind.begin(), model.hold_kind.end(),
                     [](model::HoldKind kind) { return kind == model::HoldKind::point; });
}

bool same_model(const model::Model& a, const model::Model& b) {
  if (a.n_particles() != b.n_particles() || a.n_vertices() != b.n_vertices()) return false;
  model::Model x = a, y = b;
  x.start.assign(x.n_particles(), Eigen::Vector3d::Zero());
  y.start = x.start;
  return model::model_hash(x) == model::model_hash(y);
}

std::shared_ptr<const model::State> start_state(const model::Model& model) {
  auto state = std::make_shared<model::State>();
  state->position = model.start;
  state->velocity.assign(model.n_particles(), Eigen::Vector3d::Zero());
  return state;
}

void show_as_typed(Evaluated& evaluated, grammar::Diagnostics& diagnostics, const Patch& patch,
                   const std::string& entry) {
  std::optional<grammar::SourceId> prompt;
  for (grammar::Diagnostic& diagnostic : diagnostics)
    for (grammar::Label& label : diagnostic.labels) {
      if (label.span.source != evaluated.source) continue;
      const auto typed = patch.in_entry({label.span.begin, label.span.end});
      if (!typed) continue;
      if (!prompt) prompt = evaluated.sources.add("<prompt>", entry);
      label.span = {*prompt, typed->begin, typed->end};
    }
}

}  // namespace garment::session
