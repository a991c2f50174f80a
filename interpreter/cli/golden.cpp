#include "interpreter/cli/golden.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <vector>

#include "interpreter/cli/project.hpp"
#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/interpret.hpp"
#include "runtime/model/dump.hpp"
#include "runtime/modeller/modeller.hpp"
#include "runtime/modeller/unmodelled.hpp"

namespace garment::cli {
namespace {

namespace fs = std::filesystem;
constexpr std::uint64_t kMaxBytes = 4u << 20;
constexpr std::size_t kMaxGolden = 20u << 10;

enum class Stage { parse, check, model };

Stage stage_of(const fs::path& path) {
  for (const fs::path& part : path) {
    if (part == "parse") return Stage::parse;
    if (part == "model") return Stage::model;
  }
  return Stage::check;
}

/// What a run of one script gave.
struct Outcome {
  grammar::Sources sources;
  grammar::Diagnostics diagnostics;
  std::string text;  ///< what a .expected file holds
};

Outcome run_script(const std::string& path, const std::string& text, Stage stage,
                   const std::string& stdlib_dir, Host& host) {
  Outcome o;
  grammar::SourceId id = o.sources.add(fs::path(path).filename().string(), text);
  if (stage == Stage::parse) {
    grammar::ParseResult parsed = grammar::parse(o.sources, id, interpreter::vocabulary());
    o.diagnostics = std::move(parsed.diagnostics);
    o.text = grammar::to_outline(parsed.script);
  } else {
    interpreter::InterpretOptions options;
    options.warn_unused = true;
    options.stdlib_dir = stdlib_dir;
    options.script_dir = folder_of(path);
    interpreter::Interpretation result = interpreter::interpret(o.sources, id, host, options);
    o.diagnostics = result.diagnostics;
    if (result.ok()) {
      modeller::ModelResult built;
      if (stage == Stage::check)
        built.findings = modeller::find_unmodelled(result.garment, Severity::warning);
      if (built.findings.empty()) built = modeller::build_model(result.garment, result.bodies);
      for (grammar::Diagnostic& d : interpreter::to_diagnostics(built.findings, result.origins))
        o.diagnostics.push_back(std::move(d));
      if (stage == Stage::model && built.model) o.text = model::summary_text(*built.model);
    }
  }
  for (const grammar::Diagnostic& d : o.diagnostics) o.text += grammar::render(d, o.sources, false);
  return o;
}

/// One `#!` comment.
struct Inline {
  std::size_t line = 0;  ///< of the code it speaks of, from 1
  std::string severity, code, part;
  std::uint32_t first = 0, last = 0;  ///< columns; 0: of the script as a whole, no place
};

struct InlineExpectations {
  std::vector<Inline> wanted;
  bool any = false;
  std::string malformed;
};

bool take_number(std::string_view& s, std::uint32_t& value) {
  auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), value);
  if (error != std::errc{}) return false;
  s.remove_prefix(static_cast<std::size_t>(end - s.data()));
  return true;
}

std::optional<Inline> read_inline(std::string_view s) {
  Inline e;
  auto skip_blanks = [&s] {
    while (!s.empty() && s.front() == ' ') s.remove_prefix(1);
  };
  skip_blanks();
  std::size_t open = s.find('['), close = s.find(']');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open) return std::nullopt;
  e.severity = s.substr(0, open);
  if (e.severity != "error" && e.severity != "warning" && e.severity != "note") return std::nullopt;
  e.code = s.substr(open + 1, close - open - 1);
  s.remove_prefix(close + 1);
  skip_blanks();
  if (!s.empty() && s.front() != '"') {
    if (!take_number(s, e.first) || e.first == 0 || s.empty() || s.front() != '-') return std::nullopt;
    s.remove_prefix(1);
    if (!take_number(s, e.last)) return std::nullopt;
    skip_blanks();
  }
  if (s.size() < 3 || s.front() != '"' || s.back() != '"') return std::nullopt;
  e.part = s.substr(1, s.size() - 2);
  return e;
}

InlineExpectations read_inlines(const std::string& text) {
  InlineExpectations out;
  std::vector<Inline> open;
  std::size_t line = 0, begin = 0;
  while (begin < text.size()) {
    std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view row(text.data() + begin, end - begin);
    begin = end + 1;
    ++line;
    std::size_t at = row.find_first_not_of(" \t");
    if (at != std::string_view::npos && row.substr(at, 2) == "#!") {
      out.any = true;
      row.remove_prefix(at + 2);
      while (!row.empty() && (row.back() == ' ' || row.back() == '\r')) row.remove_suffix(1);
      if (row == " ok") continue;
      if (auto e = read_inline(row))
        open.push_back(*e);
      else
        out.malformed = fmt::format("line {}: cannot read `#!{}`", line, row);
      continue;
    }
    for (Inline& e : open) {
      e.line = line;
      out.wanted.push_back(e);
    }
    open.clear();
  }
  for (Inline& e : open) {  // below the last line: the end of the text
    e.line = line + 1;
    out.wanted.push_back(e);
  }
  return out;
}

bool is_expected(const Inline& e, const grammar::Diagnostic& d, const grammar::Sources& sources) {
  const char* severity = d.severity == Severity::error     ? "error"
                         : d.severity == Severity::warning ? "warning"
                                                           : "note";
  if (d.code != e.code || e.severity != severity || d.message.find(e.part) == std::string::npos) return false;
  if (e.first == 0 || d.labels.empty()) return e.first == 0 && d.labels.empty();
  grammar::Place a = sources.place(d.labels[0].span.source, d.labels[0].span.begin);
  grammar::Place b = sources.place(d.labels[0].span.source, d.labels[0].span.end);
  return a.line == e.line && a.column == e.first && (b.line != a.line || b.column == e.last + 1);
}

