#include "interpreter/language/modelling.hpp"

#include <algorithm>

namespace garment::interpreter {
namespace {

bool drapes(const std::vector<Act>& acts) {
  return std::any_of(acts.begin(), acts.end(), [](const Act& act) {
    return std::holds_alternative<DrapeAct>(act.act) || std::holds_alternative<VaryAct>(act.act);
  });
}

bool is_of_start(const Finding& finding) { return finding.code == "G0608" || finding.code == "G0609"; }

}  // namespace

modeller::ModelResult model_of(const design::Garment& garment, const std::vector<body::Body>& bodies, const std::vector<Act>& acts,
                               const modeller::ModelOptions& options, Findings* of_start) {
  modeller::ModelResult built = modeller::build_model(garment, bodies, options);
  if (drapes(acts)) return built;
  const auto left_out = std::stable_partition(built.findings.begin(), built.findings.end(),
                                              [](const Finding& finding) { return !is_of_start(finding); });
  if (of_start != nullptr) of_start->assign(left_out, built.findings.end());
  built.findings.erase(left_out, built.findings.end());
  return built;
}

}  // namespace garment::interpreter
