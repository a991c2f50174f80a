// Builtin functions on the garment: what is known before the drape, and what is asked of it.
#include "interpreter/language/edges.hpp"
#include "interpreter/language/function_arguments.hpp"

namespace garment::interpreter::detail {
namespace {

const EdgeValue& edge_at(Call& call, std::size_t k) {
  const auto* edge = call.arguments[k].as<EdgeValue>();
  if (edge == nullptr)
    fail(call.program,
         Message("G0306", "`" + std::string(call.record.name) + "` of " + kind_of(call.arguments[k]),
                 place(call, k))
             .help("it takes an edge, a part of one or a chain `a + b`"));
  return *edge;
}

Value run_area(Call& call) {
  double sum = 0;
  if (const auto* panel = call.arguments[0].as<PanelValue>()) {
    sum = cloth_area(call.program.panels[static_cast<std::size_t>(panel->panel)]);
  } else if (call.arguments[0].as<AllValue>() != nullptr) {
    for (const PanelInfo& info : call.program.panels) sum += cloth_area(info);
  } else {
    fail(call.program, Message("G0306", "`area` of " + kind_of(call.arguments[0]), place(call, 0))
                           .help("it takes a panel or `all`"));
  }
  return number_value(sum, kArea);
}

/// Panel name, or empty for the whole garment.
std::string panel_name(Call& call) {
  if (!call.given(0) || call.arguments[0].as<AllValue>() != nullptr) return "";
  if (const auto* panel = call.arguments[0].as<PanelValue>())
    return call.program.panels[static_cast<std::size_t>(panel->panel)].panel.name;
  fail(call.program,
       Message("G0306", "`" + std::string(call.record.name) + "` of " + kind_of(call.arguments[0]),
               place(call, 0))
           .help("it takes a panel or `all`"));
}

Value known(Call& call, std::optional<double> value, Dimension dimension, bool percent = false) {
  if (value) return number_value(*value, dimension, percent);
  fail(call.program, Message("G0325", "`" + std::string(call.record.name) + "` is not known of this drape",
                             call.expr.span));
}

Value run_strain(Call& call) {
  const DrapeMeasures& drape = drape_of(call);
  return known(call, drape.strain(panel_name(call)), kNumber, true);
}
Value run_shear(Call& call) {
  const DrapeMeasures& drape = drape_of(call);
  return known(call, drape.shear(panel_name(call)), kAngle);
}
Value run_mass(Call& call) {
  const DrapeMeasures& drape = drape_of(call);
  return known(call, drape.mass(panel_name(call)), kMass);
}
Value run_clearance(Call& call) {
  const DrapeMeasures& drape = drape_of(call);
  return known(call, drape.clearance(panel_name(call)), kLength);
}
Value run_draped_area(Call& call) {
  const DrapeMeasures& drape = drape_of(call);
  return known(call, drape.area(panel_name(call)), kArea);
}
Value run_draped_length(Call& call) {
  const DrapeMeasures& drape = drape_of(call);
  const EdgeValue& edge = edge_at(call, 0);
  std::vector<design::EdgePart> parts;
  for (const EdgeSpan& span : edge.spans) parts.insert(parts.end(), span.parts.begin(), span.parts.end());
  return known(call, drape.length(parts), kLength);
}

Value run_position(Call& call) {
  const DrapeMeasures& drape = drape_of(call);
  std::optional<Eigen::Vector3d> at;
  if (const auto* pin = call.arguments[0].as<PinValue>()) {
    at = drape.position(pin->pin);
  } else if (const auto* p = call.arguments[0].as<PointValue>(); p != nullptr && p->panel >= 0) {
    at = drape.position(p->panel, design::Point2(p->at[0], p->at[1]));
  } else {
    fail(call.program, Message("G0306", "`position` of " + kind_of(call.arguments[0]), place(call, 0))
                           .help("it takes a pin or a point of an edge such as `front.hem.start`"));
  }
  if (!at) fail(call.program, Message("G0325", "`position` is not known of this drape", call.expr.span));
  return Value{PointValue{{at->x(), at->y(), at->z()}, 3, kLength, -1}};
}

}  // namespace

std::vector<FunctionRecord> garment_functions() {
  return {
      {"all",
       "all",
       "the whole garment",
       "strain(all)",
       {},
       0,
       [](Call&) { return Value{AllValue{}}; },
       true},
      {"area", "area(PANEL | all)", "of the cloth, darts cut away", "area(front)", {"panel"}, 1, run_area},
  };
}

std::vector<FunctionRecord> drape_functions() {
  return {
      {"draped",
       "draped.length(EDGE) | draped.area(PANEL)",
       "what the drape made of it",
       "draped.length(front.hem)",
       {},
       0,
       [](Call&) { return Value{DrapedValue{}}; },
       true,
       true},
      {"draped.length",
       "draped.length(EDGE)",
       "length after the drape",
       "draped.length(front.hem)",
       {"edge"},
       1,
       run_draped_length,
       false,
       true},
      {"draped.area",
       "draped.area(PANEL | all)",
       "area after the drape",
       "draped.area(front)",
       {"panel"},
       1,
       run_draped_area,
       false,
       true},
      {"strain",
       "strain(PANEL | all)",
       "largest tensile strain",
       "strain(all)",
       {"panel"},
       1,
       run_strain,
       false,
       true},
      {"shear",
       "shear(PANEL | all)",
       "largest shear angle",
       "shear(front)",
       {"panel"},
       1,
       run_shear,
       false,
       true},
      {"clearance",
       "clearance(PANEL | all)",
       "least distance to a body",
       "clearance(front)",
       {"panel"},
       0,
       run_clearance,
       true,
       true},
      {"mass", "mass(PANEL | all)", "mass of the cloth; of all with its buttons", "mass(all)", {"panel"}, 0, run_mass, true, true},
      {"energy",
       "energy",
       "elastic energy and that of weight",
       "energy",
       {},
       0,
       [](Call& call) { return known(call, drape_of(call).energy(), kEnergy); },
       true,
       true},
      {"elapsed",
       "elapsed",
       "how long the garment has moved: the time of all its drapes for a time",
       "elapsed",
       {},
       0,
       [](Call& call) { return known(call, drape_of(call).elapsed(), kTime); },
       true,
       true},
      {"penetrations",
       "penetrations",
       "places where cloth passes through a body or itself",
       "penetrations",
       {},
       0,
       [](Call& call) { return known(call, drape_of(call).penetrations(), kNumber); },
       true,
       true},
      {"position",
       "position(PIN | POINT)",
       "where it came to",
       "position(corner).y",
       {"what"},
       1,
       run_position,
       false,
       true},
  };
}

}  // namespace garment::interpreter::detail
