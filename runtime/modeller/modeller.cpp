#include "runtime/modeller/modeller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/base/number.hpp"
#include "runtime/base/parallel.hpp"
#include "runtime/design/fineness.hpp"
#include "runtime/modeller/bending.hpp"
#include "runtime/modeller/closures.hpp"
#include "runtime/modeller/cloth_fields.hpp"
#include "runtime/modeller/damping.hpp"
#include "runtime/modeller/folding.hpp"
#include "runtime/modeller/holds.hpp"
#include "runtime/modeller/inner_friction.hpp"
#include "runtime/modeller/inner_lines.hpp"
#include "runtime/modeller/layer_order.hpp"
#include "runtime/modeller/pads.hpp"
#include "runtime/modeller/placement.hpp"
#include "runtime/modeller/pressing.hpp"
#include "runtime/modeller/region_values.hpp"
#include "runtime/modeller/scene_loads.hpp"
#include "runtime/modeller/sewing.hpp"
#include "runtime/modeller/twins.hpp"
#include "runtime/modeller/unmodelled.hpp"

namespace garment::modeller {
namespace {

using model::Index;

/// A declared garment comes from the interpreter, but also from files and other programs: what is read here
/// is checked here.
bool check_inputs(const design::Garment& garment, const ModelOptions& options, Findings& findings) {
  auto refuse = [&](OriginId origin, std::string message, std::string help) {
    findings.push_back({"G0452", Severity::error, std::move(message), {{origin, ""}}, std::move(help)});
  };
  std::size_t before = findings.size();
  if (garment.panels.empty()) refuse({}, "the garment has no panels", "declare a panel");
  for (const design::Panel& panel : garment.panels) {
    double h = options.resolution > 0 ? options.resolution : panel.resolution;
    if (panel.fabric < 0 || panel.fabric >= static_cast<int>(garment.fabrics.size()))
      refuse(panel.origin, fmt::format("panel `{}` has no fabric", panel.name), "name a declared fabric");
    if (!(h >= 1e-4 && h <= 1))
      refuse(panel.origin,
             fmt::format("panel `{}` has a grid of {} mm", panel.name, format_number(h * 1000, 4)),
             "the grid spacing lies between 0.1 mm and 1 m");
    if (!std::isfinite(panel.grain_angle) || (panel.fold_x && !std::isfinite(*panel.fold_x)))
      refuse(panel.origin, fmt::format("panel `{}` has no finite grain or fold", panel.name),
             "check the panel's values");
  }
  for (const design::Fabric& f : garment.fabrics) {
    bool good = f.areal_density > 0 && f.thickness >= 0 && f.shear_rigidity >= 0 && f.friction >= 0 &&
                f.twist_rigidity >= 0;
    for (int k = 0; k < 2; ++k)
      good = good && f.tensile[k].max_strain > 0 && f.tensile[k].max_force > 0 &&
             f.tensile[k].linearity > 0 && f.bending_rigidity[k] >= 0 &&
             std::isfinite(f.tensile[k].max_strain + f.tensile[k].max_force) &&
             std::isfinite(f.tensile[k].linearity + f.bending_rigidity[k]);
    if (!good ||
        !std::isfinite(f.areal_density + f.thickness + f.shear_rigidity + f.friction + f.twist_rigidity))
      refuse(f.origin, fmt::format("fabric `{}` has a property that is negative, zero or not finite", f.name),
             "mass, EM, LT and Fm are positive; G, B, T and friction are not negative");
  }
  for (const design::Press& press : garment.presses) {
    constexpr double kMost = 0.5;  // of the length
    const bool lengths = press.kind == design::Press::Kind::shrink || press.kind == design::Press::Kind::extend;
    const double most = press.factor * std::max(press.warp, press.weft);
    if (lengths && !(most <= kMost))
      refuse(press.origin,
             fmt::format("iron `{}` changes lengths by {} %", press.name, format_number(100 * most, 3)),
             "at most half of the length, the factor counted");
  }
  if (garment.scene.slides_to_rest() && !slides(garment))
    findings.push_back({"G1329",
                        Severity::error,
                        "`hysteresis on`, but no fabric states `two_HB`, `two_HG`, `two_HG5` or `RT`",
                        {{garment.scene.solver->origin, ""}},
                        "give the fabric its loops, or leave `hysteresis on` out"});
  return findings.size() == before;
}

double spacing_of(const design::Panel& panel, const ModelOptions& options) {
  double stated = options.resolution > 0 ? options.resolution : panel.resolution;
  return options.coarsen > 1 ? std::max(stated, std::min(stated * options.coarsen, design::half_mean_width(panel)))
                             : stated;
}

/// Refuses grids that would not fit, before they are made.
bool check_size(const std::vector<BorderPanel>& panels, std::size_t most, Findings& findings) {
  double particles = 0;
  const BorderPanel* largest = nullptr;
  double largest_count = 0;
  for (const BorderPanel& p : panels) {
    double perimeter = 0;
    for (const Piece& piece : p.outline.pieces) perimeter += piece.length();
    double count = p.outline.area / (p.h * p.h) + perimeter / p.h;
    Eigen::Vector2d low(1e300, 1e300), high(-1e300, -1e300);
    for (std::size_t k = 0; k < p.outline.pieces.size(); ++k) {
      low = low.cwiseMin(corner(p.outline, k));
      high = high.cwiseMax(corner(p.outline, k));
    }
    Eigen::Vector2d cells = (high - low) / p.h;
    count = std::max(count, cells.x() * cells.y() / 16);  // a slanting strip: its grid covers its box
    particles += count;
    if (count > largest_count) {
      largest_count = count;
      largest = &p;
    }
  }
  if (particles <= static_cast<double>(most)) return true;
  double factor = std::sqrt(particles / static_cast<double>(most));
  findings.push_back(
      {"G0452",
       Severity::error,
       fmt::format("the garment needs about {} particles, panel `{}` alone {}; at most {} are allowed",
                   format_number(particles, 3), largest->panel->name, format_number(largest_count, 3), most),
       {{largest->panel->origin, ""}},
       fmt::format("a grid coarser by a factor of {} fits", format_number(factor * 1.05, 2))});
  return false;
}

std::vector<BorderPanel> cut_outlines(const design::Garment& garment, const ModelOptions& options,
                                      Findings& findings) {
  std::vector<BorderPanel> panels(garment.panels.size());
  for (std::size_t p = 0; p < panels.size(); ++p) {
    panels[p].panel = &garment.panels[p];
    panels[p].h = spacing_of(garment.panels[p], options);
    const std::vector<InnerLine> lines = lines_to_follow(garment, static_cast<int>(p), panels[p].h);
    if (std::optional<Outline> outline = cut_outline(garment.panels[p], panels[p].h, lines, findings))
      panels[p].outline = std::move(*outline);
  }
  return panels;
}

/// Meshes of all panels, in order; empty where one could not be made.
std::vector<MeshedPanel> mesh_panels(const design::Garment& garment, const std::vector<BorderPanel>& outlines,
                                     const std::vector<GridFrame>& frames, const Borders& borders,
                                     Findings& findings) {
  std::vector<MeshedPanel> panels(outlines.size());
  std::vector<Findings> found(outlines.size());
  parallel_for(outlines.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      std::optional<PanelMesh> mesh = mesh_panel(outlines[p], frames[p], borders.panels[p], found[p]);
      if (!mesh) continue;
      panels[p].panel = outlines[p].panel;
      panels[p].fabric = &garment.fabrics[outlines[p].panel->fabric];
      panels[p].frame = frames[p];
      panels[p].mesh = std::move(*mesh);
      panels[p].vertex_area = vertex_areas(panels[p].mesh, borders.panels[p], outlines[p].outline.area);
    }
  });
  Index vertices = 0;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    findings.insert(findings.end(), found[p].begin(), found[p].end());
    panels[p].first_vertex = vertices;
    vertices += static_cast<Index>(panels[p].mesh.at.size());
  }
  return panels;
}

}  // namespace

