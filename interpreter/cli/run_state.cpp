#include "interpreter/cli/run_state.hpp"

#include "runtime/model/archive_points.hpp"
#include "runtime/simulator/solver_state.hpp"

namespace garment::cli {
namespace {

constexpr std::string_view kRound = "ended round\n";

void keep(Archive& a, std::optional<double>& value) {
  bool has = value.has_value();
  double number = value.value_or(0);
  a.keep(has);
  if (has) a.keep_any(number);
  if (a.reading() && a.ok()) value = has ? std::optional<double>(number) : std::nullopt;
}

void keep_round(Archive& a, ExitCode& code, results::Report& report) {
  auto number = static_cast<std::int32_t>(code);
  a.keep(number);
  a.demand(number >= 0 && number <= kExpectFailed);
  if (a.reading() && a.ok()) code = static_cast<ExitCode>(number);
  a.keep(report.particles);
  a.keep_any(report.strain.all.any.largest);
  std::size_t most = report.drape.reactions.size();
  a.keep(most);
  simulator::keep(a, report.drape, most);
  keep_answers(a, report);
}

}  // namespace

void keep(Archive& a, model::State& state, std::size_t n) {
  model::keep(a, state.position, n);
  model::keep(a, state.velocity, n);
  a.keep(state.time);
  a.keep(state.slip);
}

void keep_answers(Archive& a, results::Report& report) {
  if (a.length(report.expects, 1))
    for (results::ExpectOutcome& e : report.expects) {
      for (std::string* text : {&e.text, &e.shown, &e.expected}) a.keep(*text);
      keep(a, e.value);
      a.keep(e.passed);
    }
  if (a.length(report.stated_measures, 1))
    for (results::MeasureOutcome& m : report.stated_measures) {
      for (std::string* text : {&m.name, &m.unit, &m.shown}) a.keep(*text);
      keep(a, m.value);
    }
}

std::string ended_round(ExitCode code, results::Report& report) {
  Archive a;
  keep_round(a, code, report);
  return std::string(kRound) + a.take();
}

bool is_ended_round(const std::string& state) { return state.starts_with(kRound); }

bool read_ended_round(const std::string& state, ExitCode& code, results::Report& report) {
  Archive a(std::string_view(state).substr(kRound.size()));
  keep_round(a, code, report);
  return a.whole();
}

}  // namespace garment::cli
