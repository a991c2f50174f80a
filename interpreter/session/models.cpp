#include "interpreter/session/models.hpp"

#include <algorithm>

#include "runtime/modeller/modeller.hpp"

namespace garment::session {
namespace {

constexpr std::size_t kWorthCoarse = 2000;  // particles from which a coarser grid saves time

}  // namespace

std::vector<model::Model> coarse_models(const design::Garment& garment, const std::vector<body::Body>& bodies,
                                        const model::Model& fine, bool dress) {
  std::vector<model::Model> models;
  std::size_t particles = fine.n_particles();
  modeller::ModelOptions options;
  options.dress = dress;
  while (particles > kWorthCoarse) {
    options.coarsen *= 2;
    modeller::ModelResult built = modeller::build_model(garment, bodies, options);
    if (!built.model || has_errors(built.findings) || built.model->n_particles() >= particles) break;
    particles = built.model->n_particles();
    models.push_back(std::move(*built.model));
  }
  std::reverse(models.begin(), models.end());
  return models;
}

}  // namespace garment::session
