#include "interpreter/cli/project.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "runtime/body/body.hpp"
#include "runtime/io/pattern_json.hpp"

namespace garment::cli {
namespace {

constexpr std::uint64_t kMaxPatternBytes = 16u << 20;

bool parse_params(const std::vector<std::string>& given, std::map<std::string, std::string>& params, Terminal& terminal) {
  for (const std::string& p : given) {
    std::size_t at = p.find('=');
    if (at == std::string::npos || at == 0) {
      terminal.error(fmt::format("error[G1001]: `-p {}` is not NAME=VALUE\n   = help: write for example -p long=70cm", p));
      return false;
    }
    params[p.substr(0, at)] = p.substr(at + 1);
  }
  return true;
}

double lowest_point(const body::Body& body) {
  double low = 1e300;
  for (const auto& v : body.mesh.vertices) low = std::min(low, v.y());
  return low;
}

double height_of(const body::Body& body) {
  double high = -1e300;
  for (const auto& v : body.mesh.vertices) high = std::max(high, v.y());
  return high - lowest_point(body);
}

ExitCode load_pattern(Project& project, const ProjectOptions& options, const std::string& text, Host& host,
                      Terminal& terminal) {
  project.is_pattern = true;
  io::PatternOptions pattern_options;
  pattern_options.title = project.name;
  pattern_options.fabric = io::import_fabric();
  io::PatternResult pattern = io::read_pattern(text, pattern_options);
  interpreter::Interpretation& result = project.result;
  result.origins = interpreter::Origins{};
  result.diagnostics = interpreter::to_diagnostics(pattern.findings, result.origins);
  if (pattern.garment && options.body.empty() && options.worn)
    result.diagnostics.push_back(plain_error("G1002", "a specification needs a body to be worn by",
                                             "add --body BODY.obj"));
  if (pattern.garment && options.body.empty() && !options.worn && !pattern.garment->attachments.empty()) {
    pattern.garment->attachments.clear();
    pattern.notes.push_back("without a body it is attached to nothing; add --body BODY.obj");
  }
  if (pattern.garment && !options.body.empty()) {
    design::Body declared;
    declared.name = pattern_options.body;
    declared.shape = design::MeshFile{std::filesystem::absolute(options.body).string(), 1};
    body::BodyResult built = body::build_body(declared, host, "");
    for (const grammar::Diagnostic& d : interpreter::to_diagnostics(built.findings, result.origins))
      result.diagnostics.push_back(d);
    if (built.body) {
      share_frame(*pattern.garment, pattern.frame, *built.body);
      pattern.garment->bodies.push_back(declared);
      result.bodies.push_back(std::move(*built.body));
    }
  }
  if (pattern.garment) result.garment = std::move(*pattern.garment);
  result.acts.push_back({interpreter::DrapeAct{}, {}});
  for (const std::string& note : pattern.notes) terminal.note("note: " + note);
  show(result.diagnostics, project.sources, terminal);
  return result.ok() ? kOk : kDiagnostics;
}

}  // namespace

double share_frame(design::Garment& garment, io::PatternFrame frame, const body::Body& body) {
  bool body_on_floor = lowest_point(body) > -0.3 * height_of(body);
  double shift = io::pelvis_shift(height_of(body));
  if ((frame == io::PatternFrame::floor) == body_on_floor) return 0;
  if (frame == io::PatternFrame::floor) shift = -shift;
  io::move_garment(garment, {0, shift, 0});
  return shift;
}

grammar::Diagnostic plain_error(std::string code, std::string message, std::string help) {
  grammar::Diagnostic d;
  d.code = std::move(code);
  d.message = std::move(message);
  d.help = std::move(help);
  return d;
}

std::string stem_of(const std::string& path) { return std::filesystem::path(path).stem().string(); }

std::string folder_of(const std::string& path) {
  std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

bool ends_with(const std::string& text, std::string_view ending) {
  return text.size() >= ending.size() && text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

void show(const grammar::Diagnostics& diagnostics, const grammar::Sources& sources, Terminal& terminal) {
  if (terminal.options().json) {
    if (!diagnostics.empty()) terminal.diagnostics(grammar::render_json(diagnostics, sources));
    return;
  }
  for (const grammar::Diagnostic& d : diagnostics) {
    if (terminal.options().quiet && d.severity != Severity::error) continue;
    terminal.error(grammar::render(d, sources, terminal.color()));
  }
}

ExitCode load(Project& project, const ProjectOptions& options, Host& host, Terminal& terminal) {
  project.name = stem_of(options.file);
  bool pattern = ends_with(options.file, ".json");
  HostResult<std::string> text = host.read_file(options.file, pattern ? kMaxPatternBytes : kMaxSourceBytes);
  if (!text) {
    show({plain_error("G0901", fmt::format("cannot read `{}`: {}", options.file, text.error.message),
                      "check the path; scripts end in .garment, specifications in .json")},
         project.sources, terminal);
    return kInputOutput;
  }
  if (pattern) return load_pattern(project, options, *text.value, host, terminal);
  interpreter::InterpretOptions interpret_options;
  interpret_options.warn_unused = true;
  interpret_options.stdlib_dir = options.stdlib_dir;
  interpret_options.library_dirs = options.library_dirs;
  interpret_options.script_dir = folder_of(options.file);
  interpret_options.allow_read = options.allow_read;
  interpret_options.allow_write = options.allow_write;
  interpret_options.build_bodies = options.build_bodies;
  interpret_options.study = options.study;
  if (!parse_params(options.params, interpret_options.params, terminal)) return kUsage;
  project.source = project.sources.add(options.file, std::move(*text.value));
  project.result = interpreter::interpret(project.sources, project.source, host, interpret_options);
  grammar::Diagnostics told = project.result.diagnostics;
  if (options.only_errors)
    std::erase_if(told, [](const grammar::Diagnostic& d) { return d.severity != Severity::error; });
  show(told, project.sources, terminal);
  return project.result.ok() ? kOk : kDiagnostics;
}

}  // namespace garment::cli
