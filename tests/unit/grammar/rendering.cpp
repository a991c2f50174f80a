// Exact pictures of diagnostics.
#include <catch2/catch.hpp>

#include "tests/unit/grammar/test_vocabulary.hpp"

using namespace garment::grammar;
using garment::Severity;

namespace {

struct Scene {
  Sources sources;
  SourceId id = 0;

  explicit Scene(std::string text) { id = sources.add("shirt.garment", std::move(text)); }
  /// The `n`-th place where `word` stands.
  Span find(const std::string& word, int n = 1) const {
    std::size_t at = sources[id].text.find(word);
    while (--n > 0) at = sources[id].text.find(word, at + 1);
    return {id, static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(at + word.size())};
  }
};

}  // namespace

TEST_CASE("the picture of the language's design") {
  Scene scene(std::string(40, '\n') + "seam armhole: sleeve.cap ease 4% to front.armhole + back.armhole\n");
  Diagnostic d{"G0312",
               Severity::error,
               "seam `armhole` is 31 mm too long on the sleeve side",
               {{scene.find("sleeve.cap"), "526 mm"},
                {scene.find("front.armhole + back.armhole"), "224 mm + 252 mm, with 4% ease 495 mm"}},
               "lower `cap_height`: 13.2 cm would fit (it is 15 cm)"};
  CHECK(render(d, scene.sources, false) ==
        R"(error[G0312]: seam `armhole` is 31 mm too long on the sleeve side
  --> shirt.garment:41:15
   |
41 | seam armhole: sleeve.cap ease 4% to front.armhole + back.armhole
   |               ^^^^^^^^^^ 526 mm
   |                                     ---------------------------- 224 mm + 252 mm, with 4% ease 495 mm
   = help: lower `cap_height`: 13.2 cm would fit (it is 15 cm)
)");
}

TEST_CASE("labels on several lines come in the order of the lines") {
  Scene scene("let a = 1\nlet b = 2\n\n\nlet a = 3\n");
  Diagnostic d{"G0300",
               Severity::warning,
               "`a` twice",
               {{scene.find("a", 2), "again"}, {scene.find("a"), "first"}},
               ""};
  d.labels[0].span = {0, 26, 27};
  CHECK(render(d, scene.sources, false) ==
        R"(warning[G0300]: `a` twice
 --> shirt.garment:5:5
  |
1 | let a = 1
  |     - first
...
5 | let a = 3
  |     ^ again
)");
}

TEST_CASE("a label over several lines") {
  Scene scene("panel p {\n  grain +y\n\n  notch a\n}\nuse b\n");
  Diagnostic d{"G0400", Severity::note, "this panel", {{{0, 8, 33}, "from here to there"}}, "one\ntwo"};
  CHECK(render(d, scene.sources, false) ==
        R"(note[G0400]: this panel
 --> shirt.garment:1:9
  |
1 | panel p {
  |         ^
...
5 | }
  | ^ from here to there
  = help: one
          two
)");
}

TEST_CASE("tabs, control characters and wide characters keep the carets in place") {
  Scene scene("\tlet\ta = \"é漢\x1b[31m\" $\n");
  Diagnostic d{"G0102", Severity::error, "unknown \x1b[0m", {{scene.find("$"), "he\tre"}}, ""};
  CHECK(render(d, scene.sources, false) ==
        "error[G0102]: unknown \\x1b[0m\n"
        " --> shirt.garment:1:20\n"
        "  |\n"
        "1 |     let a = \"é漢\\x1b[31m\" $\n"
        "  |                           ^ he\\tre\n");
  Scene bidi("use \u202Ea\n");
  Diagnostic e{"G0102", Severity::error, "x", {{bidi.find("a"), ""}}, ""};
  CHECK(render(e, bidi.sources, false) ==
        "error[G0102]: x\n --> shirt.garment:1:6\n  |\n1 | use \\u{202e}a\n  |             ^\n");
}

TEST_CASE("an empty span, the end of a line, and the end of the text get one caret") {
  Scene scene("use a\r\nuse");
  Diagnostic d{"G0206",
               Severity::error,
               "x",
               {{{0, 5, 5}, "here"}, {{0, 10, 10}, "and here"}, {{0, 99, 200}, "far"}},
               ""};
  CHECK(render(d, scene.sources, false) ==
        R"(error[G0206]: x
 --> shirt.garment:1:6
  |
1 | use a
  |      ^ here
2 | use
  |    - and here
  |    - far
)");
}

TEST_CASE("labels in two sources, and none at all") {
  Scene scene("use a\n");
  SourceId other = scene.sources.add("lib/a.garment", "let x = 1\n");
  Diagnostic d{"G0300", Severity::error, "m", {{{0, 4, 5}, "used"}, {{other, 4, 5}, "made"}}, "h"};
  CHECK(render(d, scene.sources, false) ==
        R"(error[G0300]: m
 --> shirt.garment:1:5
  |
1 | use a
  |     ^ used
 ::: lib/a.garment:1:5
  |
1 | let x = 1
  |     - made
  = help: h
)");
  CHECK(render({"G0900", Severity::error, "no file", {}, "name one"}, scene.sources, false) ==
        "error[G0900]: no file\n  = help: name one\n");
}

TEST_CASE("a very long line is shown as a window") {
  Scene scene("let x = [" + std::string(3000, '1') + " $ " + std::string(3000, '2'));
  Diagnostic d{"G0102", Severity::error, "x", {{scene.find("$"), "here"}}, ""};
  std::string out = render(d, scene.sources, false);
  CHECK(out.size() < 1000);
  std::size_t line = out.find("\n1 | ") + 5, caret = out.find('^');
  CHECK(out[line + (caret - out.rfind('\n', caret) - 5)] == '$');
}

TEST_CASE("colour only when asked") {
  Scene scene("use a\n");
  Diagnostic d{"G0300", Severity::error, "m", {{{0, 4, 5}, "t"}}, "h"};
  CHECK(render(d, scene.sources, false).find('\x1b') == std::string::npos);
  CHECK(render(d, scene.sources, true) ==
        "\x1b[1;31merror[G0300]\x1b[0m\x1b[1m: m\x1b[0m\n"
        " \x1b[1;34m-->\x1b[0m shirt.garment:1:5\n"
        "\x1b[1;34m  |\x1b[0m\n"
        "\x1b[1;34m1 |\x1b[0m use a\n"
        "\x1b[1;34m  |\x1b[0m     \x1b[1;31m^ t\x1b[0m\n"
        "  \x1b[1;34m=\x1b[0m help: h\n");
}

TEST_CASE("diagnostics as JSON") {
  Scene scene("use \"é\" b\n");
  Diagnostic d{"G0300", Severity::warning, "m \"q\"", {{scene.find("b"), "t"}}, "h"};
  CHECK(render_json({d}, scene.sources) == R"([
  {
    "code": "G0300",
    "severity": "warning",
    "message": "m \"q\"",
    "help": "h",
    "labels": [
      {
        "source": "shirt.garment",
        "begin": 9,
        "end": 10,
        "line": 1,
        "column": 9,
        "end_line": 1,
        "end_column": 10,
        "text": "t"
      }
    ]
  }
]
)");
  CHECK(render_json({}, scene.sources) == "[]\n");
}
