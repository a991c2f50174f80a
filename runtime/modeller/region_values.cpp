#include "runtime/modeller/region_values.hpp"

#include <algorithm>

#include "runtime/modeller/layered_cloth.hpp"

namespace garment::modeller {
namespace {

/// The cloth of a square about a place, added with a weight, m^2.
void add(const ClothFields& fields, const ClothAt& cloth, double area, model::RegionValues& to) {
  const Eigen::Matrix3d plate = cloth.plate();
  to.area += area;
  to.areal_density += area * cloth.areal_density();
  to.thickness += area * cloth.thickness();
  to.friction += area * cloth.friction();
  to.shear += area * cloth.shear();
  to.twist += area * plate(2, 2) / 4;  // the plate has 4 Ct there
  for (int k = 0; k < 2; ++k) {
    double slope = cloth.linear(k);
    for (const LayeredCloth::Tensile& t : cloth.tensile(k)) slope += t.factor * fields.slope(t.law / 2, t.law % 2);
    to.tensile[k] += area * slope;
    to.bending[k] += area * plate(k, k);
    to.rest_length[k] += area * cloth.rest(k);
  }
}

void divide(double by, model::RegionValues& values) {
  for (double* value : {&values.areal_density, &values.thickness, &values.friction, &values.shear, &values.twist}) *value /= by;
  for (int k = 0; k < 2; ++k) {
    values.tensile[k] /= by;
    values.bending[k] /= by;
    values.rest_length[k] /= by;
  }
}

}  // namespace

void add_region_values(const std::vector<MeshedPanel>& panels, const ClothFields& fields, model::Model& model) {
  const design::Garment& garment = fields.garment();
  for (const design::Region& region : garment.regions)
    for (const design::RegionPart& part : region.parts) {
      if (part.panel < 0 || part.panel >= static_cast<int>(panels.size())) continue;
      const MeshedPanel& panel = panels[part.panel];
      const design::RegionTest test(garment.panels[part.panel], part.shape);
      model::RegionValues values{region.name, panel.panel->name, region.origin};
      for (std::size_t v = 0; v < panel.mesh.at.size(); ++v)
        if (panel.vertex_area[v] > 0 && test.contains(panel.mesh.at[v]))
          add(fields, ClothAt(fields, static_cast<std::size_t>(part.panel), panel.frame, panel.mesh.at[v],
                              std::max(panel.frame.hp, panel.frame.hq)),
              panel.vertex_area[v], values);
      if (!(values.area > 0)) continue;
      divide(values.area, values);
      model.regions.push_back(std::move(values));
    }
}

}  // namespace garment::modeller