/// Differences between what was expected inline and what came; empty when all is well.
std::string compare_inline(const InlineExpectations& inlines, const Outcome& o) {
  if (!inlines.malformed.empty()) return inlines.malformed + "\n";
  std::string differences;
  std::vector<bool> used(o.diagnostics.size(), false);
  for (const Inline& e : inlines.wanted) {
    bool found = false;
    for (std::size_t i = 0; i < o.diagnostics.size() && !found; ++i) {
      if (used[i] || !is_expected(e, o.diagnostics[i], o.sources)) continue;
      found = used[i] = true;
    }
    if (!found)
      differences += fmt::format("  missing: line {} {}[{}] {}-{} \"{}\"\n", e.line, e.severity, e.code,
                                 e.first, e.last, e.part);
  }
  for (std::size_t i = 0; i < o.diagnostics.size(); ++i)
    if (!used[i]) differences += "  not expected:\n" + grammar::render(o.diagnostics[i], o.sources, false);
  return differences;
}

/// Lines that differ, with - for the golden and + for what came.
std::string line_difference(const std::string& golden, const std::string& now) {
  auto split = [](const std::string& s) {
    std::vector<std::string> lines;
    std::size_t begin = 0;
    while (begin < s.size()) {
      std::size_t end = std::min(s.find('\n', begin), s.size());
      lines.push_back(s.substr(begin, end - begin));
      begin = end + 1;
    }
    return lines;
  };
  std::vector<std::string> a = split(golden), b = split(now);
  std::size_t head = 0, tail = 0;
  while (head < a.size() && head < b.size() && a[head] == b[head]) ++head;
  while (tail + head < a.size() && tail + head < b.size() && a[a.size() - 1 - tail] == b[b.size() - 1 - tail])
    ++tail;
  std::string out;
  for (std::size_t i = head; i + tail < a.size(); ++i) out += "  - " + a[i] + "\n";
  for (std::size_t i = head; i + tail < b.size(); ++i) out += "  + " + b[i] + "\n";
  return out;
}

struct Tally {
  int passed = 0, failed = 0, updated = 0;
};

void test_script(const fs::path& path, const GoldenOptions& options, Host& host, Terminal& terminal,
                 Tally& tally) {
  auto fail = [&](const std::string& why) {
    terminal.result(fmt::format("FAILED {}\n{}", path.string(), why));
    ++tally.failed;
  };
  HostResult<std::string> text = host.read_file(path.string(), kMaxBytes);
  if (!text) return fail("  cannot be read: " + text.error.message);
  Outcome o = run_script(path.string(), *text.value, stage_of(path), options.stdlib_dir, host);
  InlineExpectations inlines = read_inlines(*text.value);
  if (inlines.any) {
    std::string differences = compare_inline(inlines, o);
    if (!differences.empty()) return fail(differences);
    ++tally.passed;
    return;
  }
  fs::path golden_path = path;
  golden_path.replace_extension(".expected");
  HostResult<std::string> golden = host.read_file(golden_path.string(), kMaxGolden);
  if (golden && *golden.value == o.text) {
    ++tally.passed;
    return;
  }
  std::string difference = line_difference(golden ? *golden.value : "", o.text);
  if (!options.update)
    return fail((golden ? "" : "  has neither `#!` comments nor a .expected file; --update writes one\n") +
                difference);
  if (o.text.size() > kMaxGolden) return fail("  its output is over 20 KB: expect it inline instead");
  terminal.result(fmt::format("updated {}\n{}", golden_path.string(), difference));
  if (!host.write_file(golden_path.string(), o.text)) return fail("  the golden could not be written");
  ++tally.updated;
}

}  // namespace

ExitCode run_goldens(const GoldenOptions& options, Host& host, Terminal& terminal) {
  std::error_code error;
  std::vector<fs::path> scripts, goldens;
  for (fs::recursive_directory_iterator it(options.folder, error), end; !error && it != end;
       it.increment(error)) {
    if (it->path().extension() == ".garment") scripts.push_back(it->path());
    if (it->path().extension() == ".expected") goldens.push_back(it->path());
  }
  if (error || scripts.empty()) {
    show({plain_error(
             "G0904",
             fmt::format("`{}` holds no scripts{}", options.folder, error ? ": " + error.message() : ""),
             "name a folder with .garment files")},
         grammar::Sources{}, terminal);
    return kInputOutput;
  }
  std::sort(scripts.begin(), scripts.end());
  std::sort(goldens.begin(), goldens.end());
  Tally tally;
  for (const fs::path& script : scripts) test_script(script, options, host, terminal, tally);
  for (fs::path golden : goldens)
    if (!fs::exists(golden.replace_extension(".garment"))) {
      terminal.result(
          fmt::format("FAILED {}\n  has no script", golden.replace_extension(".expected").string()));
      ++tally.failed;
    }
  if (tally.updated > 0) terminal.result(fmt::format("{} updated", tally.updated));
  terminal.result(fmt::format("{} passed, {} failed", tally.passed + tally.updated, tally.failed));
  return tally.failed == 0 ? kOk : kDiagnostics;
}

}  // namespace garment::cli
