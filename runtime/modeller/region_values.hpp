#pragma once
// What regions make of the cloth, for reports.
#include "runtime/modeller/cloth_fields.hpp"

namespace garment::modeller {

/// Fills model.regions, region by region and panel by panel: means of the equivalent material over the shares of the particles that
/// lie in the region. Regions that no particle lies in are left out.
void add_region_values(const std::vector<MeshedPanel>& panels, const ClothFields& fields, model::Model& model);

}  // namespace garment::modeller
