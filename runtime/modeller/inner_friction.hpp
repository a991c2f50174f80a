#pragma once
// Friction inside the cloth: what the fabrics' records say of it, for the sliders of the simulator (docs/physics.md, section 2).
#include "runtime/modeller/elements.hpp"

namespace garment::modeller {

class ClothFields;

/// The garment asks for hysteresis and one of its fabrics has any.
bool slides(const design::Garment& garment);

/// The share f of the tension of `law` that is friction, so that the loop up to the recorded extension and back returns RT of the
/// work: 1 - RT = 2 f less the triangle that the slider cuts off where the load turns, before it slips.
double tensile_slip(const design::Tensile& tensile, const model::TensileLaw& law);

/// HB along warp and weft about a place of a panel, N.
Eigen::Vector2d bending_friction_at(const std::vector<MeshedPanel>& panels, const ClothFields& fields, model::Index panel,
                                    const Point2& at);

/// A fitted stencil that was added last slides along `warp` (a unit vector of its chart) and across it: HB along both, N, over
/// `area`, m^2; `plate` in the chart's axes.
void add_fit_slip(const Eigen::Vector2d& warp, const Eigen::Vector2d& friction, double area, const Eigen::Matrix3d& plate,
                  model::Model& model);

/// Fills cell_slip and membrane_slip.
void add_shear_slip(const std::vector<MeshedPanel>& panels, const ClothFields& fields, model::Model& model);

}  // namespace garment::modeller
