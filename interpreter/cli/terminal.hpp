#pragma once
// What the program says: results on standard output, everything about the work on standard error.
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/host.hpp"
#include "runtime/simulator/drape.hpp"

namespace garment::cli {

struct TerminalOptions {
  bool quiet = false;  ///< nothing but errors on standard error
  bool json = false;   ///< diagnostics as JSON on standard output
};

class Terminal {
 public:
  explicit Terminal(TerminalOptions options);

  bool color() const { return color_; }
  const TerminalOptions& options() const { return options_; }

  void result(std::string_view text) const;         ///< standard output
  void note(std::string_view line);                 ///< standard error, one line, unless quiet
  void error(std::string_view text);                ///< standard error, always

  /// With --json a command that has a result of its own keeps the diagnostics (an array) for it, so that standard output
  /// is one document.
  void keep_diagnostics() { keeps_diagnostics_ = true; }
  void diagnostics(std::string json);
  /// With --json: writes `json` (an object, or nothing) with all kept diagnostics as one document.
  void document(const std::string& json);

  /// One line that is renewed on a terminal; a plain line every few seconds elsewhere.
  void progress(const simulator::DrapeProgress& progress, Host& host);
  void end_progress();

 private:
  void show_progress(const std::string& line);
  std::string time_left(const simulator::DrapeProgress& progress, double now);

  TerminalOptions options_;
  bool keeps_diagnostics_ = false;
  std::vector<std::string> kept_diagnostics_;
  bool color_ = false, live_ = false, line_open_ = false;
  double begun_ = -1, last_ = -1e9, first_residual_ = 0;
};

/// Seconds as a person says them: "0.8 s", "12 s", "3 min".
std::string say_seconds(double seconds);
/// 12345 as "12,345".
std::string say_count(std::size_t n);
/// "1 panel", "2 panels".
std::string plural(std::size_t n, const char* word);

}  // namespace garment::cli
