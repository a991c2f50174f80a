#include "interpreter/cli/terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "grammar/text.hpp"
#include "runtime/base/number.hpp"

namespace garment::cli {
namespace {

constexpr double kLiveInterval = 0.1, kPlainInterval = 5;  // s between two progress lines

}  // namespace

Terminal::Terminal(TerminalOptions options) : options_(options) {
  bool terminal = isatty(STDERR_FILENO) != 0;
  const char* kind = std::getenv("TERM");
  live_ = terminal && (!kind || std::string_view(kind) != "dumb");
  color_ = live_ && std::getenv("NO_COLOR") == nullptr;
}

void Terminal::result(std::string_view text) const {
  std::fwrite(text.data(), 1, text.size(), stdout);
  if (!text.empty() && text.back() != '\n') std::fputc('\n', stdout);
}

void Terminal::diagnostics(std::string json) {
  if (keeps_diagnostics_)
    kept_diagnostics_.push_back(std::move(json));
  else
    result(json);
}

void Terminal::document(const std::string& json) {
  using nlohmann::ordered_json;
  ordered_json all = json.empty() ? ordered_json::object() : ordered_json::parse(json);
  all["diagnostics"] = ordered_json::array();
  for (const std::string& kept : kept_diagnostics_)
    for (ordered_json& d : ordered_json::parse(kept)) all["diagnostics"].push_back(std::move(d));
  result(all.dump(2, ' ', false, ordered_json::error_handler_t::replace));
}

void Terminal::note(std::string_view line) {
  if (options_.quiet) return;
  end_progress();
  fmt::print(stderr, "{}\n", grammar::escape_controls(line));
}

void Terminal::error(std::string_view text) {
  end_progress();
  fmt::print(stderr, "{}{}", text, !text.empty() && text.back() == '\n' ? "" : "\n");
}

std::string Terminal::time_left(const simulator::DrapeProgress& p, double now) {
  // The residual falls about exponentially: what is left follows from what has been done.
  if (begun_ < 0) begun_ = now, first_residual_ = p.residual;
  if (p.residual > first_residual_) first_residual_ = p.residual;
  double done = std::log(first_residual_ / p.residual), open = std::log(p.residual / p.target);
  if (!(done > 0.2) || !(open > 0) || now - begun_ < 1) return "";
  return ", about " + say_seconds((now - begun_) * open / done) + " left";
}

void Terminal::progress(const simulator::DrapeProgress& p, Host& host) {
  if (options_.quiet) return;
  double now = host.seconds();
  std::string left = p.duration > 0 ? "" : time_left(p, now);
  if (now - last_ < (live_ ? kLiveInterval : kPlainInterval)) return;
  last_ = now;
  if (p.duration > 0) {
    show_progress(fmt::format("{}: {} of {} s, step {}, {} particles", p.phase, format_number(p.time, 4),
                              format_number(p.duration, 4), p.step, say_count(p.particles)));
    return;
  }
  std::string line = fmt::format("{}: step {}, {} particles, residual {} of the weight (rest at {}){}", p.phase, p.step,
                                 say_count(p.particles), format_number(p.residual, 2), format_number(p.target, 2), left);
  show_progress(line);
}

void Terminal::show_progress(const std::string& line) {
  if (live_)
    fmt::print(stderr, "\r\x1b[K{}", line), std::fflush(stderr), line_open_ = true;
  else
    fmt::print(stderr, "{}\n", line);
}

void Terminal::end_progress() {
  if (line_open_) fmt::print(stderr, "\r\x1b[K");
  line_open_ = false;
}

std::string say_seconds(double seconds) {
  if (seconds < 10) return format_number(std::round(seconds * 10) / 10) + " s";
  if (seconds < 120) return format_number(std::round(seconds)) + " s";
  return format_number(std::round(seconds / 60)) + " min";
}

std::string say_count(std::size_t n) {
  std::string digits = std::to_string(n);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, ",");
  return digits;
}

std::string plural(std::size_t n, const char* word) { return fmt::format("{} {}{}", n, word, n == 1 ? "" : "s"); }

}  // namespace garment::cli
