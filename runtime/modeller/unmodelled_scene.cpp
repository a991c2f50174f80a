#include "runtime/modeller/unmodelled_scene.hpp"

namespace garment::modeller {

void find_unmodelled_scene(const design::Garment& garment,
                           const std::function<void(const std::string& what, OriginId origin)>& say) {
  const design::Scene& scene = garment.scene;
  for (const design::Panel& panel : garment.panels)
    if (panel.placement.folded) say("`start folded` of panel `" + panel.name + "`", panel.placement.origin);
  for (const design::Path& path : scene.paths) say("path `" + path.name + "`", path.origin);
  for (const design::Clamp& clamp : scene.clamps) {
    bool inside = false;
    for (const design::EdgePart& part : clamp.parts)
      inside = inside || part.on == design::EdgePart::On::line;
    if (inside) say("clamp `" + clamp.name + "` along a line inside a panel", clamp.origin);
  }
  for (const design::Force& force : scene.forces) say("force `" + force.name + "`", force.origin);
  for (const design::Pressure& pressure : scene.pressures)
    say("pressure `" + pressure.name + "`", pressure.origin);
  for (const design::Constraint& constraint : scene.constraints) say("`constrain`", constraint.origin);
  for (const design::FrictionPair& pair : scene.frictions) say("the friction of a pair", pair.origin);
  if (scene.wind) say("`wind`", scene.wind->origin);
  if (scene.drag) say("`drag`", scene.drag_origin);
  if (scene.solver && scene.solver->method != design::SolverChoice::Method::quasi_static)
    say("this solver", scene.solver->origin);
}

}  // namespace garment::modeller
