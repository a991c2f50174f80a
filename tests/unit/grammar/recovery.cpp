// Parsing goes on after a mistake: each mistake is told once, and what is sound comes through.
#include <catch2/catch.hpp>

#include "tests/unit/grammar/test_vocabulary.hpp"

using namespace garment::grammar;
using namespace garment::grammar::test;

TEST_CASE("a broken statement is marked, its neighbours stand") {
  Parsed parsed = parse_text("use a\nlet x = (1 +\nuse b\nlet = 4; use c\n");
  CHECK(parsed.result.diagnostics.size() == 2);
  CHECK(to_outline(parsed.result.script) == "use a\n! let x\n  | =\nuse b\n! let\nuse c\n");
  CHECK(parsed.sources.text(parsed.result.script.statements[1].span) == "let x = (1 +");
}

TEST_CASE("mistakes in a block leave the block and its other statements") {
  Parsed parsed = parse_text(
      "panel a of s {\n"
      "  outline from (0, 0) {\n"
      "    edge hem to (1, 2\n"
      "    edge side to (3, 4)\n"
      "    edge top (5 5)\n"
      "  }\n"
      "  grain @\n"
      "  notch n on side\n"
      "}\n"
      "use b\n");
  REQUIRE(parsed.result.diagnostics.size() == 3);
  CHECK(parsed.result.diagnostics[0].code == "G0203");
  CHECK(parsed.result.diagnostics[1].code == "G0203");
  CHECK(parsed.result.diagnostics[2].code == "G0102");
  CHECK(to_outline(parsed.result.script) ==
        "panel a\n  | of s\n"
        "  outline\n    | from (0, 0)\n    ! edge hem\n      | to\n    edge side\n      | to (3, 4)\n    ! "
        "edge top\n"
        "  ! grain\n  notch n\n    | on side\n"
        "use b\n");
}

TEST_CASE("the block of a broken head is skipped whole") {
  CHECK(codes("pannel front of s {\n  grain $\n  edge (((\n}\nuse a\nlet = 3") == "G0201 G0207");
  CHECK(codes("panel front of ) {\n  outline { }\n}\nuse a") == "G0205");
  CHECK(codes("foo { bar { baz \"}\" # }\n } }\nuse a }") == "G0201 G0205");
}

TEST_CASE("continuation lines of a broken statement belong to it") {
  CHECK(codes("seam s: a b) to c\n  ease 3%\n  start at d\nuse a") == "G0205");
  CHECK(codes("let x = f(a b,\n  c,\n  d\n)\nuse a") == "G0203");
  CHECK(codes("let x = f(\n  a b,\n  c\n)\nuse a") == "G0203");
}

TEST_CASE("a missing } is told at the block that lacks it") {
  Parsed parsed = parse_text(
      "panel p of s {\n"
      "  outline from (0, 0) {\n"
      "    edge a to (1, 2)\n"
      "}\n"
      "panel q of s { grain +y }\n"
      "use a\n");
  REQUIRE(parsed.result.diagnostics.size() == 1);
  CHECK(parsed.result.diagnostics[0].message == "the block of `outline` is not closed");
  CHECK(parsed.result.script.statements.size() == 3);
  CHECK(codes("panel p of s {\n  grain +y\nuse a\nuse b") == "G0204");
  CHECK(codes("panel p of s {\n  outline from (0, 0) {\n    edge a to (1, 2)\n") == "G0204");
}

TEST_CASE("reading stops after many errors") {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "let = 3\n";
  Parsed parsed = parse_text(text);
  REQUIRE(parsed.result.diagnostics.size() == 101);
  CHECK(parsed.result.diagnostics.back().code == "G0218");
}

TEST_CASE("what more lines would complete is told apart from what is wrong") {
  for (const char* text :
       {"panel p of s {", "let x = (1,", "let x = a +", "panel p of s {\n outline from (0, 0) {\n",
        "let x = f(a,\n  b", "if a {\n use b\n} else", "let x = a with {"}) {
    INFO(text);
    CHECK(parse_text(text).result.incomplete);
  }
  for (const char* text :
       {"use a", "let x = 5cn", "save \"abc", "let x = ) (", "panel p of s {\n grain @\n"}) {
    INFO(text);
    CHECK_FALSE(parse_text(text).result.incomplete);
  }
}

TEST_CASE("a mistake after a block does not bring its statements back") {
  CHECK(codes("if a {\n  use b\n  x = 1\n} else\nuse c") == "G0212");
  CHECK(codes("panel p of s {\n  grain +y\n} x\nuse c") == "G0208");
}

TEST_CASE("every prefix and every single deletion of a script is read to its end") {
  const std::string text = kSkirt;
  for (std::size_t n = 0; n < text.size(); n += 7) {
    Parsed parsed = parse_text(text.substr(0, n));
    CHECK(parsed.result.diagnostics.size() < 4);
  }
  for (std::size_t n = 0; n < text.size(); n += 5) {
    std::string cut = text.substr(0, n) + text.substr(n + 1);
    INFO(n << ": " << text.substr(n, 1));
    Parsed parsed = parse_text(cut);
    CHECK(parsed.result.diagnostics.size() < 4);
    CHECK(parsed.result.script.statements.size() > 15);
  }
}

TEST_CASE("a missing { is told once, and the block is read") {
  Parsed parsed =
      parse_text("panel p of s\n  outline from (0, 0) {\n    edge a to (1, 2)\n  }\n  grain +y\n}\nuse a\n");
  REQUIRE(parsed.result.diagnostics.size() == 1);
  CHECK(parsed.result.diagnostics[0].code == "G0212");
  CHECK(parsed.result.diagnostics[0].message == "the block of `panel` has no `{`");
  CHECK(parsed.result.script.statements.size() == 2);
  CHECK(codes("panel p of s\n{\n  grain +y\n}\nuse a") == "G0202");
}
