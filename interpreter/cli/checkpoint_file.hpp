#pragma once
// The file of a checkpoint, and the two slots that take turns (docs/formats.md, "Checkpoints").
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "grammar/diagnostic.hpp"
#include "interpreter/cli/project.hpp"
#include "runtime/model/model.hpp"

namespace garment::cli {

/// All that a state depends on: what it is, and how it reads ("parameter `long`", "60 cm"). The order is that of telling.
using Identity = std::vector<std::pair<std::string, std::string>>;

/// Of a run: program, script, library, parameters, bodies, model, and those of the program's `options` that the drape depends on.
Identity identity_of(const Project& project, const ProjectOptions& project_options, const model::Model& model, const Identity& options);

/// How `now` differs from what was written, for a message; empty: not at all.
std::string difference(const Identity& written, const Identity& now);

struct CheckpointFile {
  std::uint64_t number = 0;  ///< the newer slot has the larger one
  Identity identity;
  std::string state;
};

std::string checkpoint_bytes(CheckpointFile file);
/// The file of these bytes; else `problem` says what is wrong with them.
struct ReadCheckpoint {
  bool sound = false;
  CheckpointFile file;
  std::string problem;
};
ReadCheckpoint read_checkpoint(std::string_view bytes);

/// The two slots of a folder.
class CheckpointSlots {
 public:
  CheckpointSlots(std::string folder, std::vector<std::string> granted, Host& host);

  /// The newest sound slot; `damaged` says what is wrong with the others (G0910). number 0: there is none.
  struct Found {
    CheckpointFile file;
    std::string name;
    grammar::Diagnostics damaged;
  };
  Found newest();
  /// Writes to the slot that is not the newest. Before the first time, what lies there from other runs goes, unless it was read.
  HostResult<bool> write(Identity identity, std::string state);
  /// Takes both slots away, and what half a write left.
  void remove();

 private:
  std::string path(int slot) const;

  std::string folder_;
  std::vector<std::string> granted_;
  Host& host_;
  std::uint64_t number_ = 0;  // of the newest
  int newest_ = 1;            // slot
  bool read_ = false;
};

}  // namespace garment::cli
