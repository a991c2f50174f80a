// Scripts that would take all memory or all time: each ends in its coded error within 5 s, in memory of the budget of
// values and a tenth. Each runs in a process of its own, so that its memory can be measured.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>

#include "runtime/base/limits.hpp"
#include "tests/unit/interpreter/support.hpp"

using namespace garment;
using namespace garment::interpreter;
using namespace garment::interpreter::test;

namespace {

struct Outcome {
  std::string code;  ///< of the first error, or "ok"
  double seconds = 0;
  double peak_bytes = 0;
  int signal = 0;
};

Outcome explode(const std::string& script, const std::map<std::string, std::string>& files = {}) {
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  const auto begin = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const Trial trial(script, {}, files);
    std::string code = "ok";
    for (const auto& d : trial.result.diagnostics)
      if (d.severity == Severity::error && code == "ok") code = d.code;
    const ssize_t written = ::write(ends[1], code.data(), code.size());
    ::_exit(written > 0 ? 0 : 1);
  }
  ::close(ends[1]);
  Outcome outcome;
  char buffer[64];
  for (ssize_t n; (n = ::read(ends[0], buffer, sizeof buffer)) > 0;) outcome.code.append(buffer, static_cast<std::size_t>(n));
  ::close(ends[0]);
  int status = 0;
  struct rusage usage {};
  REQUIRE(::wait4(child, &status, 0, &usage) == child);
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  outcome.seconds = std::min(outcome.seconds, static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec + 1));
  outcome.peak_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
  outcome.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return outcome;
}

void ends_in(const std::string& code, const std::string& script, const std::map<std::string, std::string>& files = {}) {
  const Outcome outcome = explode(script, files);
  INFO(script.substr(0, 300));
  CHECK(outcome.signal == 0);
  CHECK(outcome.code == code);
  CHECK(outcome.seconds < 5);
  CHECK(outcome.peak_bytes < 1.1 * static_cast<double>(kMaxValueBytes));
}

std::string repeated(const std::string& text, std::size_t n) {
  std::string out;
  out.reserve(text.size() * n);
  for (std::size_t k = 0; k < n; ++k) out += text;
  return out;
}

/// `let a0 = FIRST` and N times a next one, in which @ stands for the one before.
std::string grown(const std::string& first, const std::string& next, int n) {
  std::string script = "let a0 = " + first + "\n";
  for (int k = 1; k <= n; ++k) {
    std::string line = next;
    for (std::size_t at; (at = line.find('@')) != std::string::npos;) line.replace(at, 1, "a" + std::to_string(k - 1));
    script += "let a" + std::to_string(k) + " = " + line + "\n";
  }
  return script;
}

constexpr std::size_t kMany = 100'000;

}  // namespace

TEST_CASE("values that double are stopped before the memory is taken") {
  ends_in("G1601", grown("steps(1 .. 100)", "@ + @", 60));
  ends_in("G1601", grown("steps(1 .. 1000000)", "@ + @ + @ + @", 3));
  ends_in("G0326", grown("\"aaaaaaaaaa\"", "\"{@}{@}\"", 60));
  ends_in("G1601", "let word = joined(map(steps(1 .. 150000), name), \" \")\nfn name(i) = \"abc\"\n"
                   "let texts = map(steps(1 .. 100000), more)\nfn more(i) = \"{word} {i}\"\n");
  ends_in("ok", grown("[1, 2, 3]", "[@, @]", 150));  // shared, not copied
  ends_in("G1602", grown("[1]", "[@]", 1000));
  ends_in("G1603", "use fabrics\npanel p of fabrics.denim { outline circle((0, 0), 20 cm) free }\n" +
                       grown("p.rim", "@ + @", 40));
  ends_in("G0317", grown("[1, 2, 3]", "[@, @]", 100) + "let b0 = [1, 2, 3]\n" + [] {
    std::string more;
    for (int k = 1; k <= 100; ++k)
      more += "let b" + std::to_string(k) + " = [b" + std::to_string(k - 1) + ", b" + std::to_string(k - 1) + "]\n";
    return more;
  }() + "let same = a100 == b100\n");
}

TEST_CASE("loops and ranges without end") {
  ends_in("G0327", "for i in 1 .. 1000000000 { let a = i }");
  ends_in("G0327", "for i in 1 .. 1000 { for j in 1 .. 1000 { let a = i } }");
  ends_in("G0309", "let a = steps(0 .. 1, 0.000000001)");
  ends_in("G0327", "let many = steps(1 .. 900000)\nfor i in many { let a = i }");
  ends_in("G0317", "let l = steps(1 .. 20000)\nfn f(i) = sum(l)\nlet a = map(l, f)");
  ends_in("G0319", "let a = round(1e300, 1e-300)");
  ends_in("G0319", "let a = 10 ^ 1000000000");
}

