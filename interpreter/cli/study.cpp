#include "interpreter/cli/study.hpp"

#include <fmt/format.h>

#include "runtime/base/number.hpp"
#include "runtime/results/report.hpp"

namespace garment::cli {
namespace {

/// `text` as part of a file's name.
std::string file_word(const std::string& text) {
  std::string word;
  for (char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
                       c == '_' || c == '-' || c == '%';
    if (plain) word += c;
    else if (c != ' ' && c != '"') word += '_';
  }
  return word.empty() ? "_" : word.substr(0, 100);
}

/// A cell of a table; quoted where it must be (RFC 4180).
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

struct Round {
  std::string value;
  ExitCode code = kOk;
  results::Report report;
};

std::string number_cell(double value) { return format_number(value, 6); }

/// The questions asked, in the order of the first round that has them.
std::vector<std::string> questions_of(const std::vector<Round>& rounds) {
  for (const Round& round : rounds) {
    std::vector<std::string> texts;
    for (const results::ExpectOutcome& e : round.report.expects) texts.push_back(e.text);
    if (!texts.empty()) return texts;
  }
  return {};
}

/// The measures of the script, in the order of the first round that has them.
std::vector<results::MeasureOutcome> measures_of(const std::vector<Round>& rounds) {
  for (const Round& round : rounds)
    if (!round.report.stated_measures.empty()) return round.report.stated_measures;
  return {};
}

std::string table_of(const std::string& target, const std::vector<Round>& rounds) {
  const std::vector<std::string> questions = questions_of(rounds);
  std::string table = csv_field(target) + ",status,particles,steps,largest_strain";
  const std::vector<results::MeasureOutcome> measures = measures_of(rounds);
  for (const results::MeasureOutcome& m : measures) table += ',' + csv_field(m.unit.empty() ? m.name : m.name + " [" + m.unit + "]");
  for (const std::string& question : questions) table += ',' + csv_field(question);
  table += '\n';
  for (const Round& round : rounds) {
    const results::Report& r = round.report;
    table += csv_field(round.value) + ',' + (r.particles == 0 ? "refused" : results::status_name(r.drape.status)) + ',' +
             std::to_string(r.particles) + ',' + std::to_string(r.drape.steps) + ',' +
             number_cell(r.strain.all.any.largest);
    for (std::size_t k = 0; k < measures.size(); ++k) {
      table += ',';
      if (k >= r.stated_measures.size()) continue;
      table += r.stated_measures[k].value ? number_cell(*r.stated_measures[k].value) : csv_field(r.stated_measures[k].shown);
    }
    for (std::size_t k = 0; k < questions.size(); ++k) {
      table += ',';
      if (k >= r.expects.size()) continue;
      table += r.expects[k].value ? number_cell(*r.expects[k].value) : csv_field(r.expects[k].shown);
    }
    table += '\n';
  }
  return table;
}

}  // namespace

std::vector<std::string> round_folders(const interpreter::VaryAct& act, const std::string& folder) {
  std::vector<std::string> out;
  for (const std::string& value : act.values) out.push_back(folder + '/' + file_word(act.target) + '=' + file_word(value));
  return out;
}

ExitCode run_study(const RunOptions& options, const interpreter::VaryAct& act, const std::string& folder, Host& host,
                   Terminal& terminal) {
  ExitCode worst = kOk;
  std::vector<Round> rounds;
  const std::vector<std::string> folders = round_folders(act, folder);
  if (!options.checkpoints.resume)  // those of a study that was broken off before
    for (const std::string& of_round : folders) remove_checkpoints(of_round, {of_round}, host);
  for (std::size_t k = 0; k < act.values.size(); ++k) {
    const std::string& value = act.values[k];
    Round& round = rounds.emplace_back();
    round.value = value;
    RunOptions own = options;
    own.project.study = interpreter::Study{act.ordinal, act.target, value};
    own.project.only_errors = true;
    own.checkpoints.of_round = true;
    own.out = folders[k];
    terminal.note(fmt::format("{} = {}", act.target, value));
    bool reported = false;
    round.code = run_script(own, round.report, reported, host, terminal);
    worst = std::max(worst, round.code);
    if (round.code == kInterrupted) break;
  }
  const std::string table = table_of(act.target, rounds);
  const std::string path = folder + "/study_" + file_word(act.target) + ".csv";
  if (const HostResult<bool> written = host.write_file(path, table); !written) {
    show({plain_error("G0902", fmt::format("cannot write `{}`: {}", path, written.error.message),
                      "choose another folder with -o")},
         grammar::Sources{}, terminal);
    return kInputOutput;
  }
  terminal.note(fmt::format("table of {} rounds in {}", rounds.size(), path));
  return worst;
}

ExitCode check_studies(const ProjectOptions& options, const std::vector<interpreter::Act>& acts, Host& host,
                       Terminal& terminal) {
  for (const interpreter::Act& act : acts) {
    const auto* vary = std::get_if<interpreter::VaryAct>(&act.act);
    if (vary == nullptr) continue;
    for (const std::string& value : vary->values) {
      ProjectOptions own = options;
      own.study = interpreter::Study{vary->ordinal, vary->target, value};
      own.only_errors = true;
      Project round;
      if (const ExitCode code = load(round, own, host, terminal); code != kOk) {
        terminal.note(fmt::format("this is the round {} = {}", vary->target, value));
        return code;
      }
    }
  }
  return kOk;
}

}  // namespace garment::cli
