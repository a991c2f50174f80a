#include "interpreter/cli/commands.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "interpreter/cli/modelling.hpp"
#include "interpreter/cli/study.hpp"
#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/limit_table.hpp"
#include "runtime/model/dump.hpp"

namespace garment::cli {
namespace {

/// Reads a script into `sources`; prints why not.
bool read_script(const std::string& file, Host& host, grammar::Sources& sources, grammar::SourceId& id, Terminal& terminal) {
  HostResult<std::string> text = host.read_file(file, kMaxSourceBytes);
  if (!text) {
    show({plain_error("G0901", fmt::format("cannot read `{}`: {}", file, text.error.message), "check the path")}, sources,
         terminal);
    return false;
  }
  id = sources.add(file, std::move(*text.value));
  return true;
}

nlohmann::ordered_json measures(const interpreter::Interpretation& result) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const interpreter::MeasureValue& m : result.measures) {
    nlohmann::ordered_json measure{{"name", m.name}, {"shown", m.text}};
    if (m.value) measure.update({{"value", *m.value}, {"unit", m.unit}});
    all.push_back(std::move(measure));
  }
  return all;
}

nlohmann::ordered_json solves(const interpreter::Interpretation& result) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const interpreter::SolvedValue& s : result.solved)
    all.push_back({{"name", s.name},
                   {"shown", s.text},
                   {"value", s.value},
                   {"unit", s.unit},
                   {"residual", {{"shown", s.residual}, {"value", s.residual_value}, {"unit", s.residual_unit}}},
                   {"bound", s.bound.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(s.bound)},
                   {"trials", s.trials}});
  return all;
}

ExitCode load_model(Project& project, std::optional<model::Model>& model, const ProjectOptions& options, Host& host,
                    Terminal& terminal) {
  if (ExitCode code = load(project, options, host, terminal); code != kOk) return code;
  model = build_model(project, terminal);
  return model ? kOk : kDiagnostics;
}

}  // namespace

ExitCode check(const ProjectOptions& given, bool whole, Host& host, Terminal& terminal) {
  Project project;
  terminal.keep_diagnostics();
  ProjectOptions options = given;
  options.build_bodies = whole;
  ExitCode code = load(project, options, host, terminal);
  if (code == kOk) code = check_model(project, whole, terminal);
  if (code == kOk) code = check_studies(options, project.result.acts, host, terminal);
  const design::Garment& g = project.result.garment;
  if (terminal.options().json) {
    nlohmann::ordered_json all{{"ok", code == kOk}};
    if (code == kOk)
      all.update({{"panels", g.panels.size()},
                  {"seams", g.seams.size()},
                  {"measures", measures(project.result)},
                  {"solves", solves(project.result)}});
    terminal.document(all.dump());
  }
  if (code != kOk) return code;
  if (!terminal.options().json && g.panels.empty() && project.result.script != nullptr && interpreter::is_library(*project.result.script))
    terminal.note(fmt::format("{}: ok, a library", options.file));
  else if (!terminal.options().json)
    terminal.note(fmt::format("{}: ok, {}, {}", options.file, plural(g.panels.size(), "panel"), plural(g.seams.size(), "seam")));
  return kOk;
}

ExitCode show_limits(Terminal& terminal) {
  terminal.result(terminal.options().json ? interpreter::limits_json() : interpreter::limits_text());
  return kOk;
}

ExitCode parse(const std::string& file, Host& host, Terminal& terminal) {
  grammar::Sources sources;
  grammar::SourceId id = 0;
  if (!read_script(file, host, sources, id, terminal)) return kInputOutput;
  grammar::ParseResult parsed = grammar::parse(sources, id, interpreter::vocabulary());
  terminal.result(terminal.options().json ? grammar::to_json(parsed.script, sources) : grammar::to_outline(parsed.script));
  if (!terminal.options().json) show(parsed.diagnostics, sources, terminal);
  for (const grammar::Diagnostic& d : parsed.diagnostics)
    if (d.severity == Severity::error) return kDiagnostics;
  return kOk;
}

ExitCode show_model(const ProjectOptions& options, Host& host, Terminal& terminal) {
  Project project;
  terminal.keep_diagnostics();
  std::optional<model::Model> model;
  ExitCode code = load_model(project, model, options, host, terminal);
  if (terminal.options().json)
    terminal.document(code == kOk ? model::dump_json(*model) : "");
  else if (code == kOk)
    terminal.result(model::summary_text(*model));
  return code;
}

}  // namespace garment::cli
