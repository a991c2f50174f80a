#pragma once
// What a stage found wrong (or worth saying). Stages collect findings and go on; nobody throws them across rooms.
#include <string>
#include <vector>

#include "runtime/base/origin.hpp"

namespace garment {

enum class Severity { error, warning, note };

/// A place that a finding points at, with the text that stands under the caret ("526 mm").
struct FindingLabel {
  OriginId origin;
  std::string text;
};

/// One diagnostic of a runtime stage. `code` is a literal "G0412" from grammar/codes.def (a test holds every literal
/// against that table). `message` says the value found, then what was expected; `help` is the remedy. The first label
/// is the primary place.
struct Finding {
  std::string code;
  Severity severity = Severity::error;
  std::string message;
  std::vector<FindingLabel> labels;
  std::string help;
};

using Findings = std::vector<Finding>;

inline bool has_errors(const Findings& findings) {
  for (const Finding& f : findings)
    if (f.severity == Severity::error) return true;
  return false;
}

}  // namespace garment
