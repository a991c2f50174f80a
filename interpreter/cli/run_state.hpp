#pragma once
// What of a run stands in a checkpoint beside the drape under way.
#include "interpreter/cli/exit_codes.hpp"
#include "runtime/base/archive.hpp"
#include "runtime/model/model.hpp"
#include "runtime/results/report.hpp"

namespace garment::cli {

/// Positions and velocities of `n` particles, and the time.
void keep(Archive& a, model::State& state, std::size_t n);

/// Answers of `expect` and `measure` so far.
void keep_answers(Archive& a, results::Report& report);

/// A round of a study that has ended: what its row in the table says. `state` holds one, and nothing else.
std::string ended_round(ExitCode code, results::Report& report);
bool read_ended_round(const std::string& state, ExitCode& code, results::Report& report);
bool is_ended_round(const std::string& state);

}  // namespace garment::cli
