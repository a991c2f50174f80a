#pragma once
// Collects what the pattern reader finds. A broken file can hold the same fault ten thousand times; each code
// is shown a few times and then counted.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/finding.hpp"

namespace garment::io {

class PatternReport {
 public:
  void error(const char* code, std::string message, std::string help = {}) {
    ++errors_;
    add(code, Severity::error, std::move(message), std::move(help));
  }
  void warning(const char* code, std::string message, std::string help = {}) {
    add(code, Severity::warning, std::move(message), std::move(help));
  }
  void note(std::string text);

  int errors() const { return errors_; }
  /// Ends the report: adds the counts of what was held back and gives everything out.
  Findings take_findings();
  std::vector<std::string> take_notes() { return std::move(notes_); }

 private:
  void add(const char* code, Severity severity, std::string message, std::string help);

  struct Held {
    int shown = 0, held = 0;
    Severity severity = Severity::error;
  };
  std::map<std::string, Held> by_code_;
  Findings findings_;
  std::vector<std::string> notes_;
  int errors_ = 0;
};

/// A name from a file as it may stand in a message: in backticks, control characters replaced, long ones cut.
std::string in_ticks(std::string_view name);

}  // namespace garment::io
