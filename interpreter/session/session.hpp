#pragma once
// A script that is alive: entries typed at a prompt edit it, ask it, drape it. Knows no terminal.
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/language/ask.hpp"
#include "interpreter/session/drape_answers.hpp"
#include "interpreter/session/entry.hpp"
#include "interpreter/session/script_edit.hpp"
#include "interpreter/session/stage.hpp"

namespace garment::session {

constexpr std::uint64_t kMaxScriptBytes = 4u << 20;

struct SessionOptions {
  std::string stdlib_dir;
  std::string out;        ///< folder that `save` and `:view` write to; empty: named after the script
  std::vector<std::string> library_dirs;              ///< where `use NAME` looks first
  std::vector<std::string> allow_read, allow_write;  ///< further folders below which the script may read and write
  bool color = false;     ///< of diagnostics
  bool timing = true;     ///< say how long things took; off for text that must not change from run to run
  int max_steps = 0;      ///< of a drape; 0: the simulator's own limit
  std::function<std::vector<std::string>(const std::string& folder)>
      folder_entries;  ///< what lies in a folder, see runtime/base/folder.hpp; may be empty: then names of files are not completed
  std::function<void(const simulator::DrapeProgress&)>
      progress;                       ///< called between steps of a drape; may be empty
  std::function<bool()> interrupted;  ///< asked between steps of a drape; may be empty
};

enum class Outcome {
  done,
  refused,      ///< nothing was changed
  unmet,        ///< an `expect` did not hold
  failed,       ///< a drape did not come to rest, or a file could not be written
  interrupted,  ///< a drape was stopped; the shape is kept as far as it came
  leave,        ///< `:quit`
};

/// What a person reads after an entry.
struct Answer {
  Outcome outcome = Outcome::done;
  std::string text;  ///< lines; ends with a newline unless empty
};

/// One way to go on with an entry: `text` in the place of its last `replace` bytes.
struct Proposal {
  std::string text, detail;
  std::size_t replace = 0;
};

struct SessionCommand;
const std::vector<SessionCommand>& session_commands();

/// Each accepted entry that changes the script or its shape is one step of `undo`. A refused entry changes
/// nothing. Never moved.
class Session {
 public:
  Session(Host& host, SessionOptions options);
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Reads a script, builds its model; its acts are not run. What was there is forgotten. A script with
  /// errors is opened too, so that entries can mend it.
  Answer open(const std::string& file);

  /// True where more lines would make the entry whole.
  bool wants_more(const std::string& entry) const;
  /// Runs one entry: statements, an expression, or a `:command`.
  Answer enter(const std::string& entry);

  /// What may stand at the end of `text`, the beginning of an entry.
  std::vector<Proposal> complete(const std::string& text) const;

  /// The text differs from the file it came from.
  bool unsaved() const { return stage_.text != saved_text_; }
  const Stage& stage() const { return stage_; }
  const std::string& file() const { return file_; }
  /// Of the shape, see model::state_hash; "" without a model.
  std::string state_hash() const;

 private:
  friend const std::vector<SessionCommand>& session_commands();

  // session.cpp
  void take(Stage stage);
  Stage restored(Stage stage);
  static void shed(Stage& stage);
  void dress();
  std::string shown(const grammar::Diagnostics& diagnostics, const grammar::Sources& sources,
                    Severity least) const;
  std::string fault(const std::string& code, const std::string& message, const std::string& help) const;
  Answer refuse(const std::string& code, const std::string& message, const std::string& help) const;
  std::string seconds_since(double begin) const;
  std::string out_folder() const;

  // session_entry.cpp
  std::string with_it(const Entry& entry) const;
  Answer change(const Entry& entry);
  Answer commit(Patch patch, const std::string& entry, const std::vector<ScriptEdit>& edits);
  Outcome settle_shape(Stage& next, double begun, std::string& text);
  Answer ask(const Entry& entry);
  std::string describe_edits(const std::vector<ScriptEdit>& edits) const;

  // session_acts.cpp
  Answer act(const Entry& entry);
  Answer run_acts(Evaluated& evaluated, const std::vector<interpreter::Act>& acts);
  Answer perform(Evaluated& evaluated, const interpreter::Act& act);
  std::string told_of_start() const;
  Answer drape_now(simulator::Settle settle);
  Answer release(const std::string& name);
  Answer save_files(const interpreter::SaveAct& act);
  Answer move_now(Evaluated& evaluated, const interpreter::DrapeAct& act, grammar::Span span);
  Outcome drape(Stage& stage, bool from_present, std::string& text);
  Outcome carry_on(const Stage& before, Stage& stage, std::string& text);

  // session_commands.cpp
  Answer command(const std::string& line);
  Answer step(const std::string& argument, bool back);
  Answer undo(int steps);
  Answer redo(int steps);
  Answer diff() const;
  Answer save(std::string file, bool force);
  Answer load(const std::string& file);
  Answer reload();
  Answer remove(const std::string& name);
  void start_again(const std::string& entry);
  Answer run_script();
  Answer reset_shape();
  Answer view(std::string file);
  Answer settings() const;
  Answer set(const std::string& name, const std::string& value);

  // session_info.cpp
  Answer info(const std::string& name);
  Answer list(const std::string& filter) const;
  Answer text(const std::string& name) const;
  Answer where() const;
  Answer model();
  Answer warnings() const;
  Answer help(const std::string& name) const;

  Host& host_;
  SessionOptions options_;
  BodyCache bodies_;
  Workshop workshop_;
  Stage stage_;
  std::deque<Stage> undo_, redo_;
  interpreter::Locals it_;
  std::string it_text_;     ///< expression of an `it` that is no plain value
  std::string acts_entry_;  ///< the entry whose acts are being run
  std::string file_, saved_text_;
  bool warned_of_edits_ = false;
  bool automatic_ = true;  ///< drape again after an edit
};

}  // namespace garment::session
