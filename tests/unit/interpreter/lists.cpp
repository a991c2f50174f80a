// Lists, records, texts, tables, functions as values.
#include "tests/unit/interpreter/support.hpp"

using namespace garment;
using namespace garment::interpreter;
using namespace garment::interpreter::test;

namespace {

}  // namespace

TEST_CASE("lists are built, joined, sorted and mapped") {
  CHECK(value_of("[1, 2] + [3]") == "[1, 2, 3]");
  CHECK(value_of("count([] + [3 cm])") == "1");
  CHECK(value_of("first_of([3 cm, 5 cm])") == "3 cm");
  CHECK(value_of("last_of([3 cm, 5 cm])") == "5 cm");
  CHECK(value_of("sum([3 cm, 5 cm, 0])") == "8 cm");
  CHECK(value_of("sum([(1 cm, 0), (0, 2 cm)])") == "(1 cm, 2 cm)");
  CHECK(value_of("sort([5 cm, 3 cm, 4 cm])") == "[3 cm, 4 cm, 5 cm]");
  CHECK(value_of("sort([\"b\", \"a\"])") == "[a, b]");
  CHECK(value_of("sort([1, 2, 3], back)", "fn back(x) = -x") == "[3, 2, 1]");
  CHECK(value_of("reverse([1, 2, 3])") == "[3, 2, 1]");
  CHECK(value_of("map([1, 2, 3], half)", "fn half(x) = x / 2") == "[0.5, 1, 1.5]");
  CHECK(value_of("filter([1, 2, 3], large)", "fn large(x) = x > 1") == "[2, 3]");
  CHECK(value_of("steps(1 .. 4)") == "[1, 2, 3, 4]");
  CHECK(value_of("steps(0 cm .. 1 cm, 2.5 mm)") == "[0 cm, 2.5 mm, 5 mm, 7.5 mm, 1 cm]");
  CHECK(value_of("[1, [2, 3]] == [1, [2, 3]]") == "true");
  CHECK(value_of("a == b", "let a = { x = 1, y = 2 }\nlet b = { y = 2, x = 1 }") == "true");
  CHECK(value_of("(a with { x = 3 cm }).x", "let a = { x = 1 cm, y = 2 }") == "3 cm");
}

TEST_CASE("texts are joined and numbers rounded for them") {
  CHECK(value_of("joined([\"a\", 3 cm, true], \" / \")") == "a / 3 cm / true");
  CHECK(value_of("text(123.456 mm, 1 mm)") == "12.3 cm");
  CHECK(value_of("\"waist {text(80.24 cm, 5 mm)}\"") == "waist 80 cm");
  CHECK(value_of("count(\"abc\")") == "3");
}

TEST_CASE("a function may be handed to a function, and call itself 256 deep") {
  CHECK(value_of("twice(half, 8)", "fn half(x) = x / 2\nfn twice(f: function, x) = f(f(x))") == "2");
  CHECK(value_of("f(200)", "fn f(n) = if n < 1 { 0 } else { 1 + f(n - 1) }") == "200");
  refuses("fn f(n) = if n < 1 { 0 } else { 1 + «f(n - 1)» }\nlet a = f(300)", "G0316", "256");
  refuses("let a = map([1], «3»)", "G0306", "function is wanted");
  refuses("fn f(a, b) = a\nlet x = map([1], «f»)", "G0307", "takes 2 values");
}

TEST_CASE("tables are read between their rows and not beyond") {
  const char* const table = "let t = [[36, 84 cm], [38, 88 cm], [42, 100 cm]]";
  CHECK(value_of("interpolate(t, 36)", table) == "84 cm");
  CHECK(value_of("interpolate(t, 37)", table) == "86 cm");
  CHECK(value_of("interpolate(t, 42)", table) == "100 cm");
  CHECK(value_of("interpolate([(0 cm, 1 cm), (10 cm, 3 cm)], 5 cm)") == "2 cm");
  refuses("let t = [[36, 84 cm], [38, 88 cm]]\nlet x = interpolate(t, «40»)", "G0352", "from 36 to 38");
  refuses("let x = interpolate(«[[38, 84 cm], [36, 88 cm]]», 37)", "G0351", "38 is followed by 36");
  refuses("let x = interpolate([[36, 84 cm]], «3 cm»)", "G0305", "in a table over");
  refuses("let x = first_of(«[]»)", "G0350", "empty");
  refuses("let x = sort(«[1, \"a\"]»)", "G0306", "a plain number and text");
  refuses("let x = sum(«[true]»)", "G0306", "truth");
  refuses("let x = steps(0 .. 1, «0»)", "G0309", "over 0");
}

TEST_CASE("values that would grow without end are refused") {
  std::string lists = "let a0 = steps(1 .. 1000)\n", deep = "let a0 = [1]\n";
  for (int k = 1; k < 40; ++k)
    lists += "let a" + std::to_string(k) + " = a" + std::to_string(k - 1) + " + a" + std::to_string(k - 1) + "\n";
  for (int k = 1; k < 300; ++k) deep += "let a" + std::to_string(k) + " = [a" + std::to_string(k - 1) + "]\n";
  const Trial wide(lists);
  INFO(wide.text());
  REQUIRE(wide.result.diagnostics.size() == 1);
  CHECK(wide.result.diagnostics[0].code == "G1601");
  const Trial nested(deep);
  REQUIRE_FALSE(nested.result.diagnostics.empty());
  CHECK(nested.result.diagnostics[0].code == "G1602");
  CHECK(nested.result.diagnostics.size() == 1);
}
