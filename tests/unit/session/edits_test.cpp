// Entries that edit the script: where they are written, and what else stays.
#include "interpreter/session/line_diff.hpp"
#include "tests/unit/session/support.hpp"

using namespace garment;
using namespace garment::session;
using namespace garment::session::test;

namespace {

/// The lines that an entry changes: "-old\n+new\n".
std::string changes(const std::string& entry, Outcome outcome = Outcome::done) {
  Prompt prompt;
  prompt.enter(entry, outcome);
  const std::string diff = unified_diff(kSquare, prompt.text(), "a", "b");
  std::string lines;
  for (std::size_t at = 0; at < diff.size();) {
    const std::size_t end = diff.find('\n', at);
    const std::string line = diff.substr(at, end - at);
    if ((line[0] == '-' || line[0] == '+') && line.substr(0, 3) != "---" && line.substr(0, 3) != "+++")
      lines += line + '\n';
    at = end + 1;
  }
  return lines;
}

}  // namespace

TEST_CASE("an assignment is written where the value stands") {
  CHECK(changes("wide = 12 cm") ==
        "-param wide = 10 cm in 2 cm .. 50 cm  \"side of the square\"\n"
        "+param wide = 12 cm in 2 cm .. 50 cm  \"side of the square\"\n");
  CHECK(changes("tall = wide + 1 cm") == "-let tall = 10 cm\n+let tall = wide + 1 cm\n");
  CHECK(changes("thin.friction = 0.4") ==
        "-fabric thin = fabrics.satin with { friction = 0.2 }  # of the shop\n"
        "+fabric thin = fabrics.satin with { friction = 0.4 }  # of the shop\n");
  CHECK(changes("cloth.resolution = 25 mm") == "-  resolution 2 cm\n+  resolution 25 mm\n");
  CHECK(changes("cloth.mark.at = 30 mm") ==
        "-  notch mark on top at 20 mm   # here\n+  notch mark on top at 30 mm   # here\n");
}

TEST_CASE("an assignment that has no place yet is added before the acts") {
  CHECK(changes("thin.T = 0.3 mm") == "+thin.T = 0.3 mm\n+\n");
  Prompt prompt;
  prompt.enter("thin.T = 0.3 mm");
  CHECK(prompt.text().find("thin.T") < prompt.text().find("drape until"));
  CHECK(prompt.text().find("thin.T") > prompt.text().find("pin two"));
  prompt.enter("thin.T = 0.4 mm");  // now it has one
  CHECK(has(prompt.text(), "thin.T = 0.4 mm\n"));
  CHECK_FALSE(has(prompt.text(), "0.3 mm"));
}

TEST_CASE("a declaration takes the place of that of its name, else it is added") {
  CHECK(changes("let tall = 11 cm") == "-let tall = 10 cm\n+let tall = 11 cm\n");
  CHECK(changes("place cloth at (0, 2 m, 0)") ==
        "-place cloth at (0, 1 m, 0)\n+place cloth at (0, 2 m, 0)\n");
  CHECK(changes("let half = wide / 2") == "+let half = wide / 2\n+\n");
  CHECK(changes("gravity (0, -1.6 m/s^2, 0)") == "+gravity (0, -1.6 m/s^2, 0)\n+\n");
}

TEST_CASE("several statements in one entry are one step") {
  Prompt prompt;
  prompt.enter("let a = 1 cm\nlet b = a + 1 cm");
  CHECK(has(prompt.text(), "let a = 1 cm\nlet b = a + 1 cm\n"));
  prompt.enter(":undo");
  CHECK(prompt.text() == kSquare);
}

TEST_CASE("a declaration is removed with its comment and what is assigned to it") {
  Prompt prompt("## Twice.\nlet a = 1 cm\n\nlet b = 2 cm\n");
  prompt.enter(":remove a");
  CHECK(prompt.text() == "let b = 2 cm\n");
  CHECK(has(prompt.enter(":remove c", Outcome::refused), "error[G0301]"));
  Prompt needed;
  needed.enter(":remove tall", Outcome::refused);
  CHECK(needed.text() == kSquare);
}

