#include "interpreter/language/origins.hpp"

#include <algorithm>

namespace garment::interpreter {
namespace {

/// Shows who brought in the thing that a finding speaks of first.
void show_caller(grammar::Diagnostic& diagnostic, const Caller& caller) {
  const bool shown = std::any_of(diagnostic.labels.begin(), diagnostic.labels.end(),
                                 [&](const grammar::Label& label) { return label.span == caller.label.span; });
  if (!shown) diagnostic.labels.insert(caller.first ? diagnostic.labels.begin() : diagnostic.labels.end(), caller.label);
}

}  // namespace

grammar::Diagnostics to_diagnostics(const Findings& findings, const Origins& origins) {
  grammar::Diagnostics diagnostics;
  for (const Finding& finding : findings) {
    grammar::Diagnostic diagnostic{finding.code, finding.severity, finding.message, {}, finding.help};
    const Caller* caller = nullptr;
    for (const FindingLabel& label : finding.labels) {
      if (label.origin.value == 0 || label.origin.value >= origins.size()) continue;
      if (diagnostic.labels.empty()) caller = origins.caller_of(label.origin.value);
      const grammar::Label shown{origins[label.origin.value], label.text};
      const bool again = std::any_of(diagnostic.labels.begin(), diagnostic.labels.end(), [&](const grammar::Label& other) {
        return other.span == shown.span && other.text == shown.text;  // both halves come of one statement
      });
      if (!again) diagnostic.labels.push_back(shown);
    }
    if (caller != nullptr) show_caller(diagnostic, *caller);
    if (diagnostic.help.empty()) diagnostic.help = grammar::remedy_of(diagnostic.code);
    diagnostics.push_back(std::move(diagnostic));
  }
  return diagnostics;
}

}  // namespace garment::interpreter
