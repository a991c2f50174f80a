// Mutates the examples, the standard library, the scripts of the documents and the goldens that are right by one token
// at a time and looks at the answers: a valid model, or coded errors in place, one for each mistake.
//   mutations SOURCE_DIR [COUNT] [--seed N] [--list] [--far] [--only FILE]
// --list prints each mutant that gives more than one error, --far each whose only error stands in another line than the
// mutation. Exit code 1 when an answer is not as it must be.
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

constexpr int kMaxSeconds = 30;  // of the processor, for one mutant: a cap of 52 m makes a million particles

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
  std::uint32_t line = 0;  ///< of the first error, where it stands in the script
  bool modelled = false;
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
      answer.modelled = findings.empty();
      if (findings.empty()) findings = modeller::build_model(result.garment, result.bodies).findings;
      for (grammar::Diagnostic& d : interpreter::to_diagnostics(findings, result.origins))
        answer.diagnostics.push_back(std::move(d));
    }
    for (const grammar::Diagnostic& d : answer.diagnostics) {
      if (d.severity != Severity::error) continue;
      ++answer.errors;
      if (answer.errors == 1 && !d.labels.empty() && d.labels[0].span.source == id)
        answer.line = sources.place(id, d.labels[0].span.begin).line;
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
  std::string name, text, folder;
  std::string library;  ///< path of the library that `text` replaces; empty: `text` is the script itself
  std::string script;   ///< that uses the library
  std::vector<Token> tokens;
};

std::vector<fs::path> files_below(const fs::path& folder, const char* extension = ".garment") {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == extension) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string text_of(const fs::path& path) { return *system_host().read_file(path.string(), 4 << 20).value; }

class Subjects {
 public:
  Subjects(const std::string& root, const std::string& only) : root_(root), only_(only) {
    for (const fs::path& path : files_below(root_ / "examples")) add(path.filename().string(), text_of(path), "examples");
    for (const fs::path& path : files_below(root_ / "stdlib")) add_library(path);
    for (const fs::path& path : files_below(root_ / "docs", ".md")) add_document(path);
    long_ = found_.size();
    for (const fs::path& path : files_below(root_ / "tests/golden/check")) {
      const std::string text = text_of(path);
      if (text.starts_with("#! ok")) add(path.lexically_relative(root_ / "tests/golden").string(), text, path.parent_path());
    }
  }

  std::size_t size() const { return found_.size(); }
  /// Three of four mutants are of whole garments; the goldens are many and short.
  const Subject& of(std::size_t k) const {
    const std::size_t n_short = found_.size() - long_;
    if (long_ == 0 || (k % 4 == 3 && n_short > 0)) return found_[long_ + k / 4 % n_short];
    return found_[(k - k / 4) % long_];
  }

 private:
  void add(const std::string& name, const std::string& text, const fs::path& folder, const std::string& library = "",
           const std::string& script = "") {
    if (!only_.empty() && name.find(only_) == std::string::npos) return;
    found_.push_back({name, text, (root_ / folder).string(), library, script, tokens_of(text)});
  }

  /// With the first example that uses it.
  void add_library(const fs::path& path) {
    const std::string name = path.stem().string();
    for (const fs::path& example : files_below(root_ / "examples")) {
      const std::string text = text_of(example);
      if (text.find(name + '.') == std::string::npos) continue;
      return add(path.filename().string(), text_of(path), "examples", path.lexically_normal().string(), text);
    }
  }

  /// Its scripts that are whole: those that begin with a `garment` line.
  void add_document(const fs::path& path) {
    const std::string text = text_of(path);
    constexpr std::string_view kBegin = "```garment\n", kEnd = "```";
    int n = 0;
    for (std::size_t at = text.find(kBegin); at != std::string::npos; at = text.find(kBegin, at)) {
      at += kBegin.size();
      const std::string script = text.substr(at, text.find(kEnd, at) - at);
      if (script.starts_with("garment ")) add(path.filename().string() + ' ' + std::to_string(++n), script, "docs");
    }
  }

  fs::path root_;
  std::string only_;
  std::vector<Subject> found_;
  std::size_t long_ = 0;  ///< the first so many are no goldens
};

std::uint32_t line_of(const std::string& text, std::size_t at) {
  return 1 + static_cast<std::uint32_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

}  // namespace

int main(int argc, char** argv) {
  std::string root, only;
  std::size_t count = 400, seed = 1;
  bool list = false, list_far = false;
  for (int k = 1; k < argc; ++k) {
    const std::string argument = argv[k];
    if (argument == "--list")
      list = true;
    else if (argument == "--far")
      list_far = true;
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
  const Subjects all(root, only);
  const std::vector<std::string> words = words_of_the_language();
  std::size_t bad = 0, several = 0, valid = 0, modelled = 0, far = 0;
  std::map<std::string, int> pairs;
  for (std::size_t k = 0; k < count; ++k) {
    const Subject& subject = all.of(k);
    Dice dice(seed * 1000003 + k);
    const Mutant mutant = mutate(subject.text, subject.tokens, words, dice);
    current = fmt::format("{} {}: {}\n", subject.name, k, mutant.what);
    const bool in_library = !subject.library.empty();
    runner.host.replaced_path = subject.library;
    runner.host.replaced_text = mutant.text;
    limit_time(kMaxSeconds);
    const Answer answer = runner.run(in_library ? subject.script : mutant.text, subject.folder);
    limit_time(0);
    const std::string wrong = judge(answer);
    if (!wrong.empty()) {
      ++bad;
      fmt::print("BAD ({}) {}{}\n", wrong, current, answer.text);
    }
    if (answer.errors == 0) ++valid;
    if (answer.modelled) ++modelled;
    if (answer.errors == 1 && !in_library && answer.line != line_of(mutant.text, mutant.at)) {
      ++far;
      if (list_far) fmt::print("FAR (line {}) {}{}\n", line_of(mutant.text, mutant.at), current, answer.text);
    }
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
  fmt::print("{} mutants of {} scripts: {} valid ({} modelled), {} with one error ({} in another line), {} with more, {} with a bad answer\n",
             count, all.size(), valid, modelled, count - valid - several, far, several, bad);
  return bad == 0 ? 0 : 1;
}
