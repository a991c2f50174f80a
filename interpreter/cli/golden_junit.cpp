#include "interpreter/cli/golden_junit.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "grammar/text.hpp"

namespace garment::cli {
namespace {

/// XML 1.0 has neither most control characters nor the last two of the basic plane.
bool is_xml(const grammar::Character& c) {
  return c.valid && (c.code >= 32 || c.code == '\t' || c.code == '\n') && c.code != 0xFFFE && c.code != 0xFFFF;
}

/// Text for an attribute or element: markup escaped, what XML does not have replaced.
std::string escaped(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const grammar::Character c = grammar::decode_utf8(text, at);
    if (c.code == '&') out += "&amp;";
    else if (c.code == '<') out += "&lt;";
    else if (c.code == '>') out += "&gt;";
    else if (c.code == '"') out += "&quot;";
    else if (c.code == '\n') out += "&#10;";
    else if (!is_xml(c)) out += "\xEF\xBF\xBD";
    else out += text.substr(at, c.length);
    at += c.length;
  }
  return out;
}

std::string first_line(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \n");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find('\n', begin) - begin);
}

std::string case_text(const GoldenVerdict& v, const std::string& suite) {
  const std::filesystem::path path(v.path);
  std::string text = fmt::format("    <testcase name=\"{}\" classname=\"{}\" time=\"{:.3f}\"", escaped(path.stem().string()),
                                 escaped(suite), v.seconds);
  if (v.failure.empty()) return text + "/>\n";
  return text + fmt::format(">\n      <failure message=\"{}\" type=\"difference\">{}</failure>\n    </testcase>\n",
                            escaped(first_line(v.failure)), escaped(v.failure));
}

}  // namespace

std::string junit_xml(const std::vector<GoldenVerdict>& verdicts) {
  std::string suites;
  std::size_t all_failures = 0;
  for (std::size_t begin = 0; begin < verdicts.size();) {
    const std::string suite = std::filesystem::path(verdicts[begin].path).parent_path().string();
    std::size_t end = begin, failures = 0;
    double seconds = 0;
    std::string cases;
    for (; end < verdicts.size() && std::filesystem::path(verdicts[end].path).parent_path() == suite; ++end) {
      failures += verdicts[end].failure.empty() ? 0 : 1;
      seconds += verdicts[end].seconds;
      cases += case_text(verdicts[end], suite);
    }
    suites += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"0\" time=\"{:.3f}\">\n{}  </testsuite>\n",
                          escaped(suite), end - begin, failures, seconds, cases);
    all_failures += failures;
    begin = end;
  }
  return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"garment test\" tests=\"{}\" failures=\"{}\" "
                     "errors=\"0\">\n{}</testsuites>\n",
                     verdicts.size(), all_failures, suites);
}

}  // namespace garment::cli