ModelResult build_model(const design::Garment& garment, const std::vector<body::Body>& bodies,
                        const ModelOptions& options) {
  ModelResult result;
  Findings& findings = result.findings;
  if (!check_inputs(garment, options, findings)) return result;
  findings = find_unmodelled(garment);
  if (has_errors(findings)) return result;
  std::vector<BorderPanel> outlines = cut_outlines(garment, options, findings);
  if (has_errors(findings) || !check_size(outlines, options.max_particles, findings)) return result;
  std::vector<Matching> matchings = collect_matchings(garment, outlines, findings);
  if (has_errors(findings)) return result;
  break_at_attachments(garment, outlines);
  Matched matched;
  if (!match_stretches(matchings, outlines, matched, findings)) return result;
  std::vector<GridFrame> frames;
  for (const BorderPanel& p : outlines) frames.push_back(make_frame(*p.panel, p.outline, p.h));
  Borders borders = make_borders(outlines, frames, matched);
  std::vector<MeshedPanel> panels = mesh_panels(garment, outlines, frames, borders, findings);
  if (has_errors(findings)) return result;

  model::Model model;
  std::vector<Index> first_vertex;
  std::vector<double> areas;
  std::size_t n_vertices = 0;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    first_vertex.push_back(panels[p].first_vertex);
    areas.push_back(outlines[p].outline.area);
    n_vertices += panels[p].mesh.at.size();
  }
  std::vector<SewnSides> sides;
  std::vector<Index> particle = sew(matchings, matched, borders, first_vertex, n_vertices, model, sides);
  part_twins(panels, particle);
  const ClothFields fields(garment);
  if (options.coarsen <= 1)
    for (Finding& finding : fields.unreached(panels)) findings.push_back(std::move(finding));
  if (!add_particles(garment, panels, areas, particle, fields, model, findings)) return result;
  add_elements(garment, panels, fields, model);
  if (options.coarsen <= 1) add_region_values(panels, fields, model);
  add_bending(panels, fields, Folds(fold_chains(garment, outlines, borders, panels, model), model.n_particles()), model);
  Findings unreached;
  add_creases(garment, panels, outlines, model, unreached);
  add_pads(garment, panels, model, unreached);
  add_damping(panels, fields, model);
  if (options.coarsen <= 1) findings.insert(findings.end(), unreached.begin(), unreached.end());
  // What a tack goes to depends on where the panels lie: the model must not depend on whether they were dressed for it.
  const bool dress = options.dress || !garment.tacks.empty();
  if (!place_panels(garment, bodies, sides, model, findings, dress)) return result;
  if (options.dress && options.coarsen <= 1)
    for (Finding& finding : started_out_of_order(garment, model)) findings.push_back(std::move(finding));
  add_closures(garment, model, findings);
  add_seam_ties(sides, model, findings);
  add_holds(garment, bodies, outlines, borders, panels, model, findings);
  add_scene_loads(garment, bodies, panels, model, findings);
  if (!has_errors(findings)) result.model = std::move(model);
  return result;
}

}  // namespace garment::modeller
