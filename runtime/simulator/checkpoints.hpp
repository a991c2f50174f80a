#pragma once
// How a drape that is cut off goes on in the same bits (docs/architecture.md, "Checkpoints").
#include <functional>
#include <string>
#include <string_view>

#include "runtime/base/archive.hpp"

namespace garment::simulator {

/// Where a drape writes down how far it has come. What is written is all that the next step takes from the steps before it; when
/// it is written has no effect on any result.
struct Checkpoints {
  std::function<bool()> due;                                ///< asked between steps; empty: never
  std::function<void(const std::string& state)> keep;       ///< empty: nothing is kept
  std::string_view resume;                                  ///< what `keep` was given once; empty: the drape begins

  /// Gives `keep` the state of `thing`, if it is time or where the drape stops `now`.
  template <class Thing>
  void look(Thing& thing, bool now = false) const {
    if (!keep || !(now || (due && due()))) return;
    Archive archive;
    thing.keep(archive);
    keep(archive.take());
  }
  /// Sets `thing` to where it was; false where the bytes are not those of such a drape.
  template <class Thing>
  bool restore(Thing& thing) const {
    Archive archive(resume);
    thing.keep(archive);
    return archive.whole();
  }
};

}  // namespace garment::simulator
