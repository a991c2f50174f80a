#include "interpreter/cli/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "runtime/base/number.hpp"
#include "runtime/body/frame.hpp"
#include "runtime/body/mend.hpp"
#include "runtime/body/obj_reader.hpp"
#include "runtime/body/person.hpp"
#include "runtime/body/stance.hpp"
#include "runtime/render/measure_picture.hpp"

namespace garment::cli {
namespace {

using body::PersonMeasure;
using nlohmann::ordered_json;

struct Measured {
  std::string name;
  body::Stance stance;
  std::vector<PersonMeasure> measures;
  std::optional<body::Frame> stated;  ///< of a mannequin
};

double metres_of(const std::string& unit) { return unit == "mm" ? 0.001 : unit == "in" ? 0.0254 : 0.01; }

std::optional<Measured> measure_mesh(const body::TriangleMesh& mesh, std::optional<double> unit,
                                     const std::string& name, Findings& findings) {
  body::StanceResult found = body::find_stance(mesh, unit, name);
  findings.insert(findings.end(), found.findings.begin(), found.findings.end());
  if (!found.stance) return std::nullopt;
  Measured out{name, std::move(*found.stance), {}, {}};
  out.measures = body::measure_person(out.stance.mesh, out.stance.marks, out.stance.head);
  if (std::none_of(out.measures.begin(), out.measures.end(),
                   [](const PersonMeasure& m) { return m.name == "biceps"; }))
    findings.push_back({"G0719",
                        Severity::note,
                        fmt::format("no arm of `{}` was found; what is measured on arms is left out", name),
                        {},
                        "hold the arms clear of the trunk"});
  return out;
}

ExitCode measure_file(const MeasureOptions& options, std::vector<Measured>& all, Host& host,
                      Terminal& terminal) {
  const std::string& file = options.project.file;
  const HostResult<std::string> text = host.read_file(file, body::kMaxObjBytes);
  if (!text) {
    show({plain_error("G0901", fmt::format("cannot read `{}`: {}", file, text.error.message),
                      "check the path")},
         {}, terminal);
    return kInputOutput;
  }
  const std::string name = std::filesystem::path(file).filename().string();
  body::MeshResult read = body::read_obj_as_is(*text.value, name);
  Findings findings = std::move(read.findings);
  if (read.mesh) {
    const body::Mended mended = body::mend(*read.mesh);
    if (mended.holes + mended.turned > 0)
      findings.push_back(
          {"G0718",
           Severity::note,
           fmt::format(
               "`{}` has {} holes and {} faces that look the wrong way; they were mended for measuring", name,
               mended.holes, mended.turned),
           {},
           "to drape on it, close the holes and recalculate the normals in a modelling program"});
    if (auto one = measure_mesh(*read.mesh, options.scale, name, findings)) all.push_back(std::move(*one));
  }
  show(interpreter::to_diagnostics(findings, interpreter::Origins{}), {}, terminal);
  return has_errors(findings) ? kDiagnostics : kOk;
}

ExitCode measure_script(const MeasureOptions& options, std::vector<Measured>& all, Host& host,
                        Terminal& terminal) {
  Project project;
  if (ExitCode code = load(project, options.project, host, terminal); code != kOk) return code;
  Findings findings;
  for (const body::Body& body : project.result.bodies) {
    auto one = measure_mesh(body.mesh, 1, body.name, findings);
    if (!one) continue;
    for (const design::Body& declared : project.result.garment.bodies)
      if (declared.name == body.name) one->stated = body::make_frame(declared).frame;
    all.push_back(std::move(*one));
  }
  if (project.result.bodies.empty())
    findings.push_back({"G0714",
                        Severity::error,
                        fmt::format("`{}` declares no body", options.project.file),
                        {},
                        "add one, as in `body form = bodies.woman(size: 40)`"});
  show(interpreter::to_diagnostics(findings, project.result.origins), project.sources, terminal);
  return has_errors(findings) ? kDiagnostics : kOk;
}

std::string in_unit(double metres, const std::string& unit) {
  return fmt::format("{:.1f}", metres / metres_of(unit));
}

/// What the script states for a measure, where it does.
struct Stated {
  std::optional<double> height, size;
};
Stated stated_of(const Measured& body, const PersonMeasure& m) {
  if (!body.stated) return {};
  if (m.kind == PersonMeasure::Kind::level) {
    const auto level = body.stated->levels.find(m.name);
    return level == body.stated->levels.end() ? Stated{} : Stated{level->second.height, level->second.girth};
  }
  const auto length = body.stated->lengths.find(m.name);
  return length == body.stated->lengths.end() ? Stated{} : Stated{std::nullopt, length->second};
}

std::string table(const Measured& body, const std::string& unit) {
  auto shown = [&](std::optional<double> x) { return x ? in_unit(*x, unit) : std::string(); };
  const bool stated = body.stated.has_value();
  std::string out = fmt::format("{} [{}]\n", body.name, unit);
  out += fmt::format("  {:<18}{:>10}{:>10}", "level", "height", "girth") +
         (stated ? fmt::format("{:>18}{:>10}", "stated: height", "girth") : "") + "\n";
  for (const PersonMeasure& m : body.measures) {
    if (m.kind != PersonMeasure::Kind::level) continue;
    out += fmt::format("  {:<18}{:>10}{:>10}", m.name, shown(m.height), shown(m.size));
    if (const Stated s = stated_of(body, m); stated)
      out += fmt::format("{:>18}{:>10}", shown(s.height), shown(s.size));
    out += "\n";
  }
  out += fmt::format("  {:<18}{:>20}", "length", "") + (stated ? fmt::format("{:>28}", "stated") : "") + "\n";
  for (const PersonMeasure& m : body.measures) {
    if (m.kind != PersonMeasure::Kind::length) continue;
    out += fmt::format("  {:<18}{:>20}", m.name, shown(m.size));
    if (stated) out += fmt::format("{:>28}", shown(stated_of(body, m).size));
    out += "\n";
  }
  std::string trimmed;  // no blanks at the ends of lines
  for (std::size_t at = 0; at < out.size();) {
    const std::size_t end = out.find('\n', at), last = out.find_last_not_of(' ', end - 1);
    trimmed += out.substr(at, last + 1 - at) + "\n";
    at = end + 1;
  }
  return trimmed;
}

std::string csv(const std::vector<Measured>& all, const std::string& unit) {
  std::string out = fmt::format("body,measure,height [{0}],size [{0}]\n", unit);
  for (const Measured& body : all)
    for (const PersonMeasure& m : body.measures)
      out += fmt::format("{},{},{},{}\n", body.name, m.name, m.height ? in_unit(*m.height, unit) : "",
                         in_unit(m.size, unit));
  return out;
}

ordered_json as_json(const Measured& body) {
  auto rounded = [](double x) { return std::round(x * 1e5) / 1e5; };
  ordered_json levels = ordered_json::object(), lengths = ordered_json::object();
  for (const PersonMeasure& m : body.measures) {
    if (m.kind == PersonMeasure::Kind::level)
      levels[m.name] = {{"height", rounded(*m.height)}, {"girth", rounded(m.size)}};
    else
      lengths[m.name] = rounded(m.size);
  }
  return {
      {"name", body.name},
      {"unit", "m"},
      {"file", {{"metres_per_unit", body.stance.unit}, {"up", body.stance.up}, {"front", body.stance.front}}},
      {"head", body.stance.head},
      {"levels", std::move(levels)},
      {"lengths", std::move(lengths)}};
}

ExitCode write_picture(const MeasureOptions& options, const Measured& body, Host& host, Terminal& terminal) {
  std::vector<render::TapeCourse> tapes;
  for (const PersonMeasure& m : body.measures) {
    const bool level = m.kind == PersonMeasure::Kind::level;
    if (!level &&
        (m.name == "stature" || m.name == "crotch_height" || m.name == "upper_arm_length" ||
         m.name.ends_with("_breadth") || m.name.ends_with("_depth")) &&
        m.name != "shoulder_breadth")
      continue;  // they would lie over the others
    tapes.push_back({m.name + " " + in_unit(m.size, options.unit), m.course, level, m.name == "back_length"});
  }
  const std::string stature =
      body.stance.head
          ? fmt::format(", stature {} {}", in_unit(body.stance.marks.stature, options.unit), options.unit)
          : "";
  const std::string bytes = render::render_measures(
      body.stance.mesh, tapes,
      fmt::format("{}{}. Girths red, lengths blue, in {}.", body.name, stature, options.unit));
  const HostResult<bool> written = host.write_file(options.picture, bytes);
  if (written) return kOk;
  show({plain_error("G0902", fmt::format("cannot write `{}`: {}", options.picture, written.error.message),
                    "choose another name")},
       {}, terminal);
  return kInputOutput;
}

}  // namespace

ExitCode measure(const MeasureOptions& options, Host& host, Terminal& terminal) {
  terminal.keep_diagnostics();
  std::vector<Measured> all;
  ExitCode code = ends_with(options.project.file, ".garment") ? measure_script(options, all, host, terminal)
                                                              : measure_file(options, all, host, terminal);
  if (terminal.options().json) {
    ordered_json document{{"bodies", ordered_json::array()}};
    for (const Measured& body : all) document["bodies"].push_back(as_json(body));
    terminal.document(document.dump());
  } else if (options.csv) {
    if (!all.empty()) terminal.result(csv(all, options.unit));
  } else {
    for (const Measured& body : all) terminal.result(table(body, options.unit));
  }
  if (!options.picture.empty() && !all.empty())
    if (ExitCode drawn = write_picture(options, all.front(), host, terminal); code == kOk) code = drawn;
  return code;
}

}  // namespace garment::cli
