#include "interpreter/cli/exchange.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "interpreter/language/unparse.hpp"
#include "interpreter/language/unparse_text.hpp"
#include "runtime/body/body.hpp"
#include "runtime/io/pattern_layout.hpp"

namespace garment::cli {
namespace {

constexpr std::uint64_t kMaxImportBytes = 64u << 20;
constexpr const char* kBody = "form";  // what imported scripts call their body

void show_error(const char* code, std::string message, const char* help, Terminal& terminal) {
  show({plain_error(code, std::move(message), help)}, grammar::Sources{}, terminal);
}

ExitCode write(const std::string& out, const std::string& bytes, Host& host, Terminal& terminal) {
  HostResult<bool> written = host.write_file(out, bytes);
  if (written) return kOk;
  show_error("G0902", fmt::format("cannot write `{}`: {}", out, written.error.message), "", terminal);
  return kInputOutput;
}

/// Reads and says what is wrong; `file` holds a garment where this is kOk.
ExitCode read(const std::string& path, PatternFileOptions options, PatternFile& file, Host& host,
              Terminal& terminal) {
  const std::string ending = ending_of(path);
  HostResult<std::string> text = host.read_file(path, kMaxImportBytes);
  if (!text) {
    show_error("G0901", fmt::format("cannot read `{}`: {}", path, text.error.message), "check the path",
               terminal);
    return kInputOutput;
  }
  if (options.title.empty()) options.title = stem_of(path);
  file = read_pattern_file(ending, *text.value, options);
  interpreter::Origins origins;
  show(interpreter::to_diagnostics(file.findings, origins), grammar::Sources{}, terminal);
  return file.garment ? kOk : kDiagnostics;
}

bool is_written(const std::string& ending) {
  return ending == ".json" || ending == ".dxf" || ending == ".svg";
}

ExitCode write_pattern(const std::string& out, const design::Garment& garment,
                       const io::PatternLayout* layout, Host& host, Terminal& terminal) {
  PatternBytes made = write_pattern_file(ending_of(out), garment, layout);
  interpreter::Origins origins;
  show(interpreter::to_diagnostics(made.findings, origins), grammar::Sources{}, terminal);
  if (!made.bytes) return kDiagnostics;
  if (ExitCode code = write(out, *made.bytes, host, terminal); code != kOk) return code;
  terminal.note(fmt::format("{}: {}, {}", out, plural(garment.panels.size(), "panel"),
                            plural(garment.seams.size(), "seam")));
  return kOk;
}

/// The layout under the names that the script spells, as its last lines.
std::vector<std::string> trailer(io::PatternLayout layout, const design::Garment& garment,
                                 const std::string& body_name) {
  const interpreter::text::Names names = interpreter::text::make_names(garment, body_name);
  design::Garment spelled = garment;
  for (std::size_t p = 0; p < garment.panels.size(); ++p) spelled.panels[p].name = names.panels[p];
  for (std::size_t s = 0; s < garment.seams.size(); ++s) spelled.seams[s].name = names.seams[s];
  for (io::PanelLayout& panel : layout.panels)
    for (std::size_t p = 0; p < garment.panels.size(); ++p)
      if (panel.panel == garment.panels[p].name) {
        panel.panel = names.panels[p];
        break;
      }
  for (io::StitchLayout& stitch : layout.stitches)
    for (std::size_t s = 0; s < garment.seams.size(); ++s)
      if (stitch.seam == garment.seams[s].name) {
        stitch.seam = names.seams[s];
        break;
      }
  std::vector<std::string> lines{"# What the specification says beyond this script, for `garment export`."};
  for (const std::string& line : io::layout_lines(layout, spelled))
    lines.push_back(std::string(io::kLayoutMark) + line);
  return lines;
}

ExitCode write_script(const ImportOptions& options, const std::string& out, PatternFile& file, Host& host,
                      Terminal& terminal) {
  interpreter::UnparseOptions unparse_options;
  unparse_options.title = file.garment->title;
  if (!options.body.empty()) {
    design::Body declared;
    declared.name = kBody;
    declared.shape = design::MeshFile{std::filesystem::absolute(options.body).string(), 1};
    body::BodyResult built = body::build_body(declared, host, "");
    interpreter::Origins origins;
    show(interpreter::to_diagnostics(built.findings, origins), grammar::Sources{}, terminal);
    if (!built.body) return kDiagnostics;
    if (file.frame) {
      const double raised = share_frame(*file.garment, *file.frame, *built.body);
      if (file.layout) file.layout->raised = raised;
    }
    std::error_code error;
    std::filesystem::path relative = std::filesystem::proximate(options.body, folder_of(out), error);
    unparse_options.body = fmt::format("mesh(\"{}\")", error ? options.body : relative.string());
  }
  if (file.layout)
    unparse_options.trailer =
        trailer(*file.layout, *file.garment,
                unparse_options.body.empty() ? std::string() : unparse_options.body_name);
  if (!file.frame) {  // flat pieces: nothing is sewn yet
    unparse_options.acts.clear();
    unparse_options.comments = file.notes;
  }
  if (ExitCode code = write(out, interpreter::unparse(*file.garment, unparse_options), host, terminal);
      code != kOk)
    return code;
  terminal.note(fmt::format("{}: {}, {}", out, plural(file.garment->panels.size(), "panel"),
                            plural(file.garment->seams.size(), "seam")));
  return kOk;
}

ExitCode refuse_ending(const std::string& file, const char* known, Terminal& terminal) {
  show_error("G0907", fmt::format("`{}` has the ending `{}`, expected {}", file, ending_of(file), known),
             "the ending of a file says its format", terminal);
  return kUsage;
}

/// Errors, but none that touches what is written: how a garment is sewn that twists it is as good as any on
/// paper.
bool only_twisted(const Project& project) {
  bool twisted = false;
  for (const grammar::Diagnostic& d : project.result.diagnostics) {
    if (d.severity != Severity::error) continue;
    if (d.code != "G0510") return false;
    twisted = true;
  }
  return twisted;
}

}  // namespace

ExitCode import_pattern(const ImportOptions& options, Host& host, Terminal& terminal) {
  const std::string out = options.out.empty() ? stem_of(options.file) + ".garment" : options.out;
  if (!is_pattern_ending(ending_of(options.file)))
    return refuse_ending(options.file, ".json, .dxf or .svg", terminal);
  if (!options.list_sizes && ending_of(out) != ".garment" && !is_written(ending_of(out)))
    return refuse_ending(out, ".garment, .json, .dxf or .svg", terminal);
  if (!options.list_sizes && !options.force && std::filesystem::exists(out)) {
    show_error("G0903", fmt::format("`{}` exists already", out),
               "choose another name with -o, or add --force", terminal);
    return kInputOutput;
  }
  PatternFile file;
  ExitCode code = read(options.file, options.read, file, host, terminal);
  if (options.list_sizes && code != kInputOutput) {
    for (const std::string& size : file.sizes) terminal.result(size + "\n");
    return code;
  }
  if (code != kOk) return code;
  for (const std::string& note : file.notes) terminal.note("note: " + note);
  if (is_written(ending_of(out))) return write_pattern(out, *file.garment, file.layout.get(), host, terminal);
  return write_script(options, out, file, host, terminal);
}

ExitCode export_pattern(const ExportOptions& options, Host& host, Terminal& terminal) {
  const std::string ending = ending_of(options.project.file);
  if (!is_written(ending_of(options.out))) return refuse_ending(options.out, ".json, .dxf or .svg", terminal);
  if (is_pattern_ending(ending)) {
    PatternFile file;
    if (ExitCode code = read(options.project.file, options.read, file, host, terminal); code != kOk)
      return code;
    return write_pattern(options.out, *file.garment, file.layout.get(), host, terminal);
  }
  Project project;
  ProjectOptions script = options.project;
  script.only_errors = true;
  script.build_bodies = false;
  if (ExitCode code = load(project, script, host, terminal); code != kOk && !only_twisted(project))
    return code;
  bool found = false;
  const io::PatternLayout layout = io::layout_of_script(project.sources[project.source].text, found);
  return write_pattern(options.out, project.result.garment, found ? &layout : nullptr, host, terminal);
}

}  // namespace garment::cli
