#pragma once
// `garment run`: evaluate, model, drape, judge, write.
#include <string>

#include "interpreter/cli/project.hpp"

namespace garment::cli {

struct RunOptions {
  ProjectOptions project;
  std::string out;         ///< results folder; empty: the script's name in the current folder
  bool pictures = true;
  bool ply = false;
  int max_steps = 0;       ///< 0: the simulator's own limit
};

ExitCode run(const RunOptions& options, Host& host, Terminal& terminal);

}  // namespace garment::cli
