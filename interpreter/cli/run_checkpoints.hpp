#pragma once
// When a run writes checkpoints, and what it goes on from.
#include <string>
#include <vector>

#include "interpreter/cli/checkpoint_file.hpp"
#include "interpreter/cli/terminal.hpp"

namespace garment::cli {

struct CheckpointOptions {
  bool write = true;
  bool resume = false;
  double seconds = 10;  ///< wall time between two
  int steps = 0;        ///< for tests: one after so many steps instead of by the clock
  bool of_round = false;  ///< of a study
};

class RunCheckpoints {
 public:
  /// Of the run whose results go to `folder`, which is the first of `granted`.
  RunCheckpoints(const CheckpointOptions& options, std::string folder, std::vector<std::string> granted, Host& host, Terminal& terminal);

  /// With --resume: the state to go on from, empty where there is none (told). False: there is one of something else (told,
  /// G0911), and nothing is to be touched.
  bool begin(Identity identity, std::string& state);
  bool writes() const { return options_.write; }
  /// Asked between steps.
  bool due();
  /// A checkpoint that cannot be written is told once (G0912); the run goes on.
  void write(std::string state);
  /// Something was written, so that --resume goes on from there.
  bool any() const { return any_; }
  /// The run has ended: its checkpoints go, and those of its rounds.
  void finish();
  /// A folder of a round of a study, whose checkpoints last as long as the study.
  void add_round(const std::string& folder) { rounds_.push_back(folder); }

 private:
  CheckpointOptions options_;
  std::vector<std::string> granted_, rounds_;
  Host& host_;
  Terminal& terminal_;
  CheckpointSlots slots_;
  Identity identity_;
  double last_, pause_;  // s
  int asked_ = 0;
  bool any_ = false, told_ = false;
};

/// Takes the checkpoints in a folder away.
void remove_checkpoints(const std::string& folder, const std::vector<std::string>& granted, Host& host);

}  // namespace garment::cli
