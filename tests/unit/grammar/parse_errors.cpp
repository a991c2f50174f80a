// One mistake, one message at its place: the code, the text under the carets, and the words.
#include <catch2/catch.hpp>

#include "tests/unit/grammar/test_vocabulary.hpp"

using namespace garment::grammar;
using namespace garment::grammar::test;

namespace {

struct Mistake {
  std::string text;
  std::string code;
  std::string marked;   ///< what the carets stand under
  std::string message;  ///< part of it
  std::string help;     ///< part of it
};

void fails(const std::vector<Mistake>& cases) {
  for (const Mistake& c : cases) {
    Parsed parsed = parse_text(c.text);
    INFO(c.text << "\n" << rendered(parsed));
    REQUIRE(parsed.result.diagnostics.size() == 1);
    const Diagnostic& d = parsed.result.diagnostics[0];
    CHECK(d.code == c.code);
    CHECK(d.severity == garment::Severity::error);
    REQUIRE_FALSE(d.labels.empty());
    CHECK(parsed.sources.text(d.labels[0].span) == c.marked);
    CHECK_THAT(d.message, Catch::Contains(c.message));
    CHECK_THAT(d.help, Catch::Contains(c.help));
    CHECK(find_code(d.code) != nullptr);
  }
}

}  // namespace

TEST_CASE("mistakes of lexis") {
  fails({{"save \"abc\n", "G0103", "\"abc", "the string is not closed", "add a `\"`"},
         {"let a = \"x\" \"y", "G0103", "\"y", "not closed", ""},
         {"save \"a \\q b\"", "G0104", "\\q", "`\\q` is no escape", "\\{"},
         {"save \"a \\", "G0104", "\\", "no escape", ""},
         {"let x = 5 $ 3", "G0102", "$", "unknown character `$`", ""},
         {"let x = “a”", "G0102", "“", "unknown character `“`", "straight quotes"},
         {"let x = 'a'", "G0102", "'", "unknown character `'`", "double quotes"},
         {"let x = 3 × 4", "G0102", "×", "unknown character `×`", "`*`"},
         {"let x = 3 – 4", "G0102", "–", "unknown character", "`-`"},
         {"let x = 45°", "G0102", "°", "unknown character", "45 deg"},
         {"let größe = 3", "G0102", "ö", "unknown character `ö`", ""},
         {"let x\u00A0= 3", "G0102", "\u00A0", "unknown character", "non-breaking"},
         {"let x = a ! b", "G0102", "!", "unknown character", "`not`"},
         {"let x = a & b", "G0102", "&", "unknown character", "`and`"},
         {"\x01", "G0102", "\x01", "`\\x01`", ""},
         {"let x = 5cn", "G0105", "cn", "unknown unit `cn`", "did you mean `cm`?"},
         {"let p = (5 cn, 3)", "G0105", "cn", "unknown unit `cn`", "did you mean `cm`?"},
         {"let x = 0x1F", "G0105", "x1F", "unknown unit `x1F`", ""},
         {"let x = 1e999", "G0106", "1e999", "the number 1e999 is out of range", ""},
         {"let x = 5.", "G0107", ".", "a point at the end", "`0 .. 1`"},
         {"let x = 1.2.3", "G0107", ".", "a point at the end", ""},
         {"let x = 2(w)", "G0107", "(", "the number runs into `(`", "operator"},
         {"let x = 50%width", "G0107", "width", "the number runs into `width`", "blank"}});
}

TEST_CASE("sources that cannot be read at all") {
  fails({{"let x = \"\xFF\"", "G0101", "\xFF", "0xff is not UTF-8", "UTF-8"},
         {"\xC0\x80", "G0101", "\xC0", "not UTF-8", ""},
         {"\xED\xA0\x80", "G0101", "\xED", "not UTF-8", ""},
         {"\xE2\x82", "G0101", "\xE2", "not UTF-8", ""},
         {std::string("use a\0b", 7), "G0109", std::string("\0", 1), "zero byte", ""},
         {std::string((4u << 20) + 1, ' '), "G0108", "", "at most 4194304", "right file"}});
  CHECK(codes(std::string(4u << 20, ' ')) == "");
}

