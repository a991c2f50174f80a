#include "runtime/modeller/unmodelled_scene.hpp"

namespace garment::modeller {

void find_unmodelled_scene(const design::Garment& garment,
                           const std::function<void(const std::string& what, OriginId origin)>& say) {
  const design::Scene& scene = garment.scene;
  for (const design::Path& path : scene.paths) say("path `" + path.name + "`", path.origin);
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
