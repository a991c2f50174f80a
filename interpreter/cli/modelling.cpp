#include "interpreter/cli/modelling.hpp"

#include "runtime/modeller/modeller.hpp"
#include "runtime/modeller/unmodelled.hpp"

namespace garment::cli {
std::optional<model::Model> build_model(Project& project, Terminal& terminal) {
  modeller::ModelResult built = modeller::build_model(project.result.garment, project.result.bodies);
  show(interpreter::to_diagnostics(built.findings, project.result.origins), project.sources, terminal);
  if (has_errors(built.findings)) return std::nullopt;
  return std::move(built.model);
}

ExitCode check_model(Project& project, bool whole, Terminal& terminal) {
  Findings missing = modeller::find_unmodelled(project.result.garment, Severity::warning);
  show(interpreter::to_diagnostics(missing, project.result.origins), project.sources, terminal);
  const bool quick = !whole && !project.is_pattern && !project.result.garment.panels.empty();
  if (!missing.empty() || quick) return kOk;
  return build_model(project, terminal) ? kOk : kDiagnostics;
}

}  // namespace garment::cli
