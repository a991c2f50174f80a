// Every diagnostic code must be provoked somewhere: by a golden script or by a test.
#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "grammar/diagnostic.hpp"
#include "tests/unit/architecture/text_files.hpp"

namespace {

using garment::test::read;
namespace fs = std::filesystem;

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

/// How often each code is given by the goldens: `#!` lines and rendered diagnostics, errors, warnings and notes.
std::map<std::string, int> given_by_goldens() {
  std::map<std::string, int> given;
  const std::regex shown("(error|warning|note)\\[(G[0-9]{4})\\]");
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(GARMENT_SOURCE_DIR) / "tests/golden")) {
    if (!entry.is_regular_file()) continue;
    const std::string text = read(entry.path());
    for (std::sregex_iterator it(text.begin(), text.end(), shown), end; it != end; ++it) ++given[it->str(2)];
  }
  return given;
}

/// Codes that no golden script can give: what they speak of lies outside a script, or behind checks that come first. The
/// test of the command line gives them, or the one named here.
const std::map<std::string, std::string> kElsewhere = {
    // Larger than a file is read (G0901 comes first), words whose meaning is still to come (there are none today).
    {"G0108", "unit/grammar"}, {"G0315", "unit/interpreter"},
    // Findings of the modeller behind checks of the language: patterns that are read from files reach them.
    {"G0450", "unit/modeller"}, {"G0453", "unit/modeller"}, {"G0454", "unit/modeller"}, {"G0550", "unit/modeller"},
    {"G0551", "unit/modeller"}, {"G0601", "unit/modeller"}, {"G0602", "unit/modeller"}, {"G0603", "unit/modeller"},
    {"G0604", "unit/modeller"}, {"G0605", "unit/modeller"}, {"G0606", "unit/modeller"}, {"G0650", "unit/modeller"},
    {"G0651", "unit/modeller"}, {"G0652", "unit/modeller"},
    // A fault of the program; what only a drape finds.
    {"G0490", "unit/model"}, {"G0801", "physics"}, {"G0802", "physics"}, {"G0803", "physics"},
    {"G0807", "physics"}, {"G0808", "physics"}, {"G0810", "unit/simulator"},
    // Patterns in JSON.
    {"G0941", "unit/io"}, {"G0942", "unit/io"}, {"G0943", "unit/io"}, {"G0944", "unit/io"}, {"G0945", "unit/io"},
    {"G0946", "unit/io"}, {"G0947", "unit/io"}, {"G0948", "unit/io"}, {"G0949", "unit/io"}, {"G0950", "unit/io"},
    {"G0951", "unit/io"}, {"G0952", "unit/io"}, {"G0953", "unit/io"}, {"G0954", "unit/io"}, {"G0955", "unit/io"},
    {"G0956", "unit/io"}, {"G0957", "unit/io"}, {"G0906", "property"}, {"G0958", "property"},
    // Pieces in DXF.
    {"G0961", "unit/io"}, {"G0962", "unit/io"}, {"G0963", "unit/io"}, {"G0964", "unit/io"}, {"G0965", "unit/io"},
    {"G0966", "unit/io"}, {"G0967", "unit/io"}, {"G0968", "unit/io"}, {"G0969", "unit/io"},
    // Drawings in SVG.
    {"G0971", "unit/io"}, {"G0972", "unit/io"}, {"G0973", "unit/io"}, {"G0974", "unit/io"},
    // Files beside the prompt; what an editor asks.
    {"G1325", "unit/session"}, {"G1504", "unit/session"}, {"G1507", "unit/session"}, {"G1508", "unit/session"}, {"G1560", "unit/service"},
    {"G1561", "unit/service"}, {"G1562", "unit/service"},
};

}  // namespace

TEST_CASE("every diagnostic code occurs in a golden or a test") {
  const std::set<std::string> tested = codes_below({"golden", "unit", "cli", "property", "physics"});
  std::string missing;
  for (const garment::grammar::CodeInfo& row : garment::grammar::code_table()) {
    const std::string code(row.code);
    if (!tested.contains(code))
      missing += code + " (" + std::string(row.title) + ")\n";
  }
  CHECK(missing == "");
  CHECK(tested.size() > 100);
}

TEST_CASE("every code is given by a golden script or the command line, else it is said where") {
  const std::map<std::string, int> given = given_by_goldens();
  const std::set<std::string> cli = codes_below({"cli"});
  std::string missing;
  for (const garment::grammar::CodeInfo& row : garment::grammar::code_table()) {
    const std::string code(row.code);
    const auto elsewhere = kElsewhere.find(code);
    const bool here = given.contains(code) || cli.contains(code);
    if (here && elsewhere == kElsewhere.end()) continue;
    if (elsewhere == kElsewhere.end() || !codes_below({elsewhere->second}).contains(code))
      missing += code + " (" + std::string(row.title) + ")\n";
  }
  CHECK(missing == "");
}

TEST_CASE("the goldens give hundreds of diagnostics, counting no code more than five times") {
  int counted = 0;
  for (const auto& [code, n] : given_by_goldens()) counted += std::min(n, 5);
  CHECK(counted >= 450);
}

TEST_CASE("goldens name only codes that the table has") {
  std::string unknown;
  for (const std::string& code : codes_below({"golden"}))
    if (garment::grammar::find_code(code) == nullptr) unknown += code + "\n";
  CHECK(unknown == "");
}
