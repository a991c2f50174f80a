#include "interpreter/cli/golden.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <thread>
#include <vector>

#include "interpreter/cli/golden_compare.hpp"
#include "interpreter/cli/golden_junit.hpp"
#include "interpreter/cli/project.hpp"

namespace garment::cli {
namespace {

namespace fs = std::filesystem;
constexpr std::string_view kOfDrapes = "G08";  // codes
constexpr std::uint64_t kMaxBytes = 4u << 20;
constexpr std::size_t kMaxGolden = 20u << 10;
constexpr std::string_view kToleranceLine = "#! tolerance:";

const char* stage_name(GoldenStage stage) {
  constexpr const char* kNames[] = {"parse", "format", "check", "model", "run"};
  return kNames[static_cast<int>(stage)];
}

/// By the nearest folder on the way from `root`, `root` included; nothing where none has the name of a stage.
std::optional<GoldenStage> stage_of_folder(const fs::path& script, const fs::path& root) {
  fs::path whole = fs::absolute(root).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();  // DIR/
  std::optional<GoldenStage> stage = golden_stage(whole.filename().string());
  for (const fs::path& part : script.parent_path().lexically_relative(root))
    if (const auto named = golden_stage(part.string())) stage = named;
  return stage;
}

GoldenStage stage_of(const fs::path& path, const std::string& script, const Expectations& expected,
                     const GoldenOptions& options) {
  GoldenStage stage = GoldenStage::check;
  if (expected.stage)
    stage = *expected.stage;
  else if (const auto named = stage_of_folder(path, options.folder))
    stage = *named;
  else if (has_drape(script))
    stage = GoldenStage::run;
  return stage == GoldenStage::run && !options.drape ? GoldenStage::check : stage;
}

/// `*` in `pattern` stands for anything.
bool matches(std::string_view text, std::string_view pattern) {
  std::size_t at = 0;
  while (!pattern.empty()) {
    const std::size_t star = pattern.find('*');
    const std::string_view piece = pattern.substr(0, star);
    at = text.find(piece, at);
    if (at == std::string_view::npos) return false;
    at += piece.size();
    pattern = star == std::string_view::npos ? std::string_view{} : pattern.substr(star + 1);
  }
  return true;
}

struct Result {
  GoldenVerdict verdict;
  std::string told;  ///< what is printed, failure or not
  bool updated = false;
  double drape_seconds = 0;
};

/// The golden's own tolerance line, taken off `text`.
std::string take_tolerance_line(std::string& text, std::optional<GoldenTolerance>& tolerance, std::string& malformed) {
  if (text.compare(0, kToleranceLine.size(), kToleranceLine) != 0) return "";
  const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
  const std::string line = text.substr(0, end);
  std::string value = line.substr(kToleranceLine.size());
  value.erase(value.find_last_not_of(" \r\n") + 1);
  value.erase(0, value.find_first_not_of(' '));
  tolerance = golden_tolerance(value);
  if (!tolerance) malformed = fmt::format("  its .expected file: `{}` is no tolerance\n", value);
  text.erase(0, end);
  return line;
}

/// Compares with the .expected file, or writes it.
std::string compare_golden(const fs::path& script, const Expectations& expected, const GoldenOutcome& outcome,
                           const GoldenOptions& options, Host& host, Result& result) {
  fs::path path = script;
  path.replace_extension(".expected");
  HostResult<std::string> golden = host.read_file(path.string(), kMaxGolden);
  const bool states_itself = expected.about_diagnostics || !expected.values.empty() || outcome.n_expects > 0;
  if (!golden && !fs::exists(path) && states_itself) return "";
  std::optional<GoldenTolerance> tolerance = expected.tolerance;
  std::string text = golden ? *golden.value : "", malformed;
  const std::string head = take_tolerance_line(text, tolerance, malformed);
  if (!malformed.empty()) return malformed;
  if (golden && text == outcome.text) return "";
  const std::string difference = compare_texts(text, outcome.text, tolerance);
  if (golden && difference.empty()) return "";
  if (!options.update)
    return (golden ? "" : "  has neither `#!` comments nor a .expected file; --update writes one\n") + difference;
  if (outcome.text.size() > kMaxGolden) return "  its output is over 20 KB: expect it inline instead\n";
  if (!host.write_file(path.string(), head + outcome.text)) return "  the golden could not be written\n";
  result.told = fmt::format("updated {}\n{}", path.string(), difference);
  result.updated = true;
  return "";
}

/// Errors of a script that says nothing about diagnostics, and is run or would be (`skipped_drape`).
std::string unforeseen_errors(const Expectations& expected, const GoldenOutcome& outcome, bool skipped_drape) {
  std::string text;
  if (expected.about_diagnostics || (expected.values.empty() && outcome.n_expects == 0 && !skipped_drape)) return text;
  for (const grammar::Diagnostic& d : outcome.diagnostics)
    if (d.severity == Severity::error) text += grammar::render(d, outcome.sources, false);
  return text;
}

Result test_script(const fs::path& path, const GoldenOptions& options, Host& host) {
  Result result;
  result.verdict.path = path.string();
  const double begun = host.seconds();
  std::string& failure = result.verdict.failure;
  const HostResult<std::string> script = host.read_file(path.string(), kMaxBytes);
  if (!script) {
    failure = "  cannot be read: " + script.error.message + "\n";
  } else {
    Expectations expected = read_expectations(*script.value);
    if (!expected.malformed.empty()) {
      failure = "  " + expected.malformed + "\n";
    } else {
      const GoldenStage stage = stage_of(path, *script.value, expected, options);
      if (!options.drape && !expected.stage && has_drape(*script.value))  // nothing is said of a drape that is left out
        std::erase_if(expected.diagnostics, [](const ExpectedDiagnostic& d) { return d.code.starts_with(kOfDrapes); });
      const GoldenOutcome outcome = run_golden(path.string(), *script.value, stage, {options.stdlib_dir, options.library_dirs}, host);
      result.drape_seconds = outcome.drape_seconds;
      if (expected.about_diagnostics) failure += compare_diagnostics(expected, outcome);
      failure += compare_values(expected, outcome);
      const bool skipped_drape = !options.drape && has_drape(*script.value) && !expected.stage;
      failure += unforeseen_errors(expected, outcome, skipped_drape);
      if (!skipped_drape || stage != GoldenStage::check || stage_of_folder(path, options.folder) == stage)
        failure += compare_golden(path, expected, outcome, options, host, result);
    }
  }
  result.verdict.seconds = host.seconds() - begun;
  if (!failure.empty()) result.told += fmt::format("FAILED {}\n{}", path.string(), failure);
  return result;
}

struct Found {
  std::vector<fs::path> scripts, goldens;
  std::error_code error;
};

Found find_below(const GoldenOptions& options) {
  Found found;
  fs::recursive_directory_iterator it(options.folder, found.error), end;
  for (; !found.error && it != end; it.increment(found.error)) {
    if (!matches(it->path().string(), options.filter)) continue;
    if (it->path().extension() == ".garment") found.scripts.push_back(it->path());
    if (it->path().extension() == ".expected") found.goldens.push_back(it->path());
  }
  std::sort(found.scripts.begin(), found.scripts.end());
  std::sort(found.goldens.begin(), found.goldens.end());
  return found;
}

/// Tests all scripts, `jobs` at a time; the results are in the order of the scripts.
std::vector<Result> test_all(const std::vector<fs::path>& scripts, const GoldenOptions& options, Host& host) {
  std::vector<Result> results(scripts.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t k = next++; k < scripts.size() && !host.interrupted(); k = next++)
      results[k] = test_script(scripts[k], options, host);
  };
  std::vector<std::thread> workers;
  for (int k = 1; k < options.jobs; ++k) workers.emplace_back(work);
  work();
  for (std::thread& worker : workers) worker.join();
  return results;
}

void add_orphans(const std::vector<fs::path>& goldens, std::vector<Result>& results) {
  for (const fs::path& golden : goldens) {
    fs::path script = golden;
    if (fs::exists(script.replace_extension(".garment"))) continue;
    Result result;
    result.verdict = {golden.string(), "  has no script\n", 0};
    result.told = fmt::format("FAILED {}\n  has no script\n", golden.string());
    results.push_back(std::move(result));
  }
}

ExitCode list_scripts(const std::vector<fs::path>& scripts, const GoldenOptions& options, Host& host, Terminal& terminal) {
  for (const fs::path& path : scripts) {
    const HostResult<std::string> script = host.read_file(path.string(), kMaxBytes);
    const std::string text = script ? *script.value : "";
    terminal.result(fmt::format("{:6} {}", stage_name(stage_of(path, text, read_expectations(text), options)), path.string()));
  }
  return kOk;
}

ExitCode summarise(const std::vector<Result>& results, const GoldenOptions& options, Host& host, Terminal& terminal) {
  std::size_t failed = 0, updated = 0;
  double drape = 0;
  std::vector<GoldenVerdict> verdicts;
  for (const Result& result : results) {
    if (!result.told.empty()) terminal.result(result.told);
    failed += result.verdict.failure.empty() ? 0 : 1;
    updated += result.updated ? 1 : 0;
    drape += result.drape_seconds;
    verdicts.push_back(result.verdict);
  }
  if (updated > 0) terminal.result(fmt::format("{} updated", updated));
  if (drape > 0) terminal.note(fmt::format("draping took {}", say_seconds(drape)));
  terminal.result(fmt::format("{} passed, {} failed", results.size() - failed, failed));
  if (!options.junit.empty()) {
    const HostResult<bool> written = host.write_file(options.junit, junit_xml(verdicts));
    if (!written) {
      show({plain_error("G0902", fmt::format("cannot write `{}`: {}", options.junit, written.error.message),
                        "choose another file after --junit")},
           grammar::Sources{}, terminal);
      return kInputOutput;
    }
  }
  return failed == 0 ? kOk : kDiagnostics;
}

}  // namespace

ExitCode run_goldens(const GoldenOptions& options, Host& host, Terminal& terminal) {
  const Found found = find_below(options);
  if (found.error || found.scripts.empty()) {
    const bool filtered = !found.error && !options.filter.empty();
    show({plain_error("G0904",
                      fmt::format("`{}` holds no scripts{}", options.folder,
                                  found.error ? ": " + found.error.message()
                                  : filtered  ? fmt::format(" with `{}` in their path", options.filter)
                                              : ""),
                      filtered ? "--list shows them all" : "name a folder with .garment files")},
         grammar::Sources{}, terminal);
    return kInputOutput;
  }
  if (options.list) return list_scripts(found.scripts, options, host, terminal);
  std::vector<Result> results = test_all(found.scripts, options, host);
  if (host.interrupted()) return kInterrupted;
  add_orphans(found.goldens, results);
  return summarise(results, options, host, terminal);
}

}  // namespace garment::cli
