#pragma once
// What the tests of the pattern reader share.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "runtime/io/pattern_json.hpp"
#include "runtime/io/pattern_panel.hpp"

namespace pattern_test {

inline std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline std::string fixture(const std::string& name) {
  return read_text(std::string(GARMENT_SOURCE_DIR "/tests/unit/io/fixtures/") + name);
}

/// The pattern files of the reference data, sorted; empty where the data is absent.
inline std::vector<std::string> data_files() {
  std::vector<std::string> files;
  for (const char* folder : {"garmentcode", "garment_pattern_generator"}) {
    std::filesystem::path root = std::filesystem::path(GARMENT_DATA_DIR) / folder;
    if (!std::filesystem::is_directory(root)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root))
      if (entry.path().extension() == ".json") files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

inline double area(const garment::design::Panel& panel) { return garment::io::signed_area(panel.edges); }

inline bool has_code(const garment::Findings& findings, const std::string& code) {
  return std::any_of(findings.begin(), findings.end(),
                     [&](const garment::Finding& f) { return f.code == code; });
}

inline std::string all_messages(const garment::Findings& findings) {
  std::string text;
  for (const garment::Finding& f : findings) text += f.code + " " + f.message + "\n";
  return text;
}

}  // namespace pattern_test
