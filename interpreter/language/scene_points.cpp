// Points and vectors of the scene.
#include "interpreter/language/evaluate.hpp"
#include "interpreter/language/outline.hpp"
#include "interpreter/language/scene.hpp"

namespace garment::interpreter {

design::PanelPoint eval_panel_point(Program& program, const Expr& expr, Scope& scope, int panel,
                                    const std::string& what) {
  const PointValue p = eval_point(program, expr, scope, 2, kLength, what);
  const int lies = p.panel >= 0 ? p.panel : panel;
  auto name = [&](int k) { return "`" + program.panels[static_cast<std::size_t>(k)].panel.name + "`"; };
  if (lies < 0)
    fail(program,
         Message("G1301", "nothing says on which panel the point " + show(Value{p}) + " lies", expr.span)
             .help("name a point of an edge, as in `front.hem.start`, or write `front.at((3 cm, 4 cm))`"));
  if (panel >= 0 && lies != panel)
    fail(program,
         Message("G0613", "the point lies on panel " + name(lies) + ", not on " + name(panel), expr.span));
  const design::Point2 point(p.at[0], p.at[1]);
  if (!contains(program.panels[static_cast<std::size_t>(lies)].panel, point, 1e-3))
    fail(program,
         Message("G0613", "the point " + show(Value{p}) + " lies outside panel " + name(lies), expr.span)
             .help("points of a panel are in its own coordinates, as drawn"));
  return {lies, point};
}

Eigen::Vector3d eval_vector(Program& program, const Expr& expr, Scope& scope, Dimension dimension, double max,
                            const std::string& what) {
  const PointValue p = eval_point(program, expr, scope, 3, dimension, what);
  const Eigen::Vector3d v(p.at[0], p.at[1], p.at[2]);
  if (!(v.norm() <= max))
    fail(program, Message("G0309",
                          what + " is " + format_quantity(v.norm(), dimension) + " long; it must be " +
                              format_quantity(max, dimension) + " at most",
                          expr.span));
  return v;
}

}  // namespace garment::interpreter
