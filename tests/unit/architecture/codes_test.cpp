// Every diagnostic code must be provoked somewhere: by a golden script or by a test.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "grammar/diagnostic.hpp"

namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Codes written in the golden scripts (`#! error[G0312]`), in their .expected files, and as text in the
/// tests.
std::set<std::string> codes_below(const std::vector<std::string>& folders) {
  std::set<std::string> found;
  const std::regex code("G[0-9]{4}");
  for (const std::string& folder : folders) {
    const fs::path root = fs::path(GARMENT_SOURCE_DIR) / "tests" / folder;
    if (!fs::exists(root)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
      if (!entry.is_regular_file() || entry.path().parent_path().filename() == "architecture") continue;
      if (entry.path().filename() == "codes.cpp") continue;  // reads the table, provokes nothing
      const std::string text = read(entry.path());
      for (std::sregex_iterator it(text.begin(), text.end(), code), end; it != end; ++it)
        found.insert(it->str());
    }
  }
  return found;
}

/// Findings of checks that no input reaches while the program is as it should be; each with its reason.
const std::set<std::string> kUnreachable = {
    "G1206",  // what a condition can read today can all be made again
};

}  // namespace

TEST_CASE("every diagnostic code occurs in a golden or a test") {
  const std::set<std::string> tested = codes_below({"golden", "unit", "cli", "property", "physics"});
  std::string missing;
  for (const garment::grammar::CodeInfo& row : garment::grammar::code_table()) {
    const std::string code(row.code);
    if (!tested.contains(code) && !kUnreachable.contains(code))
      missing += code + " (" + std::string(row.title) + ")\n";
  }
  CHECK(missing == "");
  CHECK(tested.size() > 100);
}

TEST_CASE("goldens name only codes that the table has") {
  std::string unknown;
  for (const std::string& code : codes_below({"golden"}))
    if (garment::grammar::find_code(code) == nullptr) unknown += code + "\n";
  CHECK(unknown == "");
}
