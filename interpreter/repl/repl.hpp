#pragma once
// `garment repl [FILE]`: the prompt.
#include <string>
#include <vector>

#include "runtime/base/host.hpp"

namespace garment::repl {

struct ReplOptions {
  std::string file;  ///< empty: begins with an empty script
  std::string stdlib_dir;
  std::string out;  ///< folder that `save` and `:view` write to
  std::vector<std::string> library_dirs;              ///< where `use NAME` looks first
  std::vector<std::string> allow_read, allow_write;  ///< further folders for the script
  bool plain = false;  ///< text that does not change from run to run: no times, no colours, no progress
  int max_steps = 0;
};

/// Returns the exit code: 0; 1 where entries were refused, 4 where a drape failed, 5 where an `expect` did
/// not hold (the first of these that happened, and only where the input is no terminal); 130 after Ctrl-C in
/// a drape of such input.
int run_repl(const ReplOptions& options, Host& host);

}  // namespace garment::repl
