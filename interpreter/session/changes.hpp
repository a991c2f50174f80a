#pragma once
// What an edit changed in the model.
#include <string>
#include <vector>

#include "runtime/model/model.hpp"

namespace garment::session {

struct PanelChanges {
  std::vector<std::string> meshed, kept, gone;  ///< names of panels, in the order of the model
};

/// Panels of `now` whose grid is another than it was, and those whose grid is the same.
PanelChanges compare_panels(const model::Model& before, const model::Model& now);

/// "front, back and 3 more".
std::string listed(const std::vector<std::string>& names, std::size_t most);

}  // namespace garment::session