TEST_CASE("the value of `it` is written, not the word") {
  Prompt prompt;
  prompt.enter("2 * 6 cm");
  prompt.enter("tall = it");
  CHECK(has(prompt.text(), "let tall = 12 cm\n"));
  prompt.enter("cloth.top");
  prompt.enter("measure width = length(it)");
  CHECK(has(prompt.text(), "measure width = length(cloth.top)\n"));
}

TEST_CASE("a refused entry changes nothing and is shown as it was typed") {
  Prompt prompt;
  CHECK(has(prompt.enter("  wide = 3 kg", Outcome::refused), "<prompt>:1:10"));
  CHECK(has(prompt.enter("wide = 70 cm", Outcome::refused), "error[G0310]"));
  CHECK(has(prompt.enter("lng = 3 cm", Outcome::refused), "named `lng`"));
  CHECK(has(prompt.enter("let tall = 3 +", Outcome::refused), "error[G0"));
  CHECK(has(prompt.enter("cloth.wide = 3 cm", Outcome::refused), "error[G0311]"));
  CHECK(prompt.text() == kSquare);
  CHECK_FALSE(prompt.session.unsaved());
  CHECK(has(prompt.enter(":undo", Outcome::refused), "error[G1505]"));
}

TEST_CASE("declarations and acts are not mixed") {
  Prompt prompt;
  CHECK(has(prompt.enter("tall = 9 cm; drape until rest", Outcome::refused), "error[G1503]"));
  CHECK(has(prompt.enter("drape until rest; tall = 9 cm", Outcome::refused), "error[G1503]"));
  CHECK(prompt.text() == kSquare);
}

TEST_CASE("a script with errors is mended step by step") {
  Prompt prompt("let a = b + 1 cm\nlet c = d\n");
  CHECK(prompt.last.outcome == Outcome::refused);
  CHECK(has(prompt.enter("let b = 2 cm"), "the script has 1 more error"));
  prompt.enter("let e = f", Outcome::refused);
  prompt.enter("let d = 3 cm");
  CHECK(has(prompt.enter("c"), "3 cm"));
}

TEST_CASE("what is typed in pieces waits for the rest") {
  Prompt prompt("");
  CHECK(prompt.session.wants_more("panel a of thin {"));
  CHECK(prompt.session.wants_more("let a ="));
  CHECK(prompt.session.wants_more("(1 +"));
  CHECK_FALSE(prompt.session.wants_more("let a = 1"));
  CHECK_FALSE(prompt.session.wants_more(")"));
  CHECK_FALSE(prompt.session.wants_more(""));
  CHECK_FALSE(prompt.session.wants_more(":help"));
}

TEST_CASE("differences of texts as diff -u says them") {
  CHECK(unified_diff("a\nb\n", "a\nb\n", "x", "y").empty());
  CHECK(unified_diff("a\nb\nc\n", "a\nB\nc\n", "x", "y") ==
        "--- x\n+++ y\n@@ -1,3 +1,3 @@\n a\n-b\n+B\n c\n");
  CHECK(unified_diff("", "a\n", "x", "y") == "--- x\n+++ y\n@@ -0,0 +1 @@\n+a\n");
  CHECK(unified_diff("a", "a\n", "x", "y") ==
        "--- x\n+++ y\n@@ -1 +1 @@\n-a\n\\ No newline at end of file\n+a\n");
  std::string many, edited;
  for (int k = 0; k < 30; ++k) {
    many += std::to_string(k) + '\n';
    edited += std::to_string(k == 5 || k == 25 ? 100 : k) + '\n';
  }
  const std::string diff = unified_diff(many, edited, "x", "y");
  CHECK(has(diff, "@@ -3,7 +3,7 @@"));
  CHECK(has(diff, "@@ -23,7 +23,7 @@"));
}
