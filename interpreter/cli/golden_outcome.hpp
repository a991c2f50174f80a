#pragma once
// Runs one script as far as its stage and says what came of it.
#include <map>
#include <string>
#include <vector>

#include "grammar/diagnostic.hpp"
#include "interpreter/cli/golden_expectations.hpp"
#include "runtime/base/host.hpp"

namespace garment::cli {

struct GoldenOutcome {
  grammar::Sources sources;
  grammar::Diagnostics diagnostics;
  std::string text;                           ///< what a .expected file holds
  std::map<std::size_t, std::string> values;  ///< by line: what a `let`, `param` or `measure` there is, as printed
  std::size_t n_expects = 0;                  ///< `expect` statements judged
  double drape_seconds = 0;
};

/// True where the script has a `drape` at its top level: then its stage is `run` unless it says otherwise.
bool has_drape(const std::string& script);

/// Where `use NAME` looks.
struct GoldenLibraries {
  std::string stdlib_dir;
  std::vector<std::string> before;  ///< folders that are looked in first
};

/// `path` names the script in messages and says where its files are.
GoldenOutcome run_golden(const std::string& path, const std::string& script, GoldenStage stage,
                         const GoldenLibraries& libraries, Host& host);

}  // namespace garment::cli
