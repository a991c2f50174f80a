// The garment program: command line in, exit code out.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <thread>

#include "interpreter/cli/commands.hpp"
#include "interpreter/cli/exchange.hpp"
#include "interpreter/cli/explain.hpp"
#include "interpreter/cli/golden.hpp"
#include "interpreter/cli/lsp.hpp"
#include "interpreter/cli/measure.hpp"
#include "interpreter/cli/reference_page.hpp"
#include "interpreter/cli/run.hpp"
#include "interpreter/repl/repl.hpp"
#include "interpreter/service/textmate.hpp"
#include "runtime/base/parallel.hpp"

namespace {

using namespace garment::cli;

constexpr const char* kExamples = R"(examples:
  garment run skirt.garment                     drape a script, results go to skirt/
  garment run skirt.garment -p long=70cm -o out one parameter changed, results in out/
  garment run tee.json --body woman.obj         drape a sewing-pattern specification
  garment measure scan.obj --picture scan.png   the girths and lengths of a body
  garment check skirt.garment                   what is wrong with a script
  garment import tee.json -o tee.garment        a readable script from a specification
  garment export tee.garment -o tee.dxf         its flat pattern for another system
)";

constexpr const char* kFooter = R"(exit codes: 0 ok, 1 diagnostics, 2 usage, 3 input or output, 4 the simulation failed, 5 an expect failed
or a layer came to rest on the wrong side, 130 interrupted)";

constexpr const char* kLspHelp = R"(An editor starts this command and speaks with it; a person does not. It gives diagnostics (those of
`garment check`), hover, completion, signatures, definitions, uses, seam partners ("go to implementation", and the request
garment/seamPartners), rename, quick fixes, formatting, outline, folding and semantic tokens.

  VS Code   editors/vscode (see its README)
  Neovim    vim.lsp.start{name="garment", cmd={"garment", "lsp"}, root_dir=vim.fn.getcwd()}
  Helix     languages.toml: [language-server.garment] command = "garment", args = ["lsp"]
  Emacs     (add-to-list 'eglot-server-programs '(garment-mode "garment" "lsp")))";

struct Options {
  TerminalOptions terminal;
  int threads = 0;
  RunOptions run;
  ProjectOptions project;
  FormatOptions format;
  ImportOptions import_options;
  MeasureOptions measure;
  ExportOptions export_options;
  GoldenOptions golden;
  bool whole_check = false;
  garment::repl::ReplOptions repl;
  std::string parse_file;
  std::vector<std::string> topics;
  std::string paper = "A4";
  bool stdio = true, textmate = false, list_codes = false;
};

void add_common(CLI::App* command, Options& o) {
  command->add_flag("--json", o.terminal.json, "machine-readable output on standard output");
  command->add_flag("-q,--quiet", o.terminal.quiet, "say nothing but errors");
  command->add_option("--threads", o.threads, "threads to use (results do not depend on it)")->check(CLI::Range(1, 256));
}

constexpr const char* kPatternFiles = "sewing-pattern specification (.json), AAMA/ASTM DXF (.dxf) or drawing (.svg)";
constexpr const char* kExportFiles = "script (.garment), sewing-pattern specification (.json), AAMA/ASTM DXF (.dxf) or drawing (.svg)";

