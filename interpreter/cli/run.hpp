#pragma once
// `garment run`: evaluate, model, drape, judge, write.
#include <string>

#include "interpreter/cli/project.hpp"
#include "interpreter/cli/run_checkpoints.hpp"
#include "runtime/io/pdf_writer.hpp"
#include "runtime/results/report.hpp"

namespace garment::cli {

struct RunOptions {
  ProjectOptions project;
  std::string out;         ///< results folder; empty: the script's name in the current folder
  bool pictures = true;
  bool self_collision = true;
  bool ply = false;
  io::PaperSize paper;     ///< of a .pdf
  int max_steps = 0;       ///< 0: the simulator's own limit
  CheckpointOptions checkpoints;
};

ExitCode run(const RunOptions& options, Host& host, Terminal& terminal);

/// The same without the document of `--json`: what it found goes to `report`, which is whole where `reported`.
ExitCode run_script(const RunOptions& options, results::Report& report, bool& reported, Host& host,
                    Terminal& terminal);

}  // namespace garment::cli
