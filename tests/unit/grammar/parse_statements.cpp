#include <catch2/catch.hpp>

#include "tests/unit/grammar/test_vocabulary.hpp"

using namespace garment::grammar;
using namespace garment::grammar::test;

TEST_CASE("the script of the language's design parses without a diagnostic") {
  Parsed parsed = parse_text(kSkirt);
  CHECK(rendered(parsed) == "");
  CHECK(parsed.result.script.statements.size() == 28);
}

TEST_CASE("an empty source is an empty script") {
  CHECK(outline("") == "");
  CHECK(outline("\n  # only a comment") == "");
  CHECK(outline("\xEF\xBB\xBFuse a") == "use a\n");
}

TEST_CASE("keyword, name, operands, clauses") {
  CHECK(outline("garment 1 \"skirt\"") == "garment 1 \"skirt\"\n");
  CHECK(outline("use fabrics, bodies") == "use fabrics bodies\n");
  CHECK(outline("param long = 58 cm in 30 cm .. 110 cm \"waist to hem\"") ==
        "param long\n  | = 58 cm\n  | in (30 cm .. 110 cm) \"waist to hem\"\n");
  CHECK(outline("seam s: a ease 6% [p .. q] to b") == "seam s\n  | : a\n  | ease 6% [(p .. q)]\n  | to b\n");
  CHECK(outline("region r in front, back: within 10 cm") ==
        "region r\n  | in front back\n  | : within 10 cm\n");
  CHECK(outline("expect x == 5 within 2%") == "expect (x == 5)\n  | within 2%\n");
}

TEST_CASE("clause words are not reserved: they count only as an item of their own statement") {
  CHECK(outline("let to = through + at") == "let to\n  | = (through + at)\n");
  CHECK(outline("place f(at, [on, with]) on x") == "place f(at, [on, with])\n  | on x\n");
  CHECK(outline("place a.at on on.x at(3)") == "place a.at\n  | on on.x at(3)\n");
  CHECK(outline("expect a is b") == "expect a\n  | is b\n");
  CHECK(outline("region r: a and above b or c") == "region r\n  | : a\n  | and\n  | above b\n  | or c\n");
  CHECK(outline("assert a is b and c") == "assert ((a is b) and c)\n");
}

TEST_CASE("`with` followed by a record is a record only where it is no clause word") {
  CHECK(outline("let c = d with { a = 1 }") == "let c\n  | = (d with {a = 1})\n");
  CHECK(outline("place c with { a = 1 }") == "place c\n  | with {a = 1}\n");
}

TEST_CASE("a sign with a blank before and none after begins a new value") {
  CHECK(outline("seam s: a ease 4% -b.c to d + e") ==
        "seam s\n  | : a\n  | ease 4% (-b.c)\n  | to (d + e)\n");
  CHECK(outline("save a - b a-b a- b") == "save (a - b) (a - b) (a - b)\n");
  CHECK(outline("save +x -x +y -y") == "save (+x) (-x) (+y) (-y)\n");
  CHECK(outline("save f(a -b) [a -b] (a -b)") == "save f((a - b)) [(a - b)] (a - b)\n");
  CHECK(outline("place a offset - 5 cm") == "place a\n  | offset (-5 cm)\n");
}

TEST_CASE("a statement ends at the line end") {
  CHECK(outline("use a\nuse b; use c;; use d\n;use e") == "use a\nuse b\nuse c\nuse d\nuse e\n");
  CHECK(outline("let x = a +\n  b *\n\n  # comment\n  c") == "let x\n  | = (a + (b * c))\n");
  CHECK(outline("use a,\n  b") == "use a b\n");
  CHECK(outline("let x =\n  5") == "let x\n  | = 5\n");
  CHECK(outline("seam s:\n  a to b") == "seam s\n  | : a\n  | to b\n");
  CHECK(outline("let x = f(1,\n2\n)\nuse a") == "let x\n  | = f(1, 2)\nuse a\n");
  CHECK(outline("let x = 1 ..\n 2") == "let x\n  | = (1 .. 2)\n");
}