void add_project(CLI::App* command, ProjectOptions& p,
                 const char* files = "script (.garment) or sewing-pattern specification (.json)") {
  command->add_option("file", p.file, files)->required();
  command->add_option("-p,--param", p.params, "set a parameter: -p long=70cm")->allow_extra_args(false);
  command->add_option("--body", p.body, "OBJ file of the body that a specification is worn by");
  command->add_option("--library", p.library_dirs, "folder where `use NAME` looks first; may be given again")
      ->allow_extra_args(false);
  command->add_option("--allow-read", p.allow_read, "let the script read below this folder too (may be repeated)")
      ->allow_extra_args(false);
  command->add_option("--allow-write", p.allow_write, "let `save` write below this folder too (may be repeated)")
      ->allow_extra_args(false);
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  o.run.project.stdlib_dir = o.export_options.project.stdlib_dir = o.project.stdlib_dir = GARMENT_STDLIB_DIR;
  o.measure.project.stdlib_dir = GARMENT_STDLIB_DIR;
  o.golden.stdlib_dir = o.repl.stdlib_dir = GARMENT_STDLIB_DIR;
  CLI::App app{std::string(kExamples) + "\nGarment describes garments and drapes them."};
  app.name("garment");
  app.set_version_flag("--version", std::string("garment ") + GARMENT_VERSION);
  app.require_subcommand(1);
  app.footer(kFooter);

  auto* run_command = app.add_subcommand("run", "drape a script or a specification and write the results");
  add_project(run_command, o.run.project);
  add_common(run_command, o);
  run_command->add_option("-o,--out", o.run.out, "folder for the results (default: the script's name, here)");
  run_command->add_flag("!--no-pictures", o.run.pictures, "write no pictures");
  run_command->add_flag("!--no-self-collision", o.run.self_collision, "cloth passes through cloth: faster, for comparisons");
  run_command->add_flag("--ply", o.run.ply, "also write garment.ply, with strain");
  run_command->add_option("--paper", o.paper, "sheets of a .pdf pattern: " + garment::io::paper_names())->capture_default_str();
  run_command->add_flag("--resume", o.run.checkpoints.resume, "go on from the last checkpoint in the results folder");
  run_command->add_option("--checkpoint", o.run.checkpoints.seconds, "seconds between two checkpoints of a drape")
      ->check(CLI::Range(0.0, 1e6))->capture_default_str();
  run_command->add_flag("!--no-checkpoint", o.run.checkpoints.write, "write no checkpoints");
  run_command->add_option("--checkpoint-steps", o.run.checkpoints.steps)->check(CLI::Range(1, 1000000))->group("");  // for tests
  run_command->add_option("--max-steps", o.run.max_steps, "give up after so many steps")->check(CLI::Range(1, 1000000));

  auto* check_command = app.add_subcommand("check", "evaluate a script and say what is wrong with it");
  add_project(check_command, o.project);
  check_command->add_flag("--model", o.whole_check, "also build the bodies and the particle model, as `run` does");
  add_common(check_command, o);
  auto* model_command = app.add_subcommand("model", "show the particle model: counts, mass, areas, lengths; --json all of it");
  add_project(model_command, o.project);
  add_common(model_command, o);
  auto* parse_command = app.add_subcommand("parse", "show the syntax tree");
  parse_command->add_option("file", o.parse_file, "script")->required();
  add_common(parse_command, o);
  auto* format_command = app.add_subcommand("fmt", "lay scripts out canonically, in place");
  format_command->add_option("files", o.format.files, "scripts, folders of scripts, or - for standard input")->required();
  format_command->add_flag("--check", o.format.check, "only say whether they are; exit 1 if not");
  format_command->add_flag("--diff", o.format.diff, "only show what would change, as a unified diff; exit 1 if anything");
  format_command->add_flag("--stdout", o.format.stdout_only, "print instead of writing");
  add_common(format_command, o);
  auto* import_command = app.add_subcommand("import", "turn a pattern file into a script");
  import_command->add_option("file", o.import_options.file, kPatternFiles)->required();
  import_command->add_option("-o,--out", o.import_options.out, "file to write: a script (.garment), or any that `garment export` writes");
  import_command->add_option("--body", o.import_options.body, "OBJ file of the body that the script shall name");
  import_command->add_option("--size", o.import_options.read.size, "size to take from a file of several (default: its sample size)");
  import_command->add_flag("--sizes", o.import_options.list_sizes, "only list the sizes in the file");
  import_command->add_flag("--force", o.import_options.force, "overwrite an existing file");
  add_common(import_command, o);
  auto* measure_command = app.add_subcommand("measure", "find levels, girths and lengths on a body: a mesh, or a script's bodies");
  measure_command->add_option("file", o.measure.project.file, "mesh (.obj) of an upright person, or a script (.garment)")->required();
  measure_command->add_option("--unit", o.measure.unit, "of the numbers printed (--json is in metres)")
      ->check(CLI::IsMember({"cm", "mm", "in"}))->capture_default_str();
  measure_command->add_option("--scale", o.measure.scale, "metres for one unit of the mesh (default: guessed from its height)")
      ->check(CLI::Range(1e-6, 1e3));
  measure_command->add_flag("--csv", o.measure.csv, "comma-separated values instead of a table");
  measure_command->add_option("--picture", o.measure.picture, "also write this PNG file: the tapes on the body, front and side");
  measure_command->add_option("-p,--param", o.measure.project.params, "set a parameter of the script: -p size=42")->allow_extra_args(false);
  measure_command->add_option("--library", o.measure.project.library_dirs, "folder where `use NAME` looks first; may be given again")
      ->allow_extra_args(false);
  measure_command->add_option("--allow-read", o.measure.project.allow_read, "let the script read below this folder too (may be repeated)")
      ->allow_extra_args(false);
  add_common(measure_command, o);
  auto* export_command = app.add_subcommand("export", "write the flat pattern of a script or a pattern file");
  add_project(export_command, o.export_options.project, kExportFiles);
  export_command->add_option("-o,--out", o.export_options.out, "file to write: .json (specification), .dxf (AAMA/ASTM) or .svg")->required();
  export_command->add_option("--size", o.export_options.read.size, "size to take from a file of several (default: its sample size)");
  add_common(export_command, o);
  auto* test_command = app.add_subcommand("test", "run the golden scripts of a folder");
  test_command->add_option("folder", o.golden.folder, "folder with .garment files")->required();
  test_command->add_flag("--update", o.golden.update, "write the goldens anew and show the difference");
  test_command->add_flag("!--no-drape", o.golden.drape, "only check the scripts that would be draped");
  test_command->add_flag("--list", o.golden.list, "only name the scripts and how far each is taken");
  test_command->add_option("--filter", o.golden.filter, "only scripts with this in their path; * stands for anything");
  test_command->add_option("--junit", o.golden.junit, "also write the outcome to this file as JUnit XML");
  test_command->add_option("--library", o.golden.library_dirs, "folder where `use NAME` looks first; may be given again")
      ->allow_extra_args(false);
  test_command->add_option("-j,--jobs", o.golden.jobs, "scripts at a time")->check(CLI::Range(1, 64));
  add_common(test_command, o);
  auto* limits_command = app.add_subcommand("limits", "what a script may cost");
  add_common(limits_command, o);
  auto* repl_command = app.add_subcommand("repl", "keep a script live at a prompt: edit, ask, drape");
  repl_command->add_option("file", o.repl.file, "script to open; without it the script is empty");
  repl_command->add_option("-o,--out", o.repl.out, "folder for what `save` and `:view` write (default: the script's name, here)");
  repl_command->add_option("--library", o.repl.library_dirs, "folder where `use NAME` looks first; may be given again")
      ->allow_extra_args(false);
  repl_command->add_option("--allow-read", o.repl.allow_read, "let the script read below this folder too (may be repeated)")
      ->allow_extra_args(false);
  repl_command->add_option("--allow-write", o.repl.allow_write, "let `save` write below this folder too (may be repeated)")
      ->allow_extra_args(false);
  repl_command->add_flag("--plain", o.repl.plain, "text that is the same in every run: no times, colours, progress");
  repl_command->add_option("--max-steps", o.repl.max_steps, "let a drape give up after so many steps")->check(CLI::Range(1, 1000000));
  repl_command->add_option("--threads", o.threads, "threads to use (results do not depend on it)")->check(CLI::Range(1, 256));
  repl_command->footer("With input that is no terminal the entries are echoed, and the exit code is that of the first entry that went\n"
                       "wrong: 1 refused, 4 the simulation failed or a file was not written, 5 an expect failed or a\n"
                       "layer lies on the wrong side.");
  auto* explain_command = app.add_subcommand("explain", "the long text of diagnostic codes; what words of the language mean");
  auto* topics_option =
      explain_command->add_option("topics", o.topics, "codes as G0312, or keywords, clauses and functions as seam, ease, length");
  explain_command->add_flag("--list", o.list_codes, "name all codes")->excludes(topics_option);
  add_common(explain_command, o);
  auto* lsp_command = app.add_subcommand("lsp", "serve an editor: Language Server Protocol 3.17 on standard input and output");
  lsp_command->add_option("--library", o.project.stdlib_dir, "folder of the standard library");
  lsp_command->add_flag("--stdio", o.stdio, "talk over standard input and output (always so; editors pass it)");
  lsp_command->footer(kLspHelp);
  auto* reference_command = app.add_subcommand("reference", "print the reference page: constructs, functions, units, codes, commands");
  reference_command->add_flag("--textmate", o.textmate, "print the TextMate grammar for editors instead");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kOk : kUsage;
  }

  unsigned cores = std::thread::hardware_concurrency();
  garment::set_thread_count(o.threads > 0 ? o.threads : static_cast<int>(cores ? cores : 1));
  garment::install_interrupt_handler();
  garment::Host& host = garment::system_host();
  Terminal terminal(o.terminal);
  if (*run_command) {
    const auto paper = garment::io::find_paper(o.paper);
    if (!paper) {
      terminal.error("`--paper " + o.paper + "` is no paper; there are " + garment::io::paper_names());
      return kUsage;
    }
    o.run.paper = *paper;
    return run(o.run, host, terminal);
  }
  if (*check_command) return check(o.project, o.whole_check, host, terminal);
  if (*model_command) return show_model(o.project, host, terminal);
  if (*parse_command) return parse(o.parse_file, host, terminal);
  if (*format_command) return format(o.format, host, terminal);
  if (*import_command) return import_pattern(o.import_options, host, terminal);
  if (*measure_command) return measure(o.measure, host, terminal);
  if (*export_command) return export_pattern(o.export_options, host, terminal);
  if (*reference_command) {
    terminal.result(o.textmate ? garment::service::textmate_grammar() : reference_page(app, GARMENT_STDLIB_DIR, host));
    return kOk;
  }
  if (*limits_command) return show_limits(terminal);
  if (*repl_command) return garment::repl::run_repl(o.repl, host);
  if (*test_command) return run_goldens(o.golden, host, terminal);
  if (*lsp_command) return serve_editor(o.project.stdlib_dir, host);
  if (o.list_codes) return list_codes(terminal);
  if (o.topics.empty()) {
    terminal.error("name a code, as in `garment explain G0312`, or --list them all");
    return kUsage;
  }
  return explain(o.topics, terminal);
}
