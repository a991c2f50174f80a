#include <catch2/catch.hpp>
#include <ctime>
#include <nlohmann/json.hpp>

#include "tests/unit/grammar/test_vocabulary.hpp"

using namespace garment::grammar;
using namespace garment::grammar::test;

TEST_CASE("the tree as JSON") {
  Parsed parsed = parse_text("## d\nlet h_{i} = f(a: 5 cm)\n");
  auto json = nlohmann::json::parse(to_json(parsed.result.script, parsed.sources));
  CHECK(json["source"] == "test.garment");
  auto let = json["statements"][0];
  CHECK(let["keyword"] == "let");
  CHECK(let["doc"] == "d");
  CHECK(let["span"] == std::vector<int>{5, 27});
  CHECK(let["name"]["text"] == "h_{i}");
  CHECK(let["name"]["parts"].size() == 2);
  auto call = let["clauses"][0]["values"][0];
  CHECK(call["kind"] == "call");
  CHECK(call["labels"] == std::vector<std::string>{"a"});
  CHECK(call["children"][1] ==
        nlohmann::json::parse(R"({"kind":"number","span":[22,26],"number":5.0,"unit":"cm"})"));
  CHECK(
      nlohmann::json::parse(to_json(parse_text(kSkirt).result.script, parsed.sources))["statements"].size() ==
      28);
}

TEST_CASE("trees are compared by what they say") {
  auto tree = [](const char* text) { return parse_text(text).result.script.statements; };
  CHECK(same_tree(tree("let x = a+b"), tree("  let x =  (a + b) # c")));
  for (const char* other : {"let y = a + b", "let x = a - b", "let x = a + b c", "let x = (a + b, 1)",
                            "let x = 1", "param x = a + b", "let x = a + b; use c", "## d\nlet x = a + b"})
    CHECK_FALSE(same_tree(tree("let x = a + b"), tree(other)));
}

#if defined(__has_feature)
#define GARMENT_HAS_FEATURE(feature) __has_feature(feature)
#else
#define GARMENT_HAS_FEATURE(feature) 0
#endif

TEST_CASE("four mebibytes are read in a second", "[time]") {
  std::string text;
  while (text.size() + std::string(kSkirt).size() < (4u << 20)) text += kSkirt;
  std::clock_t begin = std::clock();
  Parsed parsed = parse_text(text);
  double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  CHECK(parsed.result.diagnostics.empty());
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
    !GARMENT_HAS_FEATURE(address_sanitizer) && !GARMENT_HAS_FEATURE(thread_sanitizer)
  CHECK(seconds < 1.0);
#else
  CHECK(seconds < 60.0);
#endif
}
