// Questions of drape and pull tests to a finished drape.
#include "interpreter/language/function_arguments.hpp"

namespace garment::interpreter::detail {
namespace {

int panel_of(Call& call) {
  if (const auto* panel = call.arguments[0].as<PanelValue>()) return panel->panel;
  fail(call.program,
       Message("G0306", "`" + std::string(call.record.name) + "` of " + kind_of(call.arguments[0]),
               call.given(0) ? call.places[0]->span : call.expr.span)
           .help("it takes one panel"));
}

Value run_stress(Call& call) {
  const DrapeMeasures& drape = drape_of(call);
  std::string panel;
  if (call.arguments[0].as<AllValue>() == nullptr) panel = call.program.panels[static_cast<std::size_t>(panel_of(call))].panel.name;
  if (const auto tension = drape.stress(panel)) return number_value(*tension, kForcePerLength);
  fail(call.program, Message("G0325", "`stress` is not known of this drape", call.expr.span));
}

Value run_drape_coefficient(Call& call) {
  const DrapeMeasures& drape = drape_of(call);
  if (const auto share = drape.drape_coefficient(panel_of(call))) return number_value(*share, kNumber, true);
  fail(call.program, Message("G0325",
                             "the drape coefficient is not known: no body carries the cloth, or the cloth is "
                             "not larger than the body's top",
                             call.expr.span)
                         .help("lay a round cloth on a `cylinder` that is smaller than it"));
}

Value run_nodes(Call& call) {
  const DrapeMeasures& drape = drape_of(call);
  if (const auto folds = drape.nodes(panel_of(call))) return number_value(*folds, kNumber);
  fail(call.program, Message("G0325", "the folds are not known: the panel has no rim", call.expr.span));
}

/// The clamp or pin that is asked about.
std::string holder_of(Call& call) {
  const Value& of = call.arguments[0];
  std::string name;
  if (const auto* pin = of.as<PinValue>()) name = call.program.garment.pins[static_cast<std::size_t>(pin->pin)].name;
  if (const auto* thing = of.as<ThingValue>(); thing != nullptr && thing->keyword == "clamp")
    name = call.program.garment.scene.clamps[static_cast<std::size_t>(thing->index)].name;
  if (name.empty())
    fail(call.program, Message("G0306", "`" + std::string(call.record.name) + "` of " + kind_of(of),
                               call.given(0) ? call.places[0]->span : call.expr.span)
                           .help("it takes a clamp or a pin"));
  return name;
}

Value held_value(Call& call, const std::string& name, const std::optional<Eigen::Vector3d>& v, Dimension dimension) {
  if (!v)
    fail(call.program, Message("G0325", "`" + std::string(call.record.name) + "` is not known: `" + name + "` holds nothing now",
                               call.expr.span));
  return Value{PointValue{{v->x(), v->y(), v->z()}, 3, dimension, -1}};
}

Value run_reaction(Call& call) {
  const DrapeMeasures& drape = drape_of(call);
  const std::string name = holder_of(call);
  return held_value(call, name, drape.reaction(name), kForce);
}

Value run_moment(Call& call) {
  const DrapeMeasures& drape = drape_of(call);
  const std::string name = holder_of(call);
  return held_value(call, name, drape.moment(name), kMoment);
}

Value run_later(Call& call) {
  fail(call.program,
       Message("G1326", "`" + std::string(call.record.name) + "` cannot be asked of a drape yet",
               call.expr.span)
           .help("ask strain, stress, shear, clearance, length, area, mass, energy, position, reaction, moment, drape_coefficient "
                 "or nodes"));
}

FunctionRecord later(std::string_view name, std::string_view form, std::string_view doc,
                     std::string_view example, std::vector<std::string_view> parameters) {
  FunctionRecord record;
  record.name = name;
  record.form = form;
  record.doc = doc;
  record.example = example;
  record.required = parameters.size();
  record.parameters = std::move(parameters);
  record.run = run_later;
  record.asks_drape = true;
  return record;
}

}  // namespace

std::vector<FunctionRecord> drape_test_functions() {
  return {
      {"drape_coefficient",
       "drape_coefficient(PANEL)",
       "shadow of a cloth that hangs over a disc, as a share of what hangs over",
       "drape_coefficient(cloth)",
       {"panel"},
       1,
       run_drape_coefficient,
       false,
       true},
      {"nodes",
       "nodes(PANEL)",
       "folds of the rim of a cloth",
       "nodes(cloth)",
       {"panel"},
       1,
       run_nodes,
       false,
       true},
      {"stress",
       "stress(PANEL | all)",
       "largest tension along warp or weft, per width",
       "stress(all)",
       {"panel"},
       1,
       run_stress,
       false,
       true},
      later("pressure", "pressure(PANEL | all)", "largest pressure on a body (not supported yet)",
            "pressure(all)", {"panel"}),
      {"reaction",
       "reaction(CLAMP | PIN)",
       "force with which a clamp or pin holds the cloth, in space",
       "reaction(corner).y",
       {"hold"},
       1,
       run_reaction,
       false,
       true},
      {"moment",
       "moment(CLAMP | PIN)",
       "moment of the forces with which a clamp or pin holds the cloth, about the middle of what it holds",
       "moment(corner).x",
       {"hold"},
       1,
       run_moment,
       false,
       true},
  };
}

}  // namespace garment::interpreter::detail
