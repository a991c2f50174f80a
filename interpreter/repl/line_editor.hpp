#pragma once
// A line of text from a person at a terminal: editing, history, completion.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace garment::repl {

/// One way to go on at the cursor: `text` in the place of the last `replace` bytes before it.
struct Choice {
  std::string text;
  std::string detail;  ///< shown beside it in the list; may be empty
  std::size_t replace = 0;
};

struct LineEditorOptions {
  std::string history_file;  ///< empty: the history ends with the program
  /// What may stand at the cursor, given the line up to it.
  std::function<std::vector<Choice>(const std::string&)> complete;
  std::function<bool()> interrupted;  ///< Ctrl-C was pressed
  std::function<void()> forget_interrupt;
};

enum class LineEnd {
  line,         ///< a line was typed
  abandoned,    ///< Ctrl-C
  end_of_file,  ///< Ctrl-D on an empty line
};

/// Keys as in a shell (emacs mode of libedit): arrows and Ctrl-P Ctrl-N walk the history, Ctrl-R searches it,
/// Tab completes. Only one may live at a time, on a terminal.
class LineEditor {
 public:
  explicit LineEditor(LineEditorOptions options);
  ~LineEditor();
  LineEditor(const LineEditor&) = delete;
  LineEditor& operator=(const LineEditor&) = delete;

  /// Reads one line, without its end, into `line`.
  LineEnd read(const std::string& prompt, std::string& line);
  /// Takes a line into the history, unless it is blank or the same as the last.
  void remember(const std::string& line);

 private:
  struct Tool;
  std::unique_ptr<Tool> tool_;
};

/// Where the history is kept: below XDG_STATE_HOME, else ~/.local/state; empty where neither is known.
std::string history_path();

}  // namespace garment::repl
