// Scripts damaged at random (from a fixed seed): whatever they say, the answer is a garment or coded errors
// in place.
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "tests/unit/interpreter/support.hpp"

using namespace garment;
using namespace garment::interpreter;
using namespace garment::interpreter::test;

namespace {

struct Dice {
  std::uint64_t state;
  std::size_t roll(std::size_t n) {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<std::size_t>(state >> 33) % n;
  }
};

std::vector<std::string> tokens_of(const std::string& text) {
  std::vector<std::string> tokens;
  for (char c : text) {
    const bool word = std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
    const bool joins = word && !tokens.empty() &&
                       (std::isalnum(static_cast<unsigned char>(tokens.back().back())) ||
                        tokens.back().back() == '_' || tokens.back().back() == '.');
    if (joins)
      tokens.back() += c;
    else
      tokens.emplace_back(1, c);
  }
  return tokens;
}

std::string damaged(std::vector<std::string> tokens, Dice& dice) {
  for (std::size_t k = 1 + dice.roll(3); k > 0; --k) {
    const std::size_t at = dice.roll(tokens.size()), other = dice.roll(tokens.size());
    switch (dice.roll(4)) {
      case 0:
        tokens.erase(tokens.begin() + static_cast<std::ptrdiff_t>(at));
        break;
      case 1:
        tokens.insert(tokens.begin() + static_cast<std::ptrdiff_t>(at), tokens[other]);
        break;
      case 2:
        std::swap(tokens[at], tokens[other]);
        break;
      default:
        tokens[at] = tokens[other];
    }
  }
  std::string text;
  for (const std::string& token : tokens) text += token;
  return text;
}

std::string read(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("damaged scripts are answered with coded errors in place") {
  Dice dice{20240229};
  int accepted = 0, refused = 0;
  for (const char* name : {"skirt", "tablecloth", "hanging"}) {
    const std::string text =
        read(std::filesystem::path(GARMENT_SOURCE_DIR) / "examples" / (std::string(name) + ".garment"));
    REQUIRE_FALSE(text.empty());
    const std::vector<std::string> tokens = tokens_of(text);
    for (int k = 0; k < 150; ++k) {
      const std::string script = damaged(tokens, dice);
      const Trial trial(script);
      INFO(script);
      (trial.result.ok() ? accepted : refused)++;
      for (const auto& d : trial.result.diagnostics) {
        INFO(d.code << ' ' << d.message);
        REQUIRE(grammar::find_code(d.code) != nullptr);
        REQUIRE_FALSE(d.labels.empty());
        REQUIRE_FALSE(d.message.empty());
        for (const auto& label : d.labels) {
          REQUIRE(label.span.source < trial.sources.size());
          REQUIRE(label.span.begin <= label.span.end);
          REQUIRE(label.span.end <= trial.sources[label.span.source].text.size());
        }
      }
      REQUIRE_FALSE(trial.text().find("nan") != std::string::npos);
    }
  }
  CHECK(accepted > 20);
  CHECK(refused > 200);
}

TEST_CASE("every code of the evaluator is raised by a test") {
  const std::regex literal("\"(G0[3-6][0-9]{2})\"");
  auto codes_in = [&](const std::filesystem::path& folder, bool skip_other) {
    std::set<std::string> codes;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (skip_other && name.rfind("unparse", 0) == 0) continue;
      const std::string text = read(entry.path());
      for (auto at = std::sregex_iterator(text.begin(), text.end(), literal); at != std::sregex_iterator();
           ++at)
        codes.insert(at->str(1));
    }
    return codes;
  };
  const std::filesystem::path root = GARMENT_SOURCE_DIR;
  std::set<std::string> tested = codes_in(root / "tests/unit/interpreter", false);
  const std::regex expected("(?:error|warning)\\[(G0[3-6][0-9]{2})\\]");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "tests/golden")) {
    if (entry.path().extension() != ".garment") continue;
    const std::string text = read(entry.path());
    for (auto at = std::sregex_iterator(text.begin(), text.end(), expected); at != std::sregex_iterator(); ++at)
      tested.insert(at->str(1));
  }
  std::set<std::string> untested;
  for (const auto& folder : {root / "interpreter/language", root / "runtime/design"})
    for (const std::string& code : codes_in(folder, true))
      if (!tested.contains(code)) untested.insert(code);
  CHECK(untested == std::set<std::string>{});
}
