#pragma once
// The outcome of `garment test` as JUnit XML, the form that build servers read.
#include <string>
#include <vector>

namespace garment::cli {

struct GoldenVerdict {
  std::string path;     ///< of the script
  std::string failure;  ///< empty: passed
  double seconds = 0;
};

/// One test suite for each folder, in the order of the verdicts.
std::string junit_xml(const std::vector<GoldenVerdict>& verdicts);

}  // namespace garment::cli
