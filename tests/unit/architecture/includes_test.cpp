// The rooms of the house: what each file includes, against the table of docs/architecture.md.
#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "tests/unit/architecture/text_files.hpp"

namespace {

using garment::test::read;
namespace fs = std::filesystem;
using Names = std::set<std::string>;

const fs::path kRoot = GARMENT_SOURCE_DIR;

struct Row {
  Names rooms;      ///< folders, as "runtime/base"
  Names libraries;  ///< as the table calls them
};
using Table = std::map<std::string, Row>;

std::string trimmed(const std::string& s) {
  std::size_t a = s.find_first_not_of(" `"), b = s.find_last_not_of(" `/");
  return a == std::string::npos || b < a ? "" : s.substr(a, b - a + 1);
}

/// The rows of the table for folders of code: "| `runtime/body/` | holds | design, FCL |".
Table read_table() {
  std::istringstream lines(read(kRoot / "docs/architecture.md"));
  std::map<std::string, std::string> may;
  const std::regex row(R"(^\| `((?:runtime|interpreter|grammar)[a-z/]*)` \|.*\| ([^|]*) \|$)");
  std::smatch m;
  for (std::string line; std::getline(lines, line);)
    if (std::regex_match(line, m, row)) may[trimmed(m.str(1))] = m.str(2);
  Table table;
  for (const auto& [room, text] : may) {
    Row& r = table[room];
    std::istringstream words(text);
    for (std::string word; std::getline(words, word, ',');) {
      const std::string name = trimmed(word);
      if (name == "runtime") {
        for (const auto& [other, unused] : may)
          if (other.substr(0, 8) == "runtime/") r.rooms.insert(other);
      } else if (may.contains("runtime/" + name)) {
        r.rooms.insert("runtime/" + name);
      } else if (may.contains(name)) {
        r.rooms.insert(name);
      } else {
        r.libraries.insert(name);
      }
    }
  }
  return table;
}

/// Rooms that `room` may include: those of its row, and what they may include.
Names reachable(const Table& table, const std::string& room) {
  Names seen;
  std::vector<std::string> open{room};
  while (!open.empty()) {
    const std::string at = open.back();
    open.pop_back();
    if (!seen.insert(at).second) continue;
    for (const std::string& next : table.at(at).rooms) open.push_back(next);
  }
  return seen;
}

/// Libraries by the first part of their include paths; fmt and Eigen are open to every room above one that
/// has them.
const std::map<std::string, std::string> kLibraries = {
    {"fmt", "fmt"},        {"Eigen", "Eigen"},  {"tbb", "oneTBB"},
    {"oneapi", "oneTBB"},  {"tao", "PEGTL"},    {"fcl", "FCL"},
    {"embree3", "Embree"}, {"png.h", "libpng"}, {"nlohmann", "nlohmann-json"}, {"pugixml", "pugixml"}, {"hpdf.h", "libharu"},
    {"CLI", "CLI11"},      {"histedit.h", "libedit"},
};

bool may_use(const Table& table, const std::string& room, const std::string& library) {
  if (table.at(room).libraries.contains(library)) return true;
  if (library != "fmt" && library != "Eigen") return false;
  for (const std::string& below : reachable(table, room))
    if (table.at(below).libraries.contains(library)) return true;
  return false;
}

/// The room of a file: its folder. Tables of diagnostic codes, one file for each family, belong to the room above them.
std::string room_of(const fs::path& file) {
  const fs::path folder = file.parent_path();
  return (folder.filename() == "codes" ? folder.parent_path() : folder).string();
}

struct File {
  fs::path path;
  std::string room, text;
};

std::vector<File> code_files() {
  std::vector<File> files;
  for (const char* top : {"grammar", "interpreter", "runtime"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / top)) {
      const std::string ending = entry.path().extension().string();
      if (!entry.is_regular_file() || (ending != ".cpp" && ending != ".hpp" && ending != ".def")) continue;
      const fs::path relative = fs::relative(entry.path(), kRoot);
      files.push_back({relative, room_of(relative), read(entry.path())});
    }
  return files;
}

std::vector<std::string> includes_of(const std::string& text) {
  std::vector<std::string> found;
  const std::regex line(R"(^\s*#\s*include\s*([<"][^>"]+)[>"])");
  std::istringstream lines(text);
  std::smatch m;
  for (std::string s; std::getline(lines, s);)
    if (std::regex_search(s, m, line)) found.push_back(m.str(1));
  return found;
}

}  // namespace

