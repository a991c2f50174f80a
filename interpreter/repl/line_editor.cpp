#include "interpreter/repl/line_editor.hpp"

#include <histedit.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace garment::repl {
namespace {

constexpr int kHistoryLines = 2000;
constexpr std::size_t kMostListed = 60;  // choices under the line

/// The longest text that all choices begin with.
std::string common_beginning(const std::vector<Choice>& choices) {
  std::string text = choices[0].text;
  for (const Choice& choice : choices) {
    std::size_t same = 0;
    while (same < text.size() && same < choice.text.size() && text[same] == choice.text[same]) ++same;
    text.resize(same);
  }
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80) text.pop_back();
  return text;
}

/// In columns, as a shell lists files; with their details one a line where they are few.
void list_choices(const std::vector<Choice>& choices) {
  std::size_t wide = 0;
  for (const Choice& choice : choices) wide = std::max(wide, choice.text.size());
  const std::size_t shown = std::min(choices.size(), kMostListed);
  const bool one_a_line = shown <= 16;
  const std::size_t columns = one_a_line ? 1 : std::max<std::size_t>(1, 78 / (wide + 2));
  std::fputc('\n', stdout);
  for (std::size_t k = 0; k < shown; ++k) {
    std::fputs(choices[k].text.c_str(), stdout);
    const bool last = (k + 1) % columns == 0 || k + 1 == shown;
    if (!last || (one_a_line && !choices[k].detail.empty()))
      for (std::size_t n = choices[k].text.size(); n < wide + 2; ++n) std::fputc(' ', stdout);
    if (one_a_line) std::fputs(choices[k].detail.c_str(), stdout);
    if (last) std::fputc('\n', stdout);
  }
  if (shown < choices.size()) std::fprintf(stdout, "and %zu more\n", choices.size() - shown);
  std::fflush(stdout);
}

}  // namespace

struct LineEditor::Tool {
  LineEditorOptions options;
  EditLine* edit = nullptr;
  History* history = nullptr;
  std::string prompt, last;
  bool abandoned = false;

  static Tool& of(EditLine* edit) {
    void* data = nullptr;
    el_get(edit, EL_CLIENTDATA, &data);
    return *static_cast<Tool*>(data);
  }

  static char* prompt_of(EditLine* edit) { return of(edit).prompt.data(); }

  /// One character of UTF-8. A Ctrl-C comes as the end of an abandoned line.
  static int read_character(EditLine* edit, wchar_t* out) {
    Tool& tool = of(edit);
    unsigned char byte = 0;
    wchar_t code = 0;
    int more = 0;
    for (;;) {
      const ssize_t n = ::read(STDIN_FILENO, &byte, 1);
      if (n < 0 && errno == EINTR) {
        if (!tool.options.interrupted()) continue;  // the window changed its size
        tool.abandoned = true;
        *out = L'\n';
        return 1;
      }
      if (n <= 0) return static_cast<int>(n);
      if (more > 0 && (byte & 0xC0) == 0x80) {
        code = (code << 6) | (byte & 0x3F);
        if (--more > 0) continue;
      } else if (byte >= 0xC0) {
        more = byte >= 0xF0 ? 3 : byte >= 0xE0 ? 2 : 1;
        code = byte & (0x3F >> more);
        continue;
      } else {
        code = byte;
      }
      *out = code;
      return 1;
    }
  }

  static unsigned char complete_word(EditLine* edit, int) {
    Tool& tool = of(edit);
    const LineInfo* info = el_line(edit);
    const std::string before(info->buffer, info->cursor);
    if (before.find_first_not_of(" \t") == std::string::npos) {
      el_insertstr(edit, "  ");
      return CC_REFRESH;
    }
    const std::vector<Choice> choices = tool.options.complete(before);
    if (choices.empty()) return CC_REFRESH_BEEP;
    const std::string text = common_beginning(choices);
    const std::size_t replace = choices[0].replace;
    const bool one = choices.size() == 1;
    if (text.size() > replace || (one && text != before.substr(before.size() - replace))) {
      std::size_t characters = 0;
      for (std::size_t k = before.size() - replace; k < before.size(); ++k)
        characters += (static_cast<unsigned char>(before[k]) & 0xC0) != 0x80 ? 1 : 0;
      el_deletestr(edit, static_cast<int>(characters));
      el_insertstr(edit, text.c_str());
      return CC_REFRESH;
    }
    if (one) return CC_REFRESH_BEEP;
    list_choices(choices);
    return CC_REDISPLAY;
  }
};

LineEditor::LineEditor(LineEditorOptions options) : tool_(std::make_unique<Tool>()) {
  std::setlocale(LC_CTYPE, "");
  tool_->options = std::move(options);
  tool_->edit = el_init("garment", stdin, stdout, stderr);
  tool_->history = history_init();
  HistEvent event;
  history(tool_->history, &event, H_SETSIZE, kHistoryLines);
  history(tool_->history, &event, H_SETUNIQUE, 1);
  if (!tool_->options.history_file.empty())
    history(tool_->history, &event, H_LOAD, tool_->options.history_file.c_str());
  EditLine* edit = tool_->edit;
  el_set(edit, EL_CLIENTDATA, tool_.get());
  el_set(edit, EL_PROMPT, &Tool::prompt_of);
  el_set(edit, EL_EDITOR, "emacs");
  el_set(edit, EL_HIST, history, tool_->history);
  el_set(edit, EL_GETCFN, &Tool::read_character);
  el_set(edit, EL_ADDFN, "complete-word", "completes the word at the cursor", &Tool::complete_word);
  el_set(edit, EL_BIND, "^I", "complete-word", nullptr);
  el_set(edit, EL_BIND, "^R", "em-inc-search-prev", nullptr);
}

LineEditor::~LineEditor() {
  if (!tool_->options.history_file.empty()) {
    std::error_code ignored;
    std::filesystem::create_directories(std::filesystem::path(tool_->options.history_file).parent_path(),
                                        ignored);
    HistEvent event;
    history(tool_->history, &event, H_SAVE, tool_->options.history_file.c_str());
  }
  history_end(tool_->history);
  el_end(tool_->edit);
}

LineEnd LineEditor::read(const std::string& prompt, std::string& line) {
  tool_->prompt = prompt;
  tool_->abandoned = false;
  int count = 0;
  const char* text = el_gets(tool_->edit, &count);
  if (tool_->abandoned) {
    tool_->options.forget_interrupt();
    std::fputs("^C\n", stdout);
    std::fflush(stdout);
    return LineEnd::abandoned;
  }
  if (text == nullptr || count <= 0) return LineEnd::end_of_file;
  line.assign(text, static_cast<std::size_t>(count));
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.pop_back();
  return LineEnd::line;
}

void LineEditor::remember(const std::string& line) {
  if (line.find_first_not_of(" \t") == std::string::npos || line == tool_->last) return;
  tool_->last = line;
  HistEvent event;
  history(tool_->history, &event, H_ENTER, line.c_str());
}

std::string history_path() {
  const char* state = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  if (state != nullptr && *state == '/') return std::string(state) + "/garment/history";
  if (home != nullptr && *home == '/') return std::string(home) + "/.local/state/garment/history";
  return "";
}

}  // namespace garment::repl
