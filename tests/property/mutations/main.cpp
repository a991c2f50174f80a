// Mutates the examples and the standard library by one token at a time and looks at the answers: a valid
// model, or coded errors in place, one for each mistake.
//   mutations SOURCE_DIR [COUNT] [--seed N] [--list] [--only FILE]
// --list prints each mutant that gives more than one error. Exit code 1 when an answer is not as it must be.
#include <fmt/format.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "grammar/diagnostic.hpp"
#include "interpreter/language/construct_table.hpp"
#include "interpreter/language/function_table.hpp"
#include "interpreter/language/interpret.hpp"
#include "runtime/modeller/modeller.hpp"
#include "runtime/modeller/unmodelled.hpp"
#include "tests/property/mutations/mutate.hpp"

namespace {

using namespace garment;
using namespace garment::mutations;
namespace fs = std::filesystem;

constexpr int kMaxSeconds = 5;  // of the processor, for one mutant

std::string current;  // the mutant at work, for the handler

void tell_and_die(int signal) {
  const char* what = signal == SIGPROF ? "HANGS: " : "CRASHES: ";
  (void)!write(2, what, std::strlen(what));
  (void)!write(2, current.data(), current.size());
  _exit(1);
}

void limit_time(int seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = seconds;
  setitimer(ITIMER_PROF, &timer, nullptr);
}

/// Files from disk, each read once; one of them may be replaced by its mutant.
class CachingHost : public Host {
 public:
  std::string replaced_path, replaced_text;
  HostResult<std::string> read_file(const std::string& path, std::uint64_t max_bytes) override {
    const std::string key = fs::path(path).lexically_normal().string();
    if (key == replaced_path) return {replaced_text, {}};
    if (auto found = files_.find(key); found != files_.end()) return {found->second, {}};
    HostResult<std::string> text = system_host().read_file(path, max_bytes);
    if (text) files_[key] = *text.value;
    return text;
  }
  HostResult<bool> write_file(const std::string&, std::string_view) override {
    return {std::nullopt, {"read only"}};
  }
  double seconds() override { return 0; }
  bool interrupted() override { return false; }
  std::uint64_t peak_memory() override { return 0; }

 private:
  std::map<std::string, std::string> files_;
};

/// Bodies are built once for each set of measures: most mutants leave the person as she is.
class BodyCache {
 public:
  body::BodyResult build(const design::Body& declared, Host& host, const std::string& folder) {
    const auto* person = std::get_if<design::Mannequin>(&declared.shape);
    if (person == nullptr) return body::build_body(declared, host, folder);
    std::string key = fmt::format("{} {} {} {}", declared.name, declared.friction,
                                  static_cast<int>(person->sex), declared.position.transpose().norm());
    for (const auto& [name, value] : person->measures) key += fmt::format(" {} {}", name, value);
    auto found = built_.find(key);
    if (found == built_.end()) found = built_.emplace(key, body::build_body(declared, host, folder)).first;
    body::BodyResult result = found->second;
    for (Finding& finding : result.findings)
      for (FindingLabel& label : finding.labels) label.origin = declared.origin;
    return result;
  }

 private:
  std::map<std::string, body::BodyResult> built_;
};

struct Answer {
  grammar::Diagnostics diagnostics;
  std::string text;
  int errors = 0;
};

struct Runner {
  CachingHost host;
  BodyCache bodies;
  std::string stdlib;

