#pragma once
// What holds the cloth, pushes it, and moves: path, clamp, force, pressure, constrain, friction, wind, drag,
// solver.
#include "interpreter/language/program.hpp"

namespace garment::interpreter {

int reserve_path(Program& program, const Declaration& declaration);
Value evaluate_path(Program& program, Declaration& declaration);
int reserve_clamp(Program& program, const Declaration& declaration);
Value evaluate_clamp(Program& program, Declaration& declaration);
int reserve_force(Program& program, const Declaration& declaration);
Value evaluate_force(Program& program, Declaration& declaration);
int reserve_pressure(Program& program, const Declaration& declaration);
Value evaluate_pressure(Program& program, Declaration& declaration);

void run_constrain(Program& program, const Item& item);
void run_friction(Program& program, const Item& item);
void run_wind(Program& program, const Item& item);
void run_drag(Program& program, const Item& item);
void run_solver(Program& program, const Item& item);

/// A point that lies on a panel: of an edge, a named point, or `(x, y)` where `panel` says whose. Reports and
/// throws Stop where it lies outside.
design::PanelPoint eval_panel_point(Program& program, const Expr& expr, Scope& scope, int panel,
                                    const std::string& what);
/// A vector in space of one dimension, with a length of `max` at most (SI). Reports and throws Stop.
Eigen::Vector3d eval_vector(Program& program, const Expr& expr, Scope& scope, Dimension dimension, double max,
                            const std::string& what);

}  // namespace garment::interpreter
