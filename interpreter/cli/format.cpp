// `garment fmt`: the canonical layout of files, folders and standard input.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>

#include "interpreter/cli/commands.hpp"
#include "interpreter/cli/text_diff.hpp"
#include "interpreter/language/construct_table.hpp"

namespace garment::cli {
namespace {

namespace fs = std::filesystem;
constexpr std::uint64_t kMaxScriptBytes = 4u << 20;
constexpr const char* kStandardInput = "-";

/// The scripts that the arguments name: files as they are, folders by the scripts below them, in order.
std::vector<std::string> scripts_of(const std::vector<std::string>& arguments) {
  std::vector<std::string> scripts;
  for (const std::string& argument : arguments) {
    std::error_code error;
    if (argument == kStandardInput || !fs::is_directory(argument, error)) {
      scripts.push_back(argument);
      continue;
    }
    std::vector<std::string> below;
    for (fs::recursive_directory_iterator it(argument, error), end; !error && it != end; it.increment(error))
      if (it->path().extension() == ".garment") below.push_back(it->path().string());
    std::sort(below.begin(), below.end());
    scripts.insert(scripts.end(), below.begin(), below.end());
  }
  return scripts;
}

/// Standard input, up to the most that a script may have (the parser says so where it is more).
std::string read_standard_input() {
  std::string text;
  char part[1 << 16];
  while (std::cin && text.size() <= kMaxScriptBytes) {
    std::cin.read(part, sizeof part);
    text.append(part, static_cast<std::size_t>(std::cin.gcount()));
  }
  return text;
}

ExitCode format_one(const std::string& file, const FormatOptions& options, Host& host, Terminal& terminal) {
  const bool standard_input = file == kStandardInput;
  const std::string name = standard_input ? "standard input" : file;
  HostResult<std::string> text = standard_input ? HostResult<std::string>{read_standard_input(), {}}
                                                : host.read_file(file, kMaxScriptBytes);
  grammar::Sources sources;
  if (!text) {
    show({plain_error("G0901", fmt::format("cannot read `{}`: {}", file, text.error.message), "check the path")}, sources, terminal);
    return kInputOutput;
  }
  const grammar::SourceId id = sources.add(name, *text.value);
  const grammar::FormatResult formatted = grammar::format(sources, id, interpreter::vocabulary());
  show(formatted.diagnostics, sources, terminal);
  if (!formatted.diagnostics.empty()) return kDiagnostics;
  const bool same = formatted.text == *text.value;
  if (options.diff) terminal.result(unified_diff(*text.value, formatted.text, name));
  if (options.check && !same && !options.diff)
    terminal.note(fmt::format("{} is not laid out canonically; `garment fmt {}` does it", name, file));
  if (options.check || options.diff) return same ? kOk : kDiagnostics;
  if (options.stdout_only || standard_input) {
    terminal.result(formatted.text);
    return kOk;
  }
  if (same) return kOk;
  const HostResult<bool> written = host.write_file(file, formatted.text);
  if (written) return kOk;
  show({plain_error("G0902", fmt::format("cannot write `{}`: {}", file, written.error.message), "")}, sources, terminal);
  return kInputOutput;
}

}  // namespace

ExitCode format(const FormatOptions& options, Host& host, Terminal& terminal) {
  const std::vector<std::string> scripts = scripts_of(options.files);
  if (scripts.empty()) {
    show({plain_error("G0904", fmt::format("`{}` holds no scripts", options.files.empty() ? "" : options.files[0]),
                      "name a file, or a folder with .garment files")},
         grammar::Sources{}, terminal);
    return kInputOutput;
  }
  ExitCode code = kOk;
  for (const std::string& file : scripts) code = std::max(code, format_one(file, options, host, terminal));
  return code;
}

}  // namespace garment::cli
