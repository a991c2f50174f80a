#pragma once
// From a Kawabata tensile record to the law N(strain) that springs and membranes follow.
#include <utility>
#include <vector>

#include "runtime/design/fabric.hpp"
#include "runtime/model/model.hpp"

namespace garment::modeller {

/// Tabulates, with e = strain, e_m = max_strain, s_m = max_force / e_m, L = linearity, r = min(1/4, L/2):
///   L < 1:   N = s_m [ r e + (1 - r) e_m (e / e_m)^p ],  p = 2 (1 - r) / (L - r) - 1
///   L >= 1:  N = a e + b e^2,  a = (3 L - 2) s_m,  b = 3 (1 - L) s_m / e_m
/// Both pass through (e_m, max_force) and hold the work L max_force e_m / 2. Beyond e_m the law goes on along
/// its tangent; in compression it is linear with the slope that it has at zero, so that it has no kink there.
/// 40 knots, denser near zero, with the exact slopes. Linearity is taken within [0.1, 1.3], outside of which
/// no cloth was measured and the law would not rise everywhere.
model::TensileLaw make_tensile_law(const design::Tensile& tensile);

/// Force per width at `strain`, N/m, and its slope dN/dstrain, N/m, read from the table.
double tensile_force(const model::TensileLaw& law, double strain);
double tensile_slope(const model::TensileLaw& law, double strain);

/// The law of cloths that lie on one another: forces at equal strain add, each times its factor, and `linear` (N/m) times
/// the strain. Its knots are those of all of them. Needs one law at least.
model::TensileLaw add_laws(const std::vector<std::pair<const model::TensileLaw*, double>>& laws, double linear);

}  // namespace garment::modeller
