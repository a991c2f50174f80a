#include "runtime/modeller/damping.hpp"

#include <algorithm>

namespace garment::modeller {

void add_damping(const std::vector<MeshedPanel>& panels, const ClothFields& fields, model::Model& model) {
  std::vector<double> tau(model.n_particles(), 0);
  std::vector<int> n(model.n_particles(), 0);
  bool usual = true;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const MeshedPanel& panel = panels[p];
    const double width = std::max(panel.frame.hp, panel.frame.hq);
    for (std::size_t v = 0; v < panel.mesh.at.size(); ++v) {
      double factor = fields.plain(p) ? 1 : 0;
      if (!fields.plain(p))
        for (const Patch& patch : fields.around(p, panel.mesh.at[v], width)) factor += patch.share * patch.factors.damping;
      const model::Index i = model.vertex_particle[panel.first_vertex + v];
      usual = usual && factor == 1 && panel.fabric->damping == model::kUsualDamping;
      tau[i] += factor * panel.fabric->damping;
      ++n[i];
    }
  }
  if (usual) return;
  for (std::size_t i = 0; i < tau.size(); ++i) tau[i] /= n[i];
  model.damping = std::move(tau);
}

}  // namespace garment::modeller
