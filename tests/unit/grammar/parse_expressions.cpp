#include <catch2/catch.hpp>

#include "tests/unit/grammar/test_vocabulary.hpp"

using namespace garment::grammar;
using namespace garment::grammar::test;

namespace {

/// The expression as the outline shows it, with all its brackets; or the diagnostics.
std::string expr(const std::string& text) {
  std::string out = outline("let x = " + text + "\n");
  const std::string head = "let x\n  | = ";
  if (out.compare(0, head.size(), head) != 0) return out;
  return out.substr(head.size(), out.size() - head.size() - 1);
}

struct Case {
  const char* text;
  const char* tree;
};

void check(const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    INFO(c.text);
    CHECK(expr(c.text) == c.tree);
  }
}

}  // namespace

TEST_CASE("precedence: or, and, not, comparison, sum, product, sign, power") {
  check({{"a + b * c", "(a + (b * c))"},
         {"a * b + c", "((a * b) + c)"},
         {"a - b - c", "((a - b) - c)"},
         {"a / b / c", "((a / b) / c)"},
         {"a / b * c", "((a / b) * c)"},
         {"a ^ b ^ c", "(a ^ (b ^ c))"},
         {"-a ^ 2", "(-(a ^ 2))"},
         {"2 ^ -1 * 3", "((2 ^ (-1)) * 3)"},
         {"2 ^ -1 ^ 2", "(2 ^ (-(1 ^ 2)))"},
         {"-a * b", "((-a) * b)"},
         {"--a", "(-(-a))"},
         {"a < b and c >= d or e", "(((a < b) and (c >= d)) or e)"},
         {"not a == b and c", "((not (a == b)) and c)"},
         {"not not a", "(not (not a))"},
         {"a or b and c", "(a or (b and c))"},
         {"a and b minus c", "((a and b) minus c)"},
         {"a != b", "(a != b)"},
         {"a is b", "(a is b)"},
         {"a + 1 <= b * 2", "((a + 1) <= (b * 2))"},
         {"(a + b) * c", "((a + b) * c)"},
         {"((a))", "a"},
         {"- 5", "(-5)"}});
}

TEST_CASE("ranges bind loosest") {
  check({{"0 .. 1", "(0 .. 1)"},
         {"0..1", "(0 .. 1)"},
         {"a + 1 .. b - 1", "((a + 1) .. (b - 1))"},
         {"1.5..2.5", "(1.5 .. 2.5)"},
         {"30 cm .. 110 cm", "(30 cm .. 110 cm)"}});
}

TEST_CASE("numbers and units: longest match, blanks only before the unit") {
  check({{"58 cm", "58 cm"},
         {"58cm", "58 cm"},
         {"50%", "50%"},
         {"50 %", "50%"},
         {"1e3 mm", "1000 mm"},
         {"1.5e-3", "0.0015"},
         {"0.12 gf*cm^2/cm", "0.12 gf*cm^2/cm"},
         {"3 N*m^-2", "3 N*m^-2"},
         {"20 cm/4", "(20 cm / 4)"},
         {"20 cm / w", "(20 cm / w)"},
         {"20 cm/w", "(20 cm / w)"},
         {"20 cm * m", "(20 cm * m)"},
         {"5 cm^2", "5 cm^2"},
         {"5 cm ^ 2", "(5 cm ^ 2)"},
         {"5 cm^k", "(5 cm ^ k)"},
         {"2 * 3 cm", "(2 * 3 cm)"},
         {"2 inch", "2 inch"}});
  CHECK(outline("dart d on waist at 50% width take depth 9 cm\n").find("G0209") != std::string::npos);
  CHECK(outline("let x = 50% width\n") == "let x\n  | = 50% width\n");
  CHECK(outline("let x = a cm\n") == "let x\n  | = a cm\n");  // a unit only directly after a number
}

TEST_CASE("a word that is a unit is a unit after a number, even where it is a clause word") {
  Vocabulary v = vocabulary();
  v.keywords.push_back({"scale", false, {"m", "to"}, false, {}});
  v.top.push_back("scale");
  Sources sources;
  SourceId id = sources.add("t", "scale 5 m m 3 to 4 m\n");
  ParseResult result = parse(sources, id, v);
  CHECK(result.diagnostics.empty());
  CHECK(to_outline(result.script) == "scale 5 m\n  | m 3\n  | to 4 m\n");
}

TEST_CASE("members, calls and indices touch what they follow") {
  check(
      {{"front.left.side", "front.left.side"},
       {"bodies.woman(size: 40, 3)", "bodies.woman(size: 40, 3)"},
       {"f()", "f()"},
       {"f(a)(b).c[1]", "f(a)(b).c[1]"},
       {"front.armhole[0 .. 1/3]", "front.armhole[0 .. (1 / 3)]"},
       {"side[start ..]", "side[start .. _]"},
       {"side[.. hip]", "side[_ .. hip]"},
       {"side[..]", "side[_ .. _]"},
       {"edges[2]", "edges[2]"},
       {"a.not", "a.not"},
       {"f(\n  a,\n  b,\n)", "f(a, b)"},
       {"f(a: b == c)", "f(a: (b == c))"},
       {"length (a)", "length a"},
       {"sleeve(armhole: length, long: length = 60 cm)", "sleeve(armhole: length, long: (length = 60 cm))"}});
  CHECK(outline("save a [1]\n") == "save a [1]\n");
}

