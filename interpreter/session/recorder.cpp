#include "interpreter/session/recorder.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "interpreter/session/drape_answers.hpp"
#include "interpreter/session/result_files.hpp"
#include "runtime/base/number.hpp"
#include "runtime/io/plot_svg.hpp"

namespace garment::session {
namespace {

constexpr double kSameTime = 1e-9;  // of an interval
constexpr int kMostFrames = 10'000, kMostRows = 1'000'000;

std::string labelled(const std::string& text, const std::string& unit) { return unit.empty() ? text : text + " [" + unit + "]"; }

std::string heading(const std::string& text, const std::string& unit) {
  const std::string cell = labelled(text, unit);
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string quoted = "\"";
  for (char c : cell) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

/// fall.obj, 7 -> fall_0007.obj
std::string numbered(const std::string& path, int number) {
  const std::size_t dot = path.rfind('.');
  return fmt::format("{}_{:04}{}", path.substr(0, dot), number, path.substr(dot));
}

}  // namespace

double Recorder::next(double after) const {
  double best = std::numeric_limits<double>::infinity();
  for (const Track& t : tracks_) {
    const double start = t.begun ? t.start : after, n = std::floor((after - start) / t.act.every + kSameTime) + 1;
    best = std::min(best, start + n * t.act.every);
  }
  return best;
}

void Recorder::sample(const model::State& state, const simulator::DrapeReport& report, const std::vector<body::Body>& bodies) {
  for (Track& t : tracks_) {
    if (!t.begun) t.start = state.time;
    const double n = (state.time - t.start) / t.act.every;
    if (t.begun && std::abs(n - std::round(n)) > 1e-6) continue;
    if (t.begun && std::round(n) < t.frames) continue;  // taken at the end of the motion before
    take(t, state, report, bodies);
    t.begun = true;
    ++t.frames;
  }
}

void Recorder::take(Track& track, const model::State& state, const simulator::DrapeReport& report,
                    const std::vector<body::Body>& bodies) {
  if (track.broken || too_many(track)) return;
  if (track.act.frames) return write_frame(track, state, bodies);
  const DrapeAnswers answers(script_.garment, bodies, model_, state, report);
  const interpreter::CurvePoint p = interpreter::evaluate_curve(script_, track.act, answers);
  if (!p.diagnostics.empty()) {
    track.broken = true;
    diagnostics_.insert(diagnostics_.end(), p.diagnostics.begin(), p.diagnostics.end());
    return;
  }
  track.points.push_back({p.x, p.y});
  if (track.rows.empty()) {
    track.x_label = labelled(track.act.x, p.x_unit);
    track.y_label = labelled(track.act.y, p.y_unit);
  }
  if (track.rows.empty())
    track.rows = "time [s]," + heading(track.act.x, p.x_unit) + ',' + heading(track.act.y, p.y_unit) + '\n';
  track.rows += format_number(state.time) + ',' + format_number(p.x) + ',' + format_number(p.y) + '\n';
}

void Recorder::write_frame(Track& track, const model::State& state, const std::vector<body::Body>& bodies) {
  const std::string name = numbered(track.act.path, track.frames);
  const ResultFile file = make_result_file(name, script_.garment, bodies, model_, state);
  if (file.bytes) return write_(name, *file.bytes);
  grammar::Diagnostic d;
  d.code = "G0905";
  d.message = file.message;
  d.help = file.help;
  d.labels.push_back({track.act.statement->span, ""});
  diagnostics_.push_back(std::move(d));
  track.broken = true;
}

/// Scripts of strangers do not fill a disk.
bool Recorder::too_many(Track& track) {
  const int most = track.act.frames ? kMostFrames : kMostRows;
  if (track.frames < most) return false;
  grammar::Diagnostic d;
  d.code = "G1324";
  d.message = fmt::format("a record of more than {} {}", most, track.act.frames ? "frames" : "rows");
  d.help = "record more seldom: `every` a longer time";
  d.labels.push_back({track.act.statement->span, "it ends here"});
  diagnostics_.push_back(std::move(d));
  track.broken = true;
  return true;
}

void Recorder::keep(Archive& a) {
  std::uint64_t n = tracks_.size();
  a.keep(n);
  a.demand(n == tracks_.size());
  for (Track& t : tracks_) {
    for (std::string* text : {&t.rows, &t.x_label, &t.y_label}) a.keep(*text);
    if (a.length(t.points, 2 * sizeof(double)) && !t.points.empty()) a.numbers(t.points.front().data(), 2 * t.points.size());
    a.keep(t.frames);
    a.keep(t.begun);
    a.keep(t.start);
    a.keep(t.broken);
    a.demand(t.frames >= 0 && t.frames <= kMostRows);
  }
}

void Recorder::write_tables() {
  for (const Track& t : tracks_)
    if (!t.act.frames && !t.rows.empty()) {
      write_(t.act.path, t.rows);
      for (const std::string& plot : t.act.plots) write_(plot, io::plot_svg(t.points, t.x_label, t.y_label));
    }
}

const interpreter::CurvePoints* Recorder::curve(const std::string& path) const {
  for (const Track& t : tracks_)
    if (!t.act.frames && t.act.path == path && !t.points.empty()) return &t.points;
  return nullptr;
}

grammar::Diagnostics Recorder::take_diagnostics() {
  grammar::Diagnostics told;
  told.swap(diagnostics_);
  return told;
}

}  // namespace garment::session
