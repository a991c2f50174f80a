// How fast the prompt answers edits: time_edits SCRIPT ENTRY [ENTRY ...]
// Opens the script, drapes it, and for each entry takes the edit alone (model and shape carried over), drapes on from that
// shape, and drapes the same garment afresh; then undoes all and compares the state's hash. An entry of several lines
// separates them by `;;`. Seconds of the wall; with `--cpu` of the process. `--trace` shows every step.
#include <fmt/format.h>

#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include "interpreter/session/session.hpp"
#include "runtime/base/host.hpp"
#include "runtime/base/parallel.hpp"

using namespace garment;

namespace {

bool of_process = false;

double seconds() {
  return of_process ? static_cast<double>(std::clock()) / CLOCKS_PER_SEC : system_host().seconds();
}

struct Timed {
  session::Answer answer;
  double seconds = 0;
};

Timed timed(session::Session& session, const std::string& entry) {
  const double begun = seconds();
  session::Answer answer = session.enter(entry);
  return {std::move(answer), seconds() - begun};
}

int steps(const session::Session& session) { return session.stage().shape.report.steps; }

bool at_rest(const session::Session& session) {
  return session.stage().shape.report.status == simulator::DrapeStatus::at_rest;
}

std::string lines(std::string entry) {
  for (std::size_t at; (at = entry.find(";;")) != std::string::npos;) entry.replace(at, 2, "\n");
  return entry;
}

void time_entry(session::Session& session, const std::string& entry) {
  const std::string before = session.state_hash();
  const Timed edit = timed(session, lines(entry));
  if (edit.answer.outcome != session::Outcome::done) {
    fmt::print("{:<44} refused\n{}", entry, edit.answer.text);
    return;
  }
  int undo = 1;
  double again = 0;
  int steps_again = 0;
  bool rests = true;
  std::string rest;
  const bool moved = !session.stage().shape.draped;
  if (moved) {
    const Timed restart = timed(session, "drape until rest");
    again = restart.seconds;
    steps_again = steps(session);
    rests = at_rest(session);
    rest = restart.answer.text;
    ++undo;
  }
  session.enter(":reset");
  const Timed fresh = timed(session, "drape until rest");
  undo += 2;
  fmt::print("{:<44} model {:5.2f}  again {:6.2f} ({:4} steps{})  fresh {:6.2f} ({:4} steps{})  ratio {:.2f}", entry,
             edit.seconds, again, steps_again, rests ? "" : ", NO REST", fresh.seconds, steps(session),
             at_rest(session) ? "" : ", NO REST", (edit.seconds + again) / fresh.seconds);
  session.enter(fmt::format(":undo {}", undo));
  fmt::print("{}\n", session.state_hash() == before ? "" : "  STATE NOT RESTORED");
  if (!rests) fmt::print("{}", rest);
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) {
  std::vector<std::string> arguments(words + 1, words + count);
  session::SessionOptions options;
  options.stdlib_dir = GARMENT_STDLIB_DIR;
  while (!arguments.empty() && arguments[0].substr(0, 2) == "--") {
    if (arguments[0] == "--cpu") of_process = true;
    if (arguments[0] == "--one-thread") set_thread_count(1);
    if (arguments[0] == "--trace")
      options.progress = [](const simulator::DrapeProgress& p) {
        fmt::print("  {:6} {:4} {:10} residual {:8.4f} step {:8.3f} mm\n", p.particles, p.step, p.phase, p.residual,
                   1000 * p.largest_step);
      };
    arguments.erase(arguments.begin());
  }
  if (arguments.empty()) {
    fmt::print("time_edits [--cpu] [--one-thread] [--trace] SCRIPT ENTRY [ENTRY ...]\n");
    return 2;
  }
  session::Session session(system_host(), options);
  fmt::print("{}", session.open(arguments[0]).text);
  fmt::print("{}", session.enter("drape until rest").text);
  session.enter(":set auto off");
  for (std::size_t k = 1; k < arguments.size(); ++k) time_entry(session, arguments[k]);
  return 0;
}