TEST_CASE("points, lists, strings, booleans") {
  check({{"(1, 2)", "(1, 2)"},
         {"(1 cm, -2 cm, z)", "(1 cm, (-2 cm), z)"},
         {"[]", "[]"},
         {"[a, (1, 2), [b]]", "[a, (1, 2), [b]]"},
         {"[a, b,]", "[a, b]"},
         {"[\n  a, # first\n  b\n]", "[a, b]"},
         {"true", "true"},
         {"false or truely", "(false or truely)"},
         {"\"plain\"", "\"plain\""},
         {"\"\"", "\"\""},
         {R"("a \"b\" \\ \n \{c}")", R"("a \"b\" \\ \n \{c}")"},
         {"\"dart {i + 1} of {n}\"", "\"dart {(i + 1)} of {n}\""},
         {R"("{f("x")}")", R"("{f("x")}")"},
         {"\"größe\"", "\"größe\""}});
}

TEST_CASE("names with braces carry their parts") {
  check({{"h_{i}", "h_{i}"}, {"a_{i + 1}_b{j}", "a_{i + 1}_b{j}"}, {"front.h_{i}.x", "front.h_{i}.x"}});
  Parsed parsed = parse_text("let h_{i + 1}_end = front.d_{i}\n");
  REQUIRE(parsed.result.diagnostics.empty());
  const Statement& s = parsed.result.script.statements.at(0);
  REQUIRE(s.name->parts.size() == 3);
  CHECK(s.name->text == "h_{i + 1}_end");
  CHECK(s.name->parts[0].kind == ExprKind::text);
  CHECK(s.name->parts[0].text == "h_");
  CHECK(s.name->parts[1].kind == ExprKind::binary);
  CHECK(s.name->parts[2].text == "_end");
  const Expr& member = s.clauses.at(0).values.at(0);
  REQUIRE(member.children.size() == 3);
  CHECK(member.children[1].text == "d_");
  CHECK(member.children[2].text == "i");
}

TEST_CASE("conditional values") {
  check({{"if a { 1 } else { 2 }", "(if a {1} else {2})"},
         {"if a < b { 1 } else if c { 2 } else { 3 }", "(if (a < b) {1} else {(if c {2} else {3})})"},
         {"1 + if a { 1 } else { 2 } * 3", "(1 + ((if a {1} else {2}) * 3))"},
         {"if a {\n  1\n} else {\n  2\n}", "(if a {1} else {2})"}});
}

TEST_CASE("records stand after = and with") {
  check({{"{ a = 1, b = 2 cm }", "{a = 1, b = 2 cm}"},
         {"{\n  a = 1\n\n  b = x -y  # c\n}", "{a = 1, b = (x - y)}"},
         {"{}", "{}"},
         {"canvas with { bend_warp = 3 * canvas.bend_warp }",
          "(canvas with {bend_warp = (3 * canvas.bend_warp)})"},
         {"a with { b = { c = 1 } }", "(a with {b = {c = 1}})"},
         {"f(a with { b = 1 })", "f((a with {b = 1}))"}});
  CHECK(outline("a.b = { c = 1 }\n") == "= a.b {c = 1}\n");
}

TEST_CASE("spans cover what was written, brackets included") {
  Parsed parsed = parse_text("let x = (a + b) * front.side\n");
  REQUIRE(parsed.result.diagnostics.empty());
  const Expr& product = parsed.result.script.statements[0].clauses[0].values[0];
  CHECK(parsed.sources.text(product.span) == "(a + b) * front.side");
  CHECK(parsed.sources.text(product.children[0].span) == "(a + b)");
  CHECK(parsed.sources.text(product.children[1].span) == "front.side");
  CHECK(parsed.sources.text(product.children[1].name_span) == "side");
  CHECK(parsed.sources.text(parsed.result.script.statements[0].span) == "let x = (a + b) * front.side");
}

TEST_CASE("an expression alone, as at the prompt") {
  auto lone = [](const std::string& text) {
    Sources sources;
    SourceId id = sources.add("<prompt>", text);
    return parse_expression(sources, id, vocabulary());
  };
  ExpressionResult sum = lone("  a -b\n");
  CHECK(sum.diagnostics.empty());
  CHECK(sum.expr.kind == ExprKind::binary);
  CHECK(lone("strain(all) < 8%").expr.kind == ExprKind::binary);
  CHECK(lone("panel").expr.kind == ExprKind::name);
  CHECK(lone("a b").diagnostics.at(0).code == "G0208");
  CHECK_FALSE(lone("a b").incomplete);
  CHECK(lone("a b").expr.kind == ExprKind::error);
  CHECK(lone("f(a,").incomplete);
  CHECK(lone("a +").incomplete);
  CHECK(lone("").diagnostics.at(0).code == "G0206");
}
