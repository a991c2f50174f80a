#pragma once
// Regions: parts of panels described by shapes, with factors on the cloth in them.
#include <string>
#include <vector>

#include "interpreter/language/program.hpp"

namespace garment::interpreter {

/// `region NAME in PANEL, ...: SHAPE`: makes room in the garment.
int reserve_region(Program& program, const Declaration& declaration);
Value evaluate_region(Program& program, Declaration& declaration);
/// `starch REGION factor F`.
void run_starch(Program& program, const Item& item);

/// Index of the region that `expr` names. Reports and throws Stop where it names none; `what` as in
/// `eval_panel`.
int eval_region(Program& program, const Expr& expr, Scope& scope, const std::string& what);
/// As `eval_region`, for a region that must cover part of `panel`.
int eval_region_on(Program& program, const Expr& expr, Scope& scope, int panel, const std::string& what);

/// `yoke.bend_warp`; nothing if a region has no such factor.
std::optional<Value> region_member(const design::Region& region, const std::string& name);
std::vector<std::string> region_factor_names();

/// A panel that a statement speaks of, and the half of it that is meant ("" for all of it).
struct PanelPart {
  int panel = -1;
  std::string half;
};
/// A panel or half of one. In a `both` statement a panel on the fold means its half.
PanelPart eval_panel_part(Program& program, const Expr& expr, Scope& scope, const std::string& what);

/// The shape that the words after `:` describe, on one panel. `others` are the panels of the region.
design::RegionShape read_region_shape(Program& program, const Statement& statement, Scope& scope,
                                      const PanelPart& on, const std::vector<PanelPart>& others);

/// The half of a panel on the fold that is meant, all of it where none is.
design::RegionShape half_shape(const Program& program, const PanelPart& on);

/// True where the panel has cloth in the shape.
bool covers_cloth(const design::Panel& panel, const design::RegionShape& shape);

}  // namespace garment::interpreter