TEST_CASE("the table of rooms names every room of the tree") {
  const Table table = read_table();
  CHECK(table.size() >= 13);
  Names folders;
  for (const File& f : code_files()) folders.insert(f.room);
  for (const std::string& room : folders) {
    INFO(room);
    CHECK(table.contains(room));
  }
  for (const auto& [room, row] : table) {
    INFO(room);
    CHECK(folders.contains(room));
    CHECK_FALSE(row.rooms.contains(room));
  }
}

TEST_CASE("no room can reach itself over other rooms") {
  const Table table = read_table();
  for (const auto& [room, row] : table)
    for (const std::string& other : row.rooms) {
      INFO(room << " and " << other);
      CHECK_FALSE(reachable(table, other).contains(room));
    }
}

TEST_CASE("files include only what the table of rooms allows") {
  const Table table = read_table();
  int n_rooms = 0, n_libraries = 0;
  for (const File& f : code_files()) {
    const Names rooms = reachable(table, f.room);
    for (const std::string& include : includes_of(f.text)) {
      INFO(f.path.string() << " includes " << include.substr(1));
      const std::string path = include.substr(1), first = path.substr(0, path.find('/'));
      if (include[0] == '"') {
        CHECK(rooms.contains(room_of(path)));
        ++n_rooms;
      } else if (const auto library = kLibraries.find(first); library != kLibraries.end()) {
        CHECK(may_use(table, f.room, library->second));
        ++n_libraries;
      } else if (path.find('/') != std::string::npos) {
        CHECK(first == "sys");  // a library that the table does not know
        CHECK((f.path == "runtime/base/host.cpp" || f.path == "runtime/base/access.cpp"));
      }
    }
  }
  CHECK(n_rooms > 300);
  CHECK(n_libraries > 50);
}

TEST_CASE("the simulator and the grammar know nothing of the declared garment") {
  for (const File& f : code_files()) {
    if (f.room != "runtime/simulator" && f.room != "grammar" && f.room != "runtime/model") continue;
    INFO(f.path.string());
    for (const std::string& include : includes_of(f.text))
      CHECK(include.find("runtime/design/") == std::string::npos);
  }
}

TEST_CASE("files, clock and terminal have one place each") {
  struct Rule {
    const char* what;
    std::regex words;
    std::regex where;  ///< paths that may
  };
  const Rule rules[] = {
      {"terminal", std::regex(R"(\b(isatty|tcgetattr|ioctl|stdout|stderr|stdin)\b|std::(cout|cerr|cin)\b)"),
       std::regex("interpreter/(cli|repl)/.*")},
      {"files", std::regex(R"(\b(fopen|freopen|ifstream|ofstream|fstream|mkostemps)\b)"),
       std::regex("runtime/base/host\\.cpp")},
      {"clock", std::regex(R"(std::chrono|\b(gettimeofday|clock_gettime)\b)"),
       std::regex("runtime/base/host\\.cpp|interpreter/lsp/inbox\\.cpp")},  // the inbox waits, it reads no clock
      {"chance", std::regex(R"(random_device|\bs?rand\()"), std::regex("nowhere")},
  };
  for (const Rule& rule : rules) {
    int n_allowed = 0;
    for (const File& f : code_files()) {
      std::istringstream lines(f.text);
      for (std::string line; std::getline(lines, line);) {
        const std::string code = line.substr(0, line.find("//"));
        if (!std::regex_search(code, rule.words)) continue;
        INFO(rule.what << " in " << f.path.string() << ": " << line);
        const bool allowed = std::regex_match(f.path.string(), rule.where);
        CHECK(allowed);
        n_allowed += allowed;
      }
    }
    INFO(rule.what);
    if (std::string(rule.what) != "chance" && std::string(rule.what) != "files") CHECK(n_allowed > 0);
  }
}
