#include "support.hpp"

using namespace garment;
using namespace garment::service_test;

TEST_CASE("the script of these tests is right") {
  for (const auto& d : good().result.diagnostics) UNSCOPED_INFO(d.message);
  CHECK(good().result.ok());
}

TEST_CASE("keywords stand where their construct may stand") {
  const auto top = completions(kScript + "|");
  CHECK(has(top, "panel"));
  CHECK(has(top, "for"));
  CHECK_FALSE(has(top, "edge"));
  CHECK(has(top, "long"));  // may be assigned
  const auto in_panel = completions("panel p of shell {\n  |");
  CHECK(has(in_panel, "outline"));
  CHECK(has(in_panel, "notch"));
  CHECK_FALSE(has(in_panel, "seam"));
  CHECK(texts(completions("panel p of shell {\n  outline from (0, 0) {\n    |"), "keyword") ==
        "edge close if for both");
  CHECK(texts(completions("panel p of shell {\n  for i in 1 .. 2 {\n    not|")) == "notch");
  CHECK(texts(completions(kScript + "sea|")) == "seam");
  CHECK(texts(completions("both sea|")) == "seam");
}

TEST_CASE("clause words are those of the statement at hand") {
  const auto place = completions(kScript + "place front on form.front |");
  CHECK(has(place, "with"));
  CHECK(has(place, "offset"));
  CHECK_FALSE(has(place, "on"));
  CHECK(texts(completions(kScript + "place front on form.front wit|"), "clause") == "with");
  // also one per line, deeper
  CHECK(texts(completions(kScript + "place front on form.front\n    wit|"), "clause") == "with");
  CHECK_FALSE(has(completions(kScript + "place front on form.front\n|"), "with"));
  CHECK(texts(completions("drape until rest settle |")) == "preview equilibrium exact");
}

TEST_CASE("a keyword of two words is one keyword") {
  CHECK(texts(completions("pair pan|"), "keyword") == "panel");
  CHECK(has(completions("pai|"), "pair panel"));
  CHECK(completions("pair panel |").empty());
  CHECK(has(completions(kScript + "pair panel cuff |"), "of"));
  CHECK(has(completions("pair panel cuff of shell {\n  |"), "outline"));
}

TEST_CASE("names are those that the place takes") {
  CHECK(texts(completions(kScript + "panel p of |")) == "shell fabrics bodies");
  CHECK(texts(completions(kScript + "place |")) == "front back");
  const auto seam = completions(kScript + "seam s: |");
  CHECK(has(seam, "front"));
  CHECK_FALSE(has(seam, "w"));
  CHECK(texts(completions("panel front of shell {\n  notch n on |"), "edge") == "hem side waist");
  const auto value = completions(kScript + "let v = |");
  for (const char* name : {"w", "long", "half", "sqrt", "pi", "form", "front", "bodies"})
    CHECK(has(value, name));
  CHECK_FALSE(has(value, "cm"));
  CHECK(has(completions("for i in 1 .. 3 {\n  let v = |"), "i"));
  CHECK(has(completions("fn f(abc: length) = a|"), "abc"));
}

TEST_CASE("after a dot stands what the value has") {
  CHECK(texts(completions(kScript + "let v = front.|")) ==
        "hem waist waist_dart hip left right resolution side cf");
  CHECK(texts(completions(kScript + "seam s: front.left.|")) == "hem side waist waist_dart hip");
  CHECK(texts(completions(kScript + "let v = front.waist.|")) == "start end middle at");
  CHECK(texts(completions(kScript + "let v = front.left.side.|")) == "start end middle at hip");
  CHECK(texts(completions(kScript + "let v = form.wa|")) == "waist");
  CHECK(texts(completions(kScript + "let v = form.waist.|")) == "girth height");
  CHECK(has(completions(kScript + "body b = bodies.|"), "woman"));
  CHECK(has(completions(kScript + "fabric f = fabrics.de|"), "denim"));
  CHECK(has(completions(kScript + "let v = front.left.side[|"), "hip"));
  CHECK(texts(completions(kScript + "front.waist_dart.|"), "clause").rfind("on at width depth to", 0) == 0);
  CHECK(has(completions("panel back of shell like front {\n  waist_dart.de|"), "depth"));
  CHECK(texts(completions(kScript + "seam t: side.|")) == "left right");
}

TEST_CASE("after a number stand units, and those of the clause alone where it has a dimension") {
  const auto units = completions(kScript + "let v = 20 |");
  CHECK(has(units, "cm"));
  CHECK(has(units, "deg"));
  CHECK(has(completions(kScript + "place front on form.front offset 2|"), "cm"));  // it may touch
  CHECK(has(completions(kScript + "place front on form.front offset 2 |"), "cm"));
  CHECK_FALSE(has(completions(kScript + "place front on form.front offset 2 |"), "deg"));
  CHECK(texts(completions(kScript + "let v = 2 inc|")) == "inch");
}

TEST_CASE("in a call stand its arguments, in a record its fields") {
  CHECK(has(completions(kScript + "body b = bodies.woman(|"), "bust:"));
  CHECK_FALSE(has(completions(kScript + "body b = bodies.woman(bust: 90 cm, |"), "bust:"));
  CHECK(has(completions(kScript + "let v = half(|"), "x:"));
  CHECK(has(completions(kScript + "let v = half(|"), "w"));
  const auto record = completions(kScript + "fabric f = fabrics.denim with { |");
  CHECK(has(record, "bend_warp"));
  CHECK_FALSE(has(record, "denim"));
  CHECK_FALSE(has(completions(kScript + "fabric f = fabrics.denim with { bend_warp = 1, |"), "bend_warp"));
  CHECK(has(completions(kScript + "fabric f = fabrics.denim with { bend_warp = |"), "fabrics"));
}

TEST_CASE("nothing is proposed in comments, strings and new names") {
  CHECK(completions(kScript + "# pan|").empty());
  CHECK(completions(kScript + "save \"pan|").empty());
  CHECK(completions(kScript + "panel |").empty());
  CHECK(completions(kScript + "let v = 2 * .|").empty());
}

TEST_CASE("the word at the cursor is what is replaced") {
  const auto found = completions("pan|el front");
  REQUIRE(found.size() == 1);
  CHECK(found[0].replace_begin == 0);
  CHECK(found[0].replace_end == 5);
}

TEST_CASE("no place of a script, broken or not, brings completion down") {
  const std::string text =
      kScript + "fabric q = { T = 1 mm\nseam s: front.[ (2 cm { \"open\npanel x { outline { edge a to (";
  for (std::size_t k = 0; k <= text.size(); k += 7) {
    std::string marked = text;
    marked.insert(k, "|");
    completions(marked);
  }
  SUCCEED();
}
