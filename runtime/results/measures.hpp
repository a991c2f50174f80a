#pragma once
// Sizes of the draped garment: lengths, areas, mass, and the room between cloth and body.
#include <optional>
#include <string>
#include <vector>

#include "runtime/body/body.hpp"
#include "runtime/geometry/curve.hpp"
#include "runtime/model/model.hpp"

namespace garment::results {

/// Distance from the cloth's middle surface to the nearest body, metres, over the vertices within
/// kClearanceReach of one.
struct Clearance {
  double least = 0, mean = 0;
};
inline constexpr double kClearanceReach = 0.5;  ///< m

struct PanelMeasure {
  std::string panel;                   ///< "all" for the whole garment
  double mass = 0;                     ///< kg
  double flat_area = 0;                ///< of the outline, m^2
  double draped_area = 0;              ///< of the triangles in space, m^2
  std::optional<Clearance> clearance;  ///< nothing when no body is near
};

struct SeamMeasure {
  std::string seam;
  double sewn_length = 0;    ///< m, of the first side
  double draped_length = 0;  ///< m, along the chain in space
  double gap = 0;  ///< m, largest distance between the sides; merged seams have none by construction
};

/// A button, hook, snap or tack.
struct TieMeasure {
  std::string closure;
  double gap = 0;  ///< m, by which its longest tie is longer than it should be; 0 where it holds
};
inline constexpr double kOpenTie = 1e-3;  ///< m, gap from which a closure does not count as closed

struct Measures {
  std::vector<PanelMeasure> panels;  ///< in the order of the model's panels
  PanelMeasure all;
  std::vector<SeamMeasure> seams;
  std::vector<TieMeasure> ties;  ///< in the order of the model's closures
};

/// Everything above at the positions of `state`. Bodies must have their index built.
Measures measure(const model::Model& model, const model::State& state, const std::vector<body::Body>& bodies);

/// Length in space of the particles of `panel` that lie on `curve` (flat coordinates, metres) between arc
/// lengths `from` and `to`, in their order along it; nothing when fewer than two do.
std::optional<double> draped_length(const model::Model& model, const model::State& state, model::Index panel,
                                    const geometry::Curve& curve, double from, double to);

}  // namespace garment::results