TEST_CASE("a deeper line that begins with a clause word goes on") {
  CHECK(outline("seam s: a\n  # why\n\n  to b\n    ease 2%") == "seam s\n  | : a\n  | to b\n  | ease 2%\n");
  CHECK(outline("  seam s: a\n\tto b") == "seam s\n  | : a\n  | to b\n");
  CHECK(codes("seam s: a\nto b") == "G0201");       // not deeper
  CHECK(codes("seam s: a\n  other b") == "G0201");  // no clause word of seam
  CHECK(outline("panel p of s {\n  dart d on w\n    at 3 cm\n  notch n on w\n}") ==
        "panel p\n  | of s\n  dart d\n    | on w\n    | at 3 cm\n  notch n\n    | on w\n");
}

TEST_CASE("CRLF line ends read as LF") {
  CHECK(outline("use a\r\nseam s: a\r\n  to b\r\n") == outline("use a\nseam s: a\n  to b\n"));
}

TEST_CASE("assignments stand wherever statements do") {
  CHECK(outline("yoke.bend = 1.4") == "= yoke.bend 1.4\n");
  CHECK(outline("long = 70 cm") == "= long 70 cm\n");
  CHECK(outline("h_{i}.depth = 4 cm") == "= h_{i}.depth 4 cm\n");
  CHECK(outline("seam.ease = 1") == "= seam.ease 1\n");
  CHECK(outline("panel p of s { d.depth = 12 cm; grain +y }") ==
        "panel p\n  | of s\n  = d.depth 12 cm\n  grain (+y)\n");
  CHECK(outline("x = a\n  - b\n") != "= x (a - b)\n");  // an operator at the line's begin joins nothing
}

TEST_CASE("functions name themselves by their parameter list") {
  Parsed parsed =
      parse_text("fn half(x) = x / 2\ncomponent sleeve(a: length, b: length = 60 cm) { let c = a }\n");
  CHECK(rendered(parsed) == "");
  CHECK(to_outline(parsed.result.script) ==
        "fn half(x)\n  | = (x / 2)\n"
        "component sleeve sleeve(a: length, b: (length = 60 cm))\n  let c\n    | = a\n");
}

TEST_CASE("if, else, for, both") {
  CHECK(outline("if a < b { use x } else { use y }") == "if (a < b)\n  use x\nelse\n  use y\n");
  CHECK(outline("if a {\n  use x\n}\nelse if b { use y }\nelse { use z }") ==
        "if a\n  use x\nelse\n  if b\n    use y\n  else\n    use z\n");
  CHECK(outline("if a { }\nuse b") == "if a\n  {}\nuse b\n");
  CHECK(outline("for i in 1 .. 3 { let h_{i} = i }") == "for i\n  | in (1 .. 3)\n  let h_{i}\n    | = i\n");
  CHECK(outline("for e in [a, b] { use e }") == "for e\n  | in [a, b]\n  use e\n");
  CHECK(outline("both place sleeve around arm") == "both\n  place sleeve\n    | around arm\n");
  CHECK(outline("both both use a") == "both\n  both\n    use a\n");
  CHECK(outline("panel p of s { for i in 1 .. 3 { notch h_{i} on side at 10% } }") ==
        "panel p\n  | of s\n  for i\n    | in (1 .. 3)\n    notch h_{i}\n      | on side\n      | at 10%\n");
}

TEST_CASE("keywords of two words") {
  CHECK(outline("pair  panel sleeve of s { grain +y }") == "pair panel sleeve\n  | of s\n  grain (+y)\n");
  CHECK(outline("panel p like q { replace edge hem to (1, 2) }") ==
        "panel p\n  | like q\n  replace edge hem\n    | to (1, 2)\n");
}

TEST_CASE("doc comments directly above a statement belong to it") {
  CHECK(outline("## The front.\n##   indented\npanel p of s {\n  ## up\n  grain +y\n}") ==
        "## The front.\n##   indented\npanel p\n  | of s\n  ## up\n  grain (+y)\n");
  CHECK(outline("## lost\n\nuse a") == "use a\n");
  CHECK(outline("#### ruler\nuse a # no\nuse b") == "use a\nuse b\n");
  CHECK(outline("## set\nx = 1") == "## set\n= x 1\n");
}

TEST_CASE("clause and body spans") {
  Parsed parsed = parse_text("panel p of s on fold cf { grain +y }");
  const Statement& s = parsed.result.script.statements.at(0);
  CHECK(parsed.sources.text(s.clauses[1].span) == "on fold cf");
  CHECK(parsed.sources.text(s.body_span) == "{ grain +y }");
  CHECK(parsed.sources.text(s.keyword.span) == "panel");
  CHECK(parsed.sources.text(s.name->span) == "p");
}
