#include "interpreter/cli/run_summary.hpp"

#include <fmt/format.h>

#include "runtime/base/number.hpp"

namespace garment::cli {
namespace {

void summarise_motion(const simulator::DrapeReport& drape, double taken, Terminal& terminal) {
  const simulator::MotionReport& m = drape.motion;
  auto joule = [](double x) { return format_number(x, 3) + " J"; };
  const std::string steps = m.steps == 0 ? fmt::format("{} steps, at rest at every moment", drape.steps)
                                         : fmt::format("{} steps of {} to {} ms", m.steps, format_number(1000 * m.least_step, 3),
                                                       format_number(1000 * m.largest_step, 3));
  terminal.note(fmt::format("{}: {} s in {}, {}, {} intersections", results::status_name(drape.status), format_number(m.seconds, 4),
                            steps, say_seconds(taken), drape.self_intersections + drape.body_intersections + drape.inside_body));
  if (m.stable_step > 0) terminal.note(fmt::format("       explicit steps are stable up to {} ms", format_number(1000 * m.stable_step, 3)));
  if (m.steps > 0)
    terminal.note(fmt::format("       energy: kinetic {}, stored {}; work {}, damping {}, friction {}, lost to the steps {}",
                              joule(m.balance.kinetic), joule(m.balance.stored), joule(m.balance.work), joule(m.balance.damping),
                              joule(m.balance.friction), joule(m.balance.numerical)));
}

}  // namespace

void summarise(const results::Report& report, const std::string& folder, bool draped, Terminal& terminal) {
  double drape_seconds = 0;
  for (const results::PhaseTime& p : report.phases)
    if (p.phase == "drape") drape_seconds = p.seconds;
  if (draped && report.drape.motion.seconds > 0) summarise_motion(report.drape, drape_seconds, terminal);
  else if (draped)
    terminal.note(fmt::format("{}: {} particles, {} steps in {}, residual {} of the weight, largest strain {}%, {}",
                              results::status_name(report.drape.status), say_count(report.particles), report.drape.steps,
                              say_seconds(drape_seconds), format_number(report.drape.residual, 2),
                              format_number(100 * report.strain.all.any.largest, 2),
                              report.drape.self_intersections + report.drape.body_intersections + report.drape.inside_body == 0
                                  ? "nothing intersects"
                                  : fmt::format("{} intersections", report.drape.self_intersections +
                                                                        report.drape.body_intersections +
                                                                        report.drape.inside_body)));
  for (const results::TieMeasure& t : report.measures.ties)
    if (draped && t.gap > results::kOpenTie)
      terminal.note(fmt::format("`{}` does not close: {} mm are missing", t.closure, format_number(1000 * t.gap, 2)));
  for (const results::MeasureOutcome& m : report.stated_measures) terminal.note(fmt::format("       {} = {}", m.name, m.shown));
  for (const results::ExpectOutcome& e : report.expects)
    terminal.note(fmt::format("{} {}: found {}", e.passed ? "ok    " : "FAILED", e.text, e.shown));
  terminal.note(fmt::format("results in {}/", folder));
}

}  // namespace garment::cli
