#include "runtime/modeller/inner_friction.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/modeller/layered_cloth.hpp"

namespace garment::modeller {
namespace {

using Eigen::Vector2d;
using model::Index;

constexpr double kMostSlip = 0.45;  // of the tension: cloth always springs back a little

bool has_friction(const design::Fabric& f) {
  return f.shear_friction > 0 || f.shear_friction_5 > 0 || f.bending_friction[0] > 0 || f.bending_friction[1] > 0 ||
         f.tensile[0].resilience < 1 || f.tensile[1].resilience < 1;
}

Vector2d shear_friction_at(const MeshedPanel& p, const ClothFields& fields, std::size_t panel, const Point2& at) {
  if (fields.plain(panel)) return {p.fabric->shear_friction, p.fabric->shear_friction_5};
  return ClothAt(fields, panel, p.frame, at, std::max(p.frame.hp, p.frame.hq)).shear_friction();
}

}  // namespace

bool slides(const design::Garment& garment) {
  return garment.scene.slides() && std::any_of(garment.fabrics.begin(), garment.fabrics.end(), has_friction);
}

double tensile_slip(const design::Tensile& t, const model::TensileLaw& law) {
  const double work = 0.5 * t.linearity * t.max_force * t.max_strain;  // WT
  const double k = model::kTensilePreSlip * *std::max_element(law.slope.begin(), law.slope.end());
  const double cut = 2 * t.max_force * t.max_force / (k * work);
  double f = 0;
  for (int i = 0; i < 20; ++i) f = std::min(kMostSlip, 0.5 * (1 - t.resilience + cut * f * f));
  return std::max(0.0, f);
}

Vector2d bending_friction_at(const std::vector<MeshedPanel>& panels, const ClothFields& fields, Index panel, const Point2& at) {
  const MeshedPanel& p = panels[static_cast<std::size_t>(panel)];
  if (fields.plain(static_cast<std::size_t>(panel))) return {p.fabric->bending_friction[0], p.fabric->bending_friction[1]};
  return ClothAt(fields, static_cast<std::size_t>(panel), p.frame, at, std::max(p.frame.hp, p.frame.hq)).bending_friction();
}

void add_fit_slip(const Vector2d& warp, const Vector2d& friction, double area, const Eigen::Matrix3d& plate, model::Model& model) {
  const auto fit = static_cast<Index>(model.fit_area.size() - 1);
  for (int d = 0; d < 2; ++d) {
    if (!(friction[d] > 0)) continue;
    const Vector2d t = d == 0 ? warp : Vector2d(-warp.y(), warp.x());
    const Eigen::Vector3d bent(t.x() * t.x(), t.y() * t.y(), t.x() * t.y());  // curvature 1 along t
    model.fit_slip.push_back(fit);
    model.fit_slip_particle.push_back(model.fit_particle.back());  // the centre
    model.fit_slip_way.push_back(seen_along(t).row(0).transpose());
    model.fit_slip_moment.push_back(friction[d] * area);
    model.fit_slip_rigidity.push_back(std::max(0.0, bent.dot(plate * bent)) * area);
  }
}

void add_shear_slip(const std::vector<MeshedPanel>& panels, const ClothFields& fields, model::Model& model) {
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const MeshedPanel& p = panels[i];
    for (const auto& c : p.mesh.cells)
      model.cell_slip.push_back(shear_friction_at(p, fields, i, (p.mesh.at[c[0]] + p.mesh.at[c[2]]) / 2));
    for (const auto& t : p.mesh.cut)
      model.membrane_slip.push_back(shear_friction_at(p, fields, i, (p.mesh.at[t[0]] + p.mesh.at[t[1]] + p.mesh.at[t[2]]) / 3));
  }
}

}  // namespace garment::modeller
