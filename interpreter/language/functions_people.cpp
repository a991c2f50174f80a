// People from files: `measurements("anna.smis")`, `people("people.csv")`, and what a body takes of them.
#include <algorithm>

#include "interpreter/language/collections.hpp"
#include "interpreter/language/csv_table.hpp"
#include "interpreter/language/function_arguments.hpp"
#include "interpreter/language/person_names.hpp"
#include "runtime/base/number.hpp"
#include "runtime/io/measurements_xml.hpp"

namespace garment::interpreter::detail {
namespace {

constexpr const char* kExample = "name, stature [cm], bust [cm], waist [cm], hip [cm]";

std::string text_at(Call& call, std::size_t k) {
  const auto* text = call.arguments[k].as<std::string>();
  if (text == nullptr)
    fail(call.program,
         Message("G0306", kind_of(call.arguments[k]) + " where " + called(call) + " takes text in quotes",
                 place(call, k)));
  return *text;
}

Value run_measurements(Call& call) {
  Program& program = call.program;
  const std::string path = text_at(call, 0);
  io::MeasurementOptions options;
  if (call.given(1)) options.size = length_at(call, 1);
  if (call.given(2)) options.height = length_at(call, 2);
  const std::string text =
      read_named_file(program, path, place(call, 0), io::kMaxMeasurementBytes, "G0720", "the measurements");
  io::MeasurementsResult read = io::read_measurements(text, options, path, program.origin(place(call, 0)));
  for (Diagnostic& diagnostic : to_diagnostics(read.findings, program.origins)) {
    Message message("", "", place(call, 0));
    message.diagnostic = std::move(diagnostic);
    report(program, std::move(message));
  }
  if (!read.measurements) throw Stop{};
  RecordFields fields;
  for (const io::Measurement& m : *read.measurements)
    fields.emplace_back(m.name, number_value(m.value, m.angle ? kAngle : kLength));
  return record_value(program, std::move(fields), call.expr.span);
}

[[noreturn]] void fail_people(Call& call, const std::string& what, const std::string& help) {
  fail(call.program, Message("G0722", what, place(call, 0)).help(help));
}

Value person_of(Call& call, const std::string& path, const CsvTable& table, const CsvRow& row) {
  RecordFields fields;
  const auto at = "`" + path + "` line " + std::to_string(row.line) + ": ";
  if (row.cells.size() > table.columns.size())
    fail_people(call,
                at + std::to_string(row.cells.size()) + " cells; the first row names " +
                    std::to_string(table.columns.size()),
                "write numbers with a point, and text that holds a comma in quotes");
  for (std::size_t k = 0; k < row.cells.size(); ++k) {
    const CsvColumn& column = table.columns[k];
    const std::string& cell = row.cells[k];
    if (cell.empty() || column.name.empty()) continue;
    const auto number = k == table.name_column ? std::nullopt : parse_number(cell);
    if (column.unit_text.empty() && !number) {
      fields.emplace_back(column.name, text_value(call.program, cell, place(call, 0)));
      continue;
    }
    if (!number)
      fail_people(call, at + "`" + cell.substr(0, 40) + "` in column `" + column.name + "` is no number",
                  "write numbers with a point");
    if (!column.unit_text.empty() && !column.has_unit)
      fail_people(call,
                  "`" + column.unit_text.substr(0, 40) + "` in the first row of `" + path + "` is no unit",
                  did_you_mean(column.unit_text, unit_names()));
    fields.emplace_back(
        column.name, number_value(*number * column.unit.factor, column.unit.dimension, column.unit.percent));
  }
  return record_value(call.program, std::move(fields), call.expr.span);
}

CsvTable people_table(Call& call, const std::string& path) {
  CsvTable table = read_csv_table(call.program, path, place(call, 0), "G0722", kExample);
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    for (std::size_t j = 0; j < k; ++j)
      if (!table.columns[k].name.empty() && table.columns[k].name == table.columns[j].name)
        fail_people(call, "the first row of `" + path + "` names `" + table.columns[k].name + "` twice",
                    "leave one of the two");
  return table;
}

/// All rows, or the one of the name.
Value run_people(Call& call) {
  const std::string path = text_at(call, 0);
  const CsvTable table = people_table(call, path);
  if (call.given(1)) {
    const std::string name = text_at(call, 1);
    const CsvRow* row = table.find(name);
    if (row == nullptr)
      fail(call.program,
           Message("G0722", "the table `" + path + "` has no row `" + name + "`", place(call, 1))
               .help(table.hint(name)));
    return person_of(call, path, table, *row);
  }
  std::vector<Value> people;
  for (const CsvRow& row : table.rows) people.push_back(person_of(call, path, table, row));
  return list_value(call.program, people, call.expr.span);
}

const RecordBody& record_at(Call& call, std::size_t k) {
  const auto* record = call.arguments[k].as<RecordValue>();
  if (record == nullptr)
    fail(call.program,
         Message(
             "G0306",
             kind_of(call.arguments[k]) + " where " + called(call) + " takes a person, a record of measures",
             place(call, k))
             .help("measurements(\"anna.smis\") or people(\"people.csv\", name: \"Anna\") gives one"));
  return **record;
}

/// What a person's record says of a measure, under any of its names; null where it says nothing. Files write
/// 0 for what was not taken.
const Quantity* stated(Call& call, const RecordBody& person, const PersonName& measure) {
  auto under = [&](std::string_view name) -> const Quantity* {
    for (const auto& [field, value] : person) {
      if (field != name) continue;
      const auto* q = value.as<Quantity>();
      if (q == nullptr || (q->dimension != kLength && !is_plain_zero(*q)))
        fail(call.program,
             Message("G0723", "`" + field + "` of the person is " + show(value) + "; it must be a length",
                     place(call, 0))
                 .help("give its unit: `" + field + " [cm]` in the first row of a table"));
      return q->value != 0 ? q : nullptr;
    }
    return nullptr;
  };
  if (const Quantity* q = under(measure.measure)) return q;
  for (std::string_view alias : measure.aliases)
    if (const Quantity* q = under(alias)) return q;
  return nullptr;
}

const PersonName& measure_at(Call& call, std::size_t k) {
  const PersonName* name = find_person_name(text_at(call, k));
  if (name == nullptr)
    fail(call.program,
         Message("G0307", "a person has no measure `" + text_at(call, k) + "`", place(call, k)));
  return *name;
}

/// Half and double of what goes with the person's size is no grown person's any more, but a wrong unit.
void check_plausible(Call& call, const Quantity& found, const PersonName& measure) {
  const auto* usual = call.arguments[2].as<Quantity>();
  if (usual == nullptr || (found.value > 0.5 * usual->value && found.value < 2 * usual->value)) return;
  fail(call.program,
       Message("G0711",
               "`" + std::string(measure.measure) + "` of the person is " +
                   format_quantity(found.value, kLength) + "; about " +
                   format_quantity(usual->value, kLength, false, 3) + " goes with the other measures",
               place(call, 0))
           .help("check its unit in the file"));
}

Value run_measure_of(Call& call) {
  const RecordBody& person = record_at(call, 0);
  if (person.empty()) return call.arguments[2];
  const PersonName& measure = measure_at(call, 1);
  if (const Quantity* q = stated(call, person, measure)) {
    check_plausible(call, *q, measure);
    return Value{*q};
  }
  if (measure.needed)
    fail(call.program,
         Message("G0723", "the person has no `" + std::string(measure.measure) + "`", place(call, 0))
             .help("state it in the file, as `" + std::string(measure.measure) + "` or `" +
                   std::string(measure.aliases.front()) + "`, or here, as in `" +
                   std::string(measure.measure) + ": 92 cm`"));
  call.program.estimated.emplace_back(measure.measure);
  return call.arguments[2];
}

Value run_size_of(Call& call) {
  const RecordBody& person = record_at(call, 0);
  if (person.empty()) return call.arguments[4];
  const Quantity* q = stated(call, person, measure_at(call, 1));
  if (q == nullptr) return call.arguments[4];
  const ListBody& table = list_at(call, 2);
  const double lowest = number_at(call, 3).value;
  std::vector<double> girths;
  for (const Value& v : table)
    girths.push_back(as_quantity(call.program, v, place(call, 2), kLength, "`table`").value);
  if (girths.size() < 2) return call.arguments[4];
  const double girth = std::clamp(q->value, girths.front(), girths.back());
  std::size_t k = 1;
  while (k + 1 < girths.size() && girths[k] < girth) ++k;
  const double size =
      lowest + 2 * (static_cast<double>(k) - 1 + (girth - girths[k - 1]) / (girths[k] - girths[k - 1]));
  return number_value(std::clamp(size, lowest, lowest + 2 * static_cast<double>(girths.size() - 1)));
}

}  // namespace

std::vector<FunctionRecord> people_functions() {
  return {
      {"measurements",
       "measurements(\"FILE.smis\" [, size: LENGTH] [, height: LENGTH])",
       "a person's measures from a file of Seamly or Valentina (.smis .vit, multisize .smms .vst): a record "
       "of lengths",
       "measurements(\"anna.smis\")",
       {"file", "size", "height"},
       1,
       run_measurements},
      {"people",
       "people(\"FILE.csv\" [, name: \"NAME\"])",
       "the rows of a table as a list of records, or the row of one person: the first row names the measures "
       "with their units, `name, waist [cm]`",
       "people(\"people.csv\", name: \"Anna\")",
       {"file", "name"},
       1,
       run_people},
      {"measure_of",
       "measure_of(PERSON, \"MEASURE\", STANDARD)",
       "a measure of a person's record under any of its known names (`hip`, `hip_circ`); the standard where "
       "it is not stated",
       "let anna = { hip_circ = 98 cm }; measure_of(anna, \"hip\", 100 cm)",
       {"person", "measure", "standard"},
       3,
       run_measure_of},
      {"size_of",
       "size_of(PERSON, \"MEASURE\", [LENGTH, ...], LOWEST, STANDARD)",
       "the size, between the steps of 2 of a table that begins at LOWEST, whose measure is the person's; "
       "the standard without one",
       "let anna = { bust_circ = 90 cm }; size_of(anna, \"bust\", [80 cm, 84 cm, 88 cm, 92 cm], 34, 40)",
       {"person", "measure", "table", "lowest", "standard"},
       5,
       run_size_of},
  };
}

}  // namespace garment::interpreter::detail
