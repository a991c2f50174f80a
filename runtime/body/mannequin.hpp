#pragma once
// The parametric woman and man: a surface whose girths are the tape measures.
#include "runtime/base/finding.hpp"
#include "runtime/body/body.hpp"
#include "runtime/body/figure.hpp"

namespace garment::body {

/// Measures checked and put in their places. Errors: G0710 (names the measures that are missing), G0711 (not
/// finite, or out of its range, or heights in the wrong order). Measures that the figure does not use are
/// ignored.
struct MeasuresResult {
  std::optional<FigureMeasures> measures;
  Findings findings;
};
MeasuresResult check_measures(const design::Mannequin& mannequin, const std::string& name, OriginId origin);

struct MannequinResult {
  TriangleMesh mesh;                    ///< watertight, outward, exactly mirror-symmetric; soles at y = 0
  std::map<std::string, Level> levels;  ///< where the tapes lie, with the girths measured there
  double worst = 0;                     ///< largest difference of a measured girth from its tape, m
  Tape worst_tape;
};

/// Builds the surface and turns the figure's knobs until every girth measured on the mesh is within 0.3 mm of
/// its tape, or reports how far it came.
MannequinResult build_mannequin(const FigureMeasures& measures);

/// Hull girth of `mesh` at a tape, m; 0 if nothing is there.
double tape_girth(const TriangleMesh& mesh, const Figure& figure, const Tape& tape);

}  // namespace garment::body
