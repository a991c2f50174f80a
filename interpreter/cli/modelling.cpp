#include "interpreter/cli/modelling.hpp"

#include <algorithm>

#include "runtime/modeller/modeller.hpp"
#include "runtime/modeller/unmodelled.hpp"

namespace garment::cli {
namespace {

constexpr std::size_t kWorthCoarse = 2000;  // particles from which a coarser grid saves time

}  // namespace

std::optional<model::Model> build_model(Project& project, Terminal& terminal) {
  modeller::ModelResult built = modeller::build_model(project.result.garment, project.result.bodies);
  show(interpreter::to_diagnostics(built.findings, project.result.origins), project.sources, terminal);
  if (has_errors(built.findings)) return std::nullopt;
  return std::move(built.model);
}

ExitCode check_model(Project& project, Terminal& terminal) {
  Findings missing = modeller::find_unmodelled(project.result.garment, Severity::warning);
  show(interpreter::to_diagnostics(missing, project.result.origins), project.sources, terminal);
  if (!missing.empty()) return kOk;
  return build_model(project, terminal) ? kOk : kDiagnostics;
}

std::vector<model::Model> build_coarse_models(const Project& project, const model::Model& fine) {
  std::vector<model::Model> models;
  std::size_t particles = fine.n_particles();
  modeller::ModelOptions options;
  while (particles > kWorthCoarse) {
    options.coarsen *= 2;
    modeller::ModelResult built = modeller::build_model(project.result.garment, project.result.bodies, options);
    if (!built.model || has_errors(built.findings) || built.model->n_particles() >= particles) break;
    particles = built.model->n_particles();
    models.push_back(std::move(*built.model));
  }
  std::reverse(models.begin(), models.end());
  return models;
}

}  // namespace garment::cli
