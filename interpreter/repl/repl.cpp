#include "interpreter/repl/repl.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "interpreter/repl/line_editor.hpp"
#include "interpreter/session/session.hpp"
#include "runtime/base/folder.hpp"
#include "runtime/base/interrupt.hpp"
#include "runtime/base/number.hpp"

namespace garment::repl {
namespace {

using session::Answer;
using session::Outcome;

constexpr double kProgressInterval = 0.1;  // s
constexpr const char *kPrompt = "> ", *kMore = ". ";

int exit_code_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::done:
    case Outcome::leave:
      return 0;
    case Outcome::refused:
      return 1;
    case Outcome::failed:
      return 4;
    case Outcome::unmet:
      return 5;
    case Outcome::interrupted:
      return 130;
  }
  return 0;
}

void print(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

/// One line that is renewed while the garment drapes.
class Progress {
 public:
  Progress(Host& host, bool live) : host_(host), live_(live) {}

  void show(const simulator::DrapeProgress& p) {
    if (!live_) return;
    const double now = host_.seconds();
    if (now - last_ < kProgressInterval) return;
    last_ = now;
    print(fmt::format("\r\x1b[K{}: step {}, residual {} of the weight (rest at {}); Ctrl-C stops", p.phase,
                      p.step, format_number(p.residual, 2), format_number(p.target, 2)));
    open_ = true;
  }
  void end() {
    if (open_) print("\r\x1b[K");
    open_ = false;
  }

 private:
  Host& host_;
  bool live_, open_ = false;
  double last_ = -1;
};

/// The next line of input that is no terminal; nothing at its end.
std::optional<std::string> next_line() {
  std::string line;
  for (int c = std::getc(stdin); c != EOF; c = std::getc(stdin)) {
    if (c == '\n') return line;
    line += static_cast<char>(c);
  }
  return line.empty() ? std::nullopt : std::optional(line);
}

session::SessionOptions session_options(const ReplOptions& options, Host& host, bool color,
                                        Progress& progress) {
  session::SessionOptions made;
  made.stdlib_dir = options.stdlib_dir;
  made.out = options.out;
  made.library_dirs = options.library_dirs;
  made.allow_read = options.allow_read;
  made.allow_write = options.allow_write;
  made.color = color;
  made.timing = !options.plain;
  made.max_steps = options.max_steps;
  made.folder_entries = folder_entries;
  made.progress = [&progress](const simulator::DrapeProgress& p) { progress.show(p); };
  made.interrupted = [&host] { return host.interrupted(); };
  return made;
}

/// Entries from a file or a pipe: each is echoed after the prompt, so that the output reads as a session did.
int run_piped(session::Session& session) {
  int code = 0;
  auto enter = [&](const std::string& entry) {
    const Answer answer = session.enter(entry);
    print(answer.text);
    if (code == 0) code = exit_code_of(answer.outcome);
    return answer.outcome != Outcome::leave && answer.outcome != Outcome::interrupted;
  };
  std::string entry;
  while (const std::optional<std::string> line = next_line()) {
    print((entry.empty() ? kPrompt : kMore) + *line + '\n');
    entry += (entry.empty() ? "" : "\n") + *line;
    if (session.wants_more(entry)) continue;
    if (!enter(entry)) return code;
    entry.clear();
  }
  if (!entry.empty()) enter(entry);
  return code;
}

std::vector<Choice> choices_at(const session::Session& session, const std::string& earlier,
                               const std::string& before) {
  std::vector<Choice> choices;
  const std::string text = earlier.empty() ? before : earlier + '\n' + before;
  for (const session::Proposal& proposal : session.complete(text))
    choices.push_back({proposal.text, proposal.detail, proposal.replace});
  return choices;
}

/// A person at a terminal.
class Conversation {
 public:
  Conversation(session::Session& session, Host& host, Progress& progress, bool color)
      : session_(session), progress_(progress), color_(color), editor_(editor_options(host)) {}

  int run() {
    std::string line;
    for (;;) {
      const LineEnd end = editor_.read(prompt(), line);
      if (end == LineEnd::abandoned) {
        entry_.clear();
        continue;
      }
      if (end == LineEnd::end_of_file) {
        print("\n");
        if (!leaves()) continue;
        return 0;
      }
      if (!take(line)) return 0;
    }
  }

 private:
  LineEditorOptions editor_options(Host& host) {
    LineEditorOptions options;
    options.history_file = history_path();
    options.complete = [this](const std::string& before) { return choices_at(session_, entry_, before); };
    options.interrupted = [&host] { return host.interrupted(); };
    options.forget_interrupt = forget_interrupts;
    return options;
  }

  std::string prompt() const { return entry_.empty() ? kPrompt : kMore; }

  /// False to leave.
  bool take(const std::string& line) {
    editor_.remember(line);
    // An empty line ends what was begun and cannot be ended otherwise.
    const bool enough = !entry_.empty() && line.find_first_not_of(" \t") == std::string::npos && blank_;
    blank_ = line.find_first_not_of(" \t") == std::string::npos;
    entry_ += (entry_.empty() ? "" : "\n") + line;
    if (!enough && session_.wants_more(entry_)) return true;
    std::string entry;
    entry.swap(entry_);
    const Answer answer = session_.enter(entry);
    progress_.end();
    forget_interrupts();
    show(answer);
    if (answer.outcome != Outcome::leave) {
      asked_ = false;
      return true;
    }
    return !leaves();
  }

  void show(const Answer& answer) {
    const bool bad = answer.outcome == Outcome::unmet;
    if (color_ && bad) print("\x1b[31m");
    print(answer.text);
    if (color_ && bad) print("\x1b[0m");
  }

  /// Asks once where edits would be lost.
  bool leaves() {
    entry_.clear();
    if (!session_.unsaved() || asked_) return true;
    asked_ = true;
    print("there are edits that were not saved: `:save` keeps them, Ctrl-D or `:quit` once more leaves\n");
    return false;
  }

  session::Session& session_;
  Progress& progress_;
  bool color_, asked_ = false, blank_ = false;
  std::string entry_;
  LineEditor editor_;
};

}  // namespace

int run_repl(const ReplOptions& options, Host& host) {
  const bool person = isatty(STDIN_FILENO) != 0, seen = isatty(STDOUT_FILENO) != 0;
  ReplOptions plain = options;
  plain.plain = options.plain || !person;
  const char* kind = std::getenv("TERM");
  const bool rich = seen && !plain.plain && (kind == nullptr || std::string_view(kind) != "dumb");
  const bool color = rich && std::getenv("NO_COLOR") == nullptr;
  survive_interrupts();
  Progress progress(host, rich);
  session::Session session(host, session_options(plain, host, color, progress));
  int code = 0;
  if (!options.file.empty()) {
    const Answer opened = session.open(options.file);
    print(opened.text);
    if (session.file().empty()) return 3;  // it could not be read
    code = exit_code_of(opened.outcome);
  } else if (person) {
    print("an empty script; `:help` tells what to type, `:load FILE` opens one\n");
  }
  if (!person) {
    const int entered = run_piped(session);
    return code != 0 ? code : entered;
  }
  return Conversation(session, host, progress, color).run();
}

}  // namespace garment::repl
