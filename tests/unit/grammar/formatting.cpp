#include <catch2/catch.hpp>

#include "tests/unit/grammar/test_vocabulary.hpp"

using namespace garment::grammar;
using namespace garment::grammar::test;

namespace {

std::string formatted(const std::string& text) {
  Sources sources;
  SourceId id = sources.add("test.garment", text);
  return format(sources, id, vocabulary()).text;
}

/// Formats, and holds that the result says the same and stays as it is when formatted again.
std::string checked(const std::string& text) {
  std::string once = formatted(text);
  Parsed before = parse_text(text), after = parse_text(once);
  INFO(text << "\n-----\n" << once << rendered(before) << rendered(after));
  CHECK(before.result.diagnostics.empty());
  CHECK(after.result.diagnostics.empty());
  CHECK(same_tree(before.result.script.statements, after.result.script.statements));
  CHECK(formatted(once) == once);
  return once;
}

}  // namespace

TEST_CASE("the formatter sets blanks anew") {
  CHECK(checked("param  size=40   in 34..48  \"EU size\"") == "param size = 40 in 34 .. 48 \"EU size\"\n");
  CHECK(checked("let x=a+b*( c-d )/2") == "let x = a + b * (c - d) / 2\n");
  CHECK(checked("let p=(1cm,- 2 cm,+x)") == "let p = (1 cm, -2 cm, +x)\n");
  CHECK(checked("let x = 50 % width") == "let x = 50% width\n");
  CHECK(checked("let k = 0.12gf*cm^2/cm") == "let k = 0.12 gf*cm^2/cm\n");
  CHECK(checked("let k = 5 cm ^ 2 + a ^ 2 + 2^-1") == "let k = 5 cm ^ 2 + a^2 + 2^-1\n");
  CHECK(checked("let x = 20 cm/4 + 20 cm/w") == "let x = 20 cm / 4 + 20 cm / w\n");
  CHECK(checked("seam  a :b  ease 4% -c.d to e+f") == "seam a: b ease 4% -c.d to e + f\n");
  CHECK(checked("save a -b a-b") == "save a -b a - b\n");
  CHECK(checked("save side[start..hip] side[ .. hip ] x[..] y [1]") ==
        "save side[start .. hip] side[.. hip] x[..] y [1]\n");
  CHECK(checked("body b = f ( 40,x )") == "body b = f (40, x)\n");
  CHECK(checked("body b = f(size :40,x)(2)[1]") == "body b = f(size: 40, x)(2)[1]\n");
  CHECK(checked("assert not(a)and(b) or not not c") == "assert not (a) and (b) or not not c\n");
  CHECK(checked("assert - -a == - ( b )") == "assert --a == -(b)\n");
  CHECK(checked("let c=d with{a=1,b=2}") == "let c = d with { a = 1, b = 2 }\n");
  CHECK(checked("let c={}") == "let c = {}\n");
  CHECK(checked("let x=if a {1}else{2}") == "let x = if a { 1 } else { 2 }\n");
  CHECK(checked("let h_{i+1} = \"a  {i+1}  b\"") == "let h_{i+1} = \"a  {i+1}  b\"\n");
  CHECK(checked("use a ;use b;;use c") == "use a; use b;; use c\n");
}

TEST_CASE("the formatter indents blocks by two") {
  CHECK(checked("panel p of s {\n      grain +y\n\n\n\n  outline from (0,0) {\n edge a to (1,2)\n   through "
                "(3,4)\n }\n\n }") ==
        "panel p of s {\n"
        "  grain +y\n"
        "\n"
        "  outline from (0, 0) {\n"
        "    edge a to (1, 2)\n"
        "      through (3, 4)\n"
        "  }\n"
        "}\n");
  CHECK(checked("panel p of s { grain +y }") == "panel p of s { grain +y }\n");
  CHECK(checked("panel p of s { grain +y\n notch n on a }") ==
        "panel p of s {\n  grain +y\n  notch n on a\n}\n");
  CHECK(checked("if a {\nuse b }\nelse if c { use d }\nelse {\nuse e\n}") ==
        "if a {\n  use b\n} else if c { use d } else {\n  use e\n}\n");
  CHECK(checked("for i in 1..3 {\nlet x = i }") == "for i in 1 .. 3 {\n  let x = i\n}\n");
}

TEST_CASE("the formatter keeps line ends within a statement") {
  CHECK(checked("let x = f(\n a,\n      b\n)") == "let x = f(\n  a,\n  b\n)\n");
  CHECK(checked("let x = f(a,\nb)") == "let x = f(a,\n  b)\n");
  CHECK(checked("let x = a +\nb") == "let x = a +\n  b\n");
  CHECK(checked("let x = (a\n+ b)") == "let x = (a\n  + b)\n");
  CHECK(checked("let c = d with {\na = 1\n\nb = [\n1,\n2\n]\n}") ==
        "let c = d with {\n  a = 1\n\n  b = [\n    1,\n    2\n  ]\n}\n");
  CHECK(checked("seam s: a\n # why\n       to b\n    ease 2%\nuse c") ==
        "seam s: a\n  # why\n  to b\n  ease 2%\nuse c\n");
}

TEST_CASE("the formatter keeps comments") {
  CHECK(checked("# first\n\n\n## doc\nuse a# trailing  \n   # last\n") ==
        "# first\n\n## doc\nuse a  # trailing\n# last\n");
  CHECK(checked("panel p of s {# open\n# in\ngrain +y # up\n# end\n}# close") ==
        "panel p of s {  # open\n  # in\n  grain +y  # up\n  # end\n}  # close\n");
  CHECK(checked("let x = [\n1, # one\n# two\n2\n]") == "let x = [\n  1,  # one\n  # two\n  2\n]\n");
  CHECK(checked("# only") == "# only\n");
  CHECK(checked("") == "");
  CHECK(checked("if a { use b }\n# why\nelse { use c }") == "if a { use b }\n# why\nelse { use c }\n");
}

TEST_CASE("statements that share a line stay statements of their own") {
  // `at` would go on with the first notch if it came to stand deeper than it.
  CHECK(checked("    panel p of s { notch n on a\n  at = 5 }") ==
        "panel p of s {\n  notch n on a\n  at = 5\n}\n");
  checked("panel p of s { grain +y; notch n on a\n   at 3 cm\n }");
  checked("use a; seam s: b\n    to c");
  CHECK(checked("seam s: a or\nb; param y = 1\n   in c") == "seam s: a or\n  b;\nparam y = 1\n  in c\n");
}

TEST_CASE("line ends become LF, a byte order mark goes") {
  CHECK(checked("use a\r\nuse b\r\n") == "use a\nuse b\n");
  CHECK(checked("\xEF\xBB\xBFuse a") == "use a\n");
}

TEST_CASE("the whole script formats, and stays") {
  std::string once = checked(kSkirt);
  CHECK(once.substr(0, 74) ==
        "garment 1 \"darted skirt\"  # edition of the language, title\nuse fabrics, bo");
}

TEST_CASE("a source with errors comes back as it was, with its diagnostics") {
  Sources sources;
  SourceId id = sources.add("t", "let   x = (\n");
  FormatResult result = format(sources, id, vocabulary());
  CHECK(result.text == "let   x = (\n");
  CHECK(result.diagnostics.size() == 1);
}