TEST_CASE("statements that are none") {
  fails(
      {{"pannel front of s { grain +y }", "G0201", "pannel", "unknown statement `pannel`",
        "did you mean `panel`?"},
       {"panel p of s { grian +y }", "G0201", "grian", "unknown statement `grian`", "did you mean `grain`?"},
       {"zzzz 3", "G0201", "zzzz", "unknown statement `zzzz`", "keyword"},
       {"component{ }", "G0201", "component", "unknown statement", "a blank"},
       {"front.depth 11 cm", "G0202", "front.depth", "`front.depth` alone is no statement", "name = value"},
       {"( 3 )", "G0202", "(", "cannot begin with `(`", ""},
       {"5", "G0202", "5", "cannot begin with the number `5`", ""},
       {"\"a\"", "G0202", "\"a\"", "cannot begin with a string", ""},
       {"{ }", "G0202", "{", "cannot begin with `{`", ""},
       {"else { }", "G0202", "else", "`else` without an `if`", ""},
       {"both", "G0202", "", "expected a statement after `both`", ""},
       {"both\nuse a", "G0202", "", "expected a statement after `both`, found the end of the line", ""},
       {"edge hem to (1, 2)", "G0209", "edge", "`edge` cannot stand at the top level", "`outline` or `hole`"},
       {"panel p of s { edge a to (1, 2) }", "G0209", "edge", "cannot stand inside `panel`", "`outline`"},
       {"use a }", "G0205", "}", "`}` closes nothing", ""},
       {"use a )", "G0205", ")", "`)` closes nothing", ""},
       {"] use a", "G0205", "]", "`]` closes nothing", ""}});
}

TEST_CASE("brackets and blocks that are not closed") {
  fails(
      {{"let x = (1, 2", "G0203", "(", "`(` is not closed", ""},
       {"let x = (1, 2\nlet y = 3", "G0203", "(", "`(` is not closed", ""},
       {"let x = f(a,\nlet y = 3", "G0203", "(", "`(` is not closed", ""},
       {"let x = f(a b)", "G0203", "b", "expected `,` or `)`, found `b`", ""},
       {"let x = [1 2]", "G0203", "2", "expected `,` or `]`, found the number `2`", ""},
       {"let x = f(,)", "G0203", ",", "expected a value, found `,`", ""},
       {"let x = f(a\n  b)", "G0203", "b", "found `b`", ""},
       {"let x = (1, 2]", "G0203", "]", "expected `,` or `)`, found `]`", ""},
       {"let x = a[..b", "G0203", "[", "`[` is not closed", ""},
       {"let x = a with { b = 1", "G0203", "{", "`{` is not closed", ""},
       {"let x = { a = 1\nlet y = 2", "G0203", "{", "`{` is not closed", ""},
       {"let h_{i = 3", "G0203", "=", "expected `}`", ""},
       {"save \"a {b\"", "G0203", "{", "`{` is not closed", ""},
       {"save \"a {b c}\"", "G0203", "c", "expected `}`, found `c`", ""},
       {"let x = f(a == 1, b = )", "G0206", ")", "the default of the parameter", ""},
       {"panel p of s {\n grain +y\n", "G0204", "{", "the block of `panel` is not closed", "add the missing"},
       {"if a { use b", "G0204", "{", "the block of `if` is not closed", ""}});
}

TEST_CASE("values that are missing") {
  fails({{"let w = a /", "G0206", "/", "expected a value after `/`, found the end of the text", ""},
         {"let w = a / # why\n", "G0206", "/", "expected a value after `/`", ""},
         {"let w = a +\nlet b = 3", "G0206", "+", "the next line begins a new statement", ""},
         {"let w =", "G0206", "=", "expected a value after `=`", ""},
         {"let w = )", "G0206", ")", "expected a value after `=`, found `)`", ""},
         {"use a,\nuse b", "G0206", ",", "the next line begins a new statement", ""},
         {"seam s: a, to b", "G0206", "to", "expected another value after `,`, found `to`",
          "`to` begins a clause"},
         {"seam s:\nuse a", "G0206", ":", "expected a value after `:`", ""},
         {"let x = .5", "G0206", ".", "found `.`", "0.5"},
         {"let x = ()", "G0206", ")", "after `(`", ""},
         {"let x = (1, )", "G0206", ")", "after `,`", ""},
         {"let x = a[]", "G0206", "]", "a value or a range after `[`", ""},
         {"let x = f(a:)", "G0206", ")", "the value of the argument after `:`", ""},
         {"let x = not", "G0206", "not", "after `not`", ""},
         {"let x = a..", "G0206", "..", "the end of the range", ""},
         {"let x = { b = }", "G0206", "}", "after `=`", ""},
         {"x = \nuse a", "G0206", "=", "after `=`", ""},
         {"save \"a {}\"", "G0206", "}", "after `{`", ""},
         {"if { }", "G0206", "{", "a condition after `if`", ""},
         {"for i in { }", "G0206", "{", "a range or a list after `in`", ""}});
}