  Answer run(const std::string& script, const std::string& folder) {
    grammar::Sources sources;
    const grammar::SourceId id = sources.add("mutant.garment", script);
    interpreter::InterpretOptions options;
    options.stdlib_dir = stdlib;
    options.script_dir = folder;
    options.build_body = [this](const design::Body& b, Host& h, const std::string& f) {
      return bodies.build(b, h, f);
    };
    interpreter::Interpretation result = interpreter::interpret(sources, id, host, options);
    Answer answer{result.diagnostics, "", 0};
    if (result.ok()) {
      Findings findings = modeller::find_unmodelled(result.garment, Severity::warning);
      if (findings.empty()) findings = modeller::build_model(result.garment, result.bodies).findings;
      for (grammar::Diagnostic& d : interpreter::to_diagnostics(findings, result.origins))
        answer.diagnostics.push_back(std::move(d));
    }
    for (const grammar::Diagnostic& d : answer.diagnostics) {
      if (d.severity != Severity::error) continue;
      ++answer.errors;
      answer.text += grammar::render(d, sources, false);
    }
    return answer;
  }
};

/// What is wrong with an answer whatever the mutant says; empty if nothing is.
std::string judge(const Answer& answer) {
  for (const grammar::Diagnostic& d : answer.diagnostics) {
    if (grammar::find_code(d.code) == nullptr) return "a code that the table does not know";
    if (d.message.empty()) return "an empty message";
    if (d.code == "G0490") return "an internal error";
    if (d.severity == Severity::error && d.labels.empty() && d.code != "G0452")
      return "an error without a place";
    for (const char* leak : {"nan", "std::", "exception", "inf "})
      if ((' ' + d.message + ' ').find(std::string(" ") + leak) != std::string::npos)
        return "a leak of the inside";
  }
  return "";
}

std::vector<std::string> words_of_the_language() {
  std::vector<std::string> words{"and", "or", "not", "minus", "for", "if", "both",
                                 "..",  "=",  ":",   "(",     ")",   "{",  "}"};
  for (const interpreter::ConstructRecord& record : interpreter::construct_table()) {
    words.emplace_back(record.keyword);
    for (const interpreter::ClauseRecord& clause : record.clauses) words.emplace_back(clause.word);
  }
  for (const interpreter::FunctionRecord& record : interpreter::function_table())
    words.emplace_back(record.name);
  return words;
}

struct Subject {
  std::string name, text, path;
  bool library = false;
  std::vector<Token> tokens;
};

std::vector<Subject> subjects(const std::string& root, const std::string& only) {
  std::vector<Subject> found;
  for (const char* folder : {"examples", "stdlib"}) {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(fs::path(root) / folder))
      if (entry.path().extension() == ".garment") paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    for (const fs::path& path : paths) {
      if (!only.empty() && path.string().find(only) == std::string::npos) continue;
      Subject subject{path.filename().string(),
                      *system_host().read_file(path.string(), 4 << 20).value,
                      path.lexically_normal().string(),
                      std::string_view(folder) == "stdlib",
                      {}};
      subject.tokens = tokens_of(subject.text);
      found.push_back(std::move(subject));
    }
  }
  return found;
}

}  // namespace

int main(int argc, char** argv) {
  std::string root, only;
  std::size_t count = 400, seed = 1;
  bool list = false;
  for (int k = 1; k < argc; ++k) {
    const std::string argument = argv[k];
    if (argument == "--list")
      list = true;
    else if (argument == "--seed" && k + 1 < argc)
      seed = std::stoul(argv[++k]);
    else if (argument == "--only" && k + 1 < argc)
      only = argv[++k];
    else if (root.empty())
      root = argument;
    else
      count = std::stoul(argument);
  }
  for (int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGPROF}) std::signal(signal, tell_and_die);
  Runner runner;
  runner.stdlib = (fs::path(root) / "stdlib").string();
  const std::vector<Subject> all = subjects(root, only);
  const std::vector<std::string> words = words_of_the_language();
  const std::string skirt =
      *system_host().read_file((fs::path(root) / "examples/skirt.garment").string(), 1 << 20).value;
  std::size_t bad = 0, several = 0, valid = 0;
  std::map<std::string, int> pairs;
  for (std::size_t k = 0; k < count; ++k) {
    const Subject& subject = all[k % all.size()];
    Dice dice(seed * 1000003 + k);
    const Mutant mutant = mutate(subject.text, subject.tokens, words, dice);
    current = fmt::format("{} {}: {}\n", subject.name, k, mutant.what);
    runner.host.replaced_path = subject.library ? subject.path : "";
    runner.host.replaced_text = mutant.text;
    limit_time(kMaxSeconds);
    const Answer answer =
        runner.run(subject.library ? skirt : mutant.text, fs::path(subject.path).parent_path().string());
    limit_time(0);
    const std::string wrong = judge(answer);
    if (!wrong.empty()) {
      ++bad;
      fmt::print("BAD ({}) {}{}\n", wrong, current, answer.text);
    }
    if (answer.errors == 0) ++valid;
    if (answer.errors > 1) {
      ++several;
      std::string codes;
      for (const grammar::Diagnostic& d : answer.diagnostics)
        if (d.severity == Severity::error && codes.find(d.code) == std::string::npos) codes += d.code + ' ';
      ++pairs[codes];
      if (list) fmt::print("SEVERAL {}{}\n", current, answer.text);
    }
  }
  for (const auto& [codes, n] : pairs) fmt::print("{:5} x {}\n", n, codes);
  fmt::print("{} mutants: {} valid, {} with one error, {} with more, {} with a bad answer\n", count, valid,
             count - valid - several, several, bad);
  return bad == 0 ? 0 : 1;
}
