#include "interpreter/cli/modelling.hpp"

#include "interpreter/language/modelling.hpp"
#include "runtime/modeller/unmodelled.hpp"

namespace garment::cli {
namespace {

/// A person reads once what cannot be modelled, a program each by itself.
void show_findings(const Findings& findings, const Project& project, Terminal& terminal) {
  show(interpreter::to_diagnostics(terminal.options().json ? findings : modeller::in_one(findings), project.result.origins),
       project.sources, terminal);
}

}  // namespace

std::optional<model::Model> build_model(Project& project, Terminal& terminal) {
  modeller::ModelResult built = interpreter::model_of(project.result.garment, project.result.bodies, project.result.acts);
  show_findings(built.findings, project, terminal);
  if (has_errors(built.findings)) return std::nullopt;
  return std::move(built.model);
}

bool measures_in_rounds(const std::vector<interpreter::Act>& acts) {
  bool varies = false;
  for (const interpreter::Act& act : acts) {
    if (std::holds_alternative<interpreter::DrapeAct>(act.act)) return false;
    varies = varies || std::holds_alternative<interpreter::VaryAct>(act.act);
  }
  return varies;
}

bool check_acts(const Project& project, Terminal& terminal) {
  grammar::Diagnostics told;
  auto warn = [&told](const char* code, const char* message, const char* help, grammar::Span span) {
    grammar::Diagnostic d = plain_error(code, message, help);
    d.severity = Severity::warning;
    d.labels.push_back({span, ""});
    told.push_back(d);
  };
  const bool in_rounds = measures_in_rounds(project.result.acts);
  bool draped = false, right = true;
  for (const interpreter::Act& act : project.result.acts) {
    const auto* drape = std::get_if<interpreter::DrapeAct>(&act.act);
    draped = draped || drape != nullptr;
    const bool expects = std::holds_alternative<interpreter::ExpectAct>(act.act);
    const bool measures = !in_rounds && std::holds_alternative<interpreter::MeasureAct>(act.act);
    if (!draped && right && (expects || measures)) {
      warn("G0325", expects ? "`expect` stands before any `drape`, so there is nothing to ask"
                            : "`measure` stands before any `drape`, so there is nothing to ask",
           "write `drape until rest` above it", act.span);
      told.back().severity = Severity::error;
      right = false;
    }
  }
  show(told, project.sources, terminal);
  return right;
}

ExitCode check_model(Project& project, bool whole, Terminal& terminal) {
  Findings missing = modeller::find_unmodelled(project.result.garment, Severity::warning);
  show_findings(missing, project, terminal);
  if (!check_acts(project, terminal)) return kDiagnostics;
  if (project.result.script != nullptr && project.result.garment.panels.empty() && interpreter::is_library(*project.result.script))
    return kOk;
  const bool quick = !whole && !project.is_pattern && !project.result.garment.panels.empty();
  if (!missing.empty() || quick) return kOk;
  return build_model(project, terminal) ? kOk : kDiagnostics;
}

}  // namespace garment::cli