TEST_CASE("names that are missing") {
  fails({{"let = 3", "G0207", "=", "expected a name, found `=`", ""},
         {"let 5 = 3", "G0207", "5", "expected a name, found the number `5`", ""},
         {"panel of s { grain +y }", "G0207", "of", "expected a name, found `of`", "clause word"},
         {"panel\n", "G0207", "", "found the end of the line", ""},
         {"for in 1 .. 2 { }", "G0207", "in", "the name of the loop variable", ""},
         {"let x = a.", "G0207", "", "a name after `.`", ""},
         {"let x = a.5", "G0207", "5", "a name after `.`, found the number `5`", ""}});
}

TEST_CASE("what is left over") {
  fails({{"expect a = b", "G0208", "=", "found `=`", "`==` compares"},
         {"x = a -b", "G0208", "-", "found `-`", "`a - b`"},
         {"x = 3 4", "G0208", "4", "found the number `4`", ""},
         {"let x = 1 ... 2", "G0208", "..", "found `..`", ""},
         {"panel p of s { } use a", "G0208", "use", "found `use`", "new line or after `;`"},
         {"use a { }", "G0211", "{", "`use` takes no block", ""},
         {"x = 1 { }", "G0211", "{", "an assignment takes no block", ""},
         {"seam s: a to b { }", "G0211", "{", "`seam` takes no block", ""}});
}

TEST_CASE("blocks, conditionals, loops, comparisons, points, records") {
  fails({{"if a use b", "G0212", "use", "expected `{`, found `use`", "a blank before"},
         {"if a { } else use b", "G0212", "use", "expected `{` or `if` after `else`", ""},
         {"for i in 1 .. 2 use i", "G0212", "use", "expected `{`", ""},
         {"for i of 1 { }", "G0217", "of", "expected `in`, found `of`", "for i in 1 .. 5"},
         {"assert a < b < c", "G0213", "<", "comparisons do not chain", "`and`"},
         {"assert a == b is c", "G0213", "is", "comparisons do not chain", ""},
         {"let x = (1, 2, 3, 4)", "G0214", "4", "a point with 4 coordinates", "square brackets"},
         {"let x = if a { 1 }", "G0215", "", "expected `else`", "else { 40 cm }"},
         {"let x = if a { 1 } else 2", "G0215", "2", "expected `{` after `else`", ""},
         {"let x = if a 1", "G0215", "1", "expected `{` after the condition", ""},
         {"let x = a with { b: 1 }", "G0216", "b", "an entry `key = value`", "commas"},
         {"let x = a with { b = 1 c = 2 }", "G0216", "c", "an entry `key = value`", ""}});
}

TEST_CASE("nesting has an end") {
  auto repeat = [](const std::string& text, int n) {
    std::string out;
    for (int i = 0; i < n; ++i) out += text;
    return out;
  };
  CHECK(codes("let x = " + repeat("(", 150) + "a" + repeat(")", 150)) == "");
  CHECK(codes("let x = 1" + repeat(" + 1", 150)) == "");
  for (const char* open : {"(", "[", "f(", "a[", "\"{", "a{", "if ", "a.f(", "{a={a="}) {
    INFO(open);
    CHECK(codes("let x = " + repeat(open, 100000)) == "G0210");
  }
  for (const char* link : {"1 + ", "a ^ ", "a.", "not ", "-", "a == b and "}) {
    INFO(link);
    CHECK(codes("let x = " + repeat(link, 100000) + "a") == "G0210");
  }
  CHECK(codes("let x = a" + repeat("()", 100000)) == "G0210");
  CHECK(codes(repeat("both ", 100000) + "use a") == "G0210");
  CHECK(codes(repeat("if a {\n", 100000)) == "G0210");
  CHECK(codes(repeat("for i in 1 .. 2 {", 100000)) == "G0210");
  CHECK(codes("if a { }" + repeat(" else if a { }", 100000)) == "G0210");
  CHECK(codes(repeat("{", 100000)) == "G0202");
}
