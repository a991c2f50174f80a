#include "interpreter/cli/run_checkpoints.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace garment::cli {
namespace {

constexpr double kLeastShare = 50;  // times that the run works as long as it wrote: a slow disk costs 2 % at most

}  // namespace

RunCheckpoints::RunCheckpoints(const CheckpointOptions& options, std::string folder, std::vector<std::string> granted, Host& host,
                               Terminal& terminal)
    : options_(options),
      granted_(std::move(granted)),
      host_(host),
      terminal_(terminal),
      slots_(std::move(folder), granted_, host),
      last_(host.seconds()),
      pause_(options.seconds) {}

bool RunCheckpoints::begin(Identity identity, std::string& state) {
  identity_ = std::move(identity);
  state.clear();
  if (!options_.resume) return true;
  CheckpointSlots::Found found = slots_.newest();
  show(found.damaged, grammar::Sources{}, terminal_);
  if (found.file.number == 0) {
    if (!options_.of_round) terminal_.note("there is no checkpoint to go on from: it begins at the start");
    return true;
  }
  const std::string differs = difference(found.file.identity, identity_);
  if (!differs.empty()) {
    show({plain_error("G0911", fmt::format("the checkpoint `{}` was made from something else: {} {}", found.name, differs,
                                           differs.find(", ") == std::string::npos ? "differs" : "differ"),
                      "run it with what it was begun with, or from the start, without --resume")},
         grammar::Sources{}, terminal_);
    return false;
  }
  state = std::move(found.file.state);
  any_ = true;
  return true;
}

bool RunCheckpoints::due() {
  if (!options_.write) return false;
  if (options_.steps > 0) return ++asked_ % options_.steps == 0;
  return host_.seconds() - last_ >= pause_;
}

void RunCheckpoints::write(std::string state) {
  if (!options_.write) return;
  const double begun = host_.seconds();
  const HostResult<bool> written = slots_.write(identity_, std::move(state));
  last_ = host_.seconds();
  pause_ = std::max(options_.seconds, kLeastShare * (last_ - begun));
  any_ = any_ || static_cast<bool>(written);
  if (written || told_) return;
  told_ = true;
  grammar::Diagnostic d = plain_error("G0912", fmt::format("no checkpoint can be written: {}", written.error.message),
                                      "make room there, or leave checkpoints out with --no-checkpoint");
  d.severity = Severity::warning;
  show({d}, grammar::Sources{}, terminal_);
}

void RunCheckpoints::finish() {
  slots_.remove();
  for (const std::string& folder : rounds_) remove_checkpoints(folder, granted_, host_);
}

void remove_checkpoints(const std::string& folder, const std::vector<std::string>& granted, Host& host) {
  CheckpointSlots(folder, granted, host).remove();
}

}  // namespace garment::cli