TEST_CASE("deep nesting of every kind") {
  ends_in("G0210", "let a = " + repeated("(", kMany) + "1" + repeated(")", kMany));
  ends_in("G0210", "let a = " + repeated("[", kMany) + "1" + repeated("]", kMany));
  ends_in("G0210", "let a = " + repeated("not ", kMany) + "true");
  ends_in("G0210", "let a = " + repeated("-", kMany) + "1");
  ends_in("G0210", "let a = 1" + repeated(" + 1", kMany));
  ends_in("G0210", "let a = 1" + repeated(" ^ 1", kMany));
  ends_in("G0210", "let a = true" + repeated(" and true", kMany));
  ends_in("G0210", "let a = b" + repeated(".b", kMany));
  ends_in("G0210", "let a = b" + repeated("[1]", kMany));
  ends_in("G0210", "let a = f" + repeated("(1)", kMany));
  ends_in("G0210", repeated("if true { ", kMany) + repeated("}", kMany));
  ends_in("G0210", "let a = " + repeated("if true { 1 } else { ", kMany) + "1" + repeated(" }", kMany));
}

TEST_CASE("recursion of functions, definitions and files") {
  ends_in("G0316", "fn f(n) = f(n + 1)\nlet a = f(1)");
  ends_in("G0316", "fn f(n) = map([n], f)\nlet a = f(1)");
  ends_in("G0316", "fn there(n) = back(n)\nfn back(n) = there(n)\nlet a = there(1)");
  std::string backwards;
  for (int k = 0; k < 20000; ++k) backwards += "let a" + std::to_string(k) + " = a" + std::to_string(k + 1) + "\n";
  ends_in("G0316", backwards + "let a20000 = 1\n");
  std::string like = "use fabrics\n";
  for (int k = 0; k < 2000; ++k)
    like += "panel p" + std::to_string(k) + " of fabrics.denim like p" + std::to_string(k + 1) + " { }\n";
  ends_in("G0316", like + "panel p2000 of fabrics.denim { outline circle((0, 0), 20 cm) free }\n");
  std::map<std::string, std::string> files;
  for (int k = 0; k < 40; ++k)
    files["f" + std::to_string(k) + ".garment"] = "use \"f" + std::to_string(k + 1) + ".garment\" as next\n";
  ends_in("G0318", "use \"f0.garment\" as first_file\n", files);
  ends_in("G1230", "use \"self.garment\" as me\n", {{"self.garment", "use \"self.garment\" as me\nlet a = 1\n"}});
}

TEST_CASE("curves with very many points, and many curves") {
  const std::string points =
      "fn at(i) = (i * 0.01 mm, (i - 2 * floor(i / 2)) * 1 mm)\nlet l = map(steps(1 .. 99000), at)\n";
  ends_in("ok", points + "let c = curve((0, 0), (1 m, 0), through: l)\nlet a = length(c)\n");
  ends_in("G0341", points + "let c = curve((0, 0), (1 m, 0), through: l + shift(l, (1 m, 1 cm)))\n");
  ends_in("G0317", points + "let c = curve((0, 0), (1 m, 0), through: l)\nfn f(i) = nearest((0, 1 m), c)\n"
                            "let a = map(l, f)\n");
  ends_in("G0345", points + "let c = curve((0, 0), (1 m, 0), through: l)\nlet a = intersections(c, shift(c, (0, 0.1 mm)))\n");
  ends_in("G1604", "use fabrics\nfor i in 1 .. 5000 {\n  panel p_{i} of fabrics.denim { outline circle((0, 0), 20 cm) free }\n}\n");
}

TEST_CASE("many names and many mistakes") {
  std::string names, wrong;
  for (int k = 0; k < 100000; ++k) {
    names += "let name_" + std::to_string(k) + " = " + std::to_string(k) + "\n";
    wrong += "let wrong_" + std::to_string(k) + " = nam_" + std::to_string(k) + "\n";
  }
  ends_in("ok", names);
  ends_in("G0301", names.substr(0, names.rfind('\n', names.size() / 2) + 1) +
                       wrong.substr(0, wrong.rfind('\n', wrong.size() / 2) + 1));
  std::string list = "let all_names = [";
  for (int k = 99999; k >= 0; --k) list += "name_" + std::to_string(k) + ", ";
  ends_in("ok", names + list + "]\n");
}
