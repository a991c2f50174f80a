#pragma once
// Files of the tree as text.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace garment::test {

inline std::string read(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace garment::test
