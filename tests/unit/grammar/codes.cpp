// The table of codes against the sources: every literal "Gnnnn" has its row.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "grammar/diagnostic.hpp"

using namespace garment::grammar;

namespace {

std::string read(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("every code in the sources has a row in the table") {
  const std::regex literal("\"(G[0-9]{4})\"");
  int n_literals = 0;
  std::set<std::string> missing;
  for (const char* room : {"grammar", "runtime", "interpreter"}) {
    std::filesystem::path root = std::filesystem::path(GARMENT_SOURCE_DIR) / room;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
      std::string extension = entry.path().extension().string();
      if (!entry.is_regular_file() || (extension != ".cpp" && extension != ".hpp")) continue;
      std::istringstream lines(read(entry.path()));
      for (std::string line; std::getline(lines, line);) {
        std::string code_part = line.substr(0, line.find("//"));  // comments may name a code as an example
        std::smatch match;
        if (!std::regex_search(code_part, match, literal)) continue;
        ++n_literals;
        if (!find_code(match.str(1))) missing.insert(match.str(1) + " in " + entry.path().string());
      }
    }
  }
  CHECK(missing == std::set<std::string>{});
  CHECK(n_literals > 50);
}

TEST_CASE("the rows are unique, in their section, and explain") {
  std::set<std::string_view> seen;
  for (const CodeInfo& row : code_table()) {
    INFO(row.code);
    CHECK(seen.insert(row.code).second);
    CHECK(row.code.size() == 5);
    CHECK(row.code[0] == 'G');
    CHECK(std::all_of(row.code.begin() + 1, row.code.end(), [](char c) { return c >= '0' && c <= '9'; }));
    CHECK(row.title.size() > 5);
    CHECK(row.explanation.size() > 40);
    CHECK(row.explanation.find("\n\nWhat to do: ") != std::string_view::npos);
    CHECK(remedy_of(row.code).size() > 5);
  }
  CHECK(find_code("G0101")->title == "the source is not UTF-8 text");
  CHECK(find_code("G9999") == nullptr);
}

TEST_CASE("the remedy of a code is the first sentence of what to do") {
  CHECK(remedy_of("G0314") == "keep one of the two");
  CHECK(remedy_of("G0107") == "write the digits on both sides of the point; a range has two points: 0 .. 1");
  CHECK(remedy_of("G0302") == "take another name, or remove one of the two");
  CHECK(remedy_of("G9999").empty());
}

TEST_CASE("every code of the grammar is raised by a test of the grammar") {
  std::string tests;
  for (const char* file : {"parse_errors.cpp", "recovery.cpp"})
    tests += read(std::filesystem::path(GARMENT_SOURCE_DIR) / "tests/unit/grammar" / file);
  for (const CodeInfo& row : code_table()) {
    if (row.code.substr(0, 3) != "G01" && row.code.substr(0, 3) != "G02") continue;
    INFO(row.code);
    CHECK(tests.find('"' + std::string(row.code) + '"') != std::string::npos);
  }
}
