// `csv("fabrics.csv", row: "denim")`: a fabric from a table. The first row names the fields, with their
// units: `name, W [g/m^2], T [mm], EM_warp [%], B [gf*cm^2/cm]`.
#include <algorithm>

#include "interpreter/language/collections.hpp"
#include "interpreter/language/csv_table.hpp"
#include "interpreter/language/evaluate.hpp"
#include "interpreter/language/fabric_fields.hpp"
#include "interpreter/language/fabrics.hpp"
#include "interpreter/language/function_table.hpp"
#include "runtime/base/number.hpp"

namespace garment::interpreter::detail {
namespace {

class Table {
 public:
  Table(Call& call, std::string path) : program_(call.program), path_(std::move(path)) {
    file_place_ = call.places[0]->span;
    row_place_ = call.given(1) ? call.places[1]->span : call.expr.span;
    table_ = read_csv_table(program_, path_, file_place_, "G1132", "name, W [g/m^2], T [mm], B [gf*cm^2/cm]");
  }

  Value fabric(const std::string& row) {
    const std::vector<std::string>& cells = find_row(row);
    design::Fabric fabric;
    fabric.kind = "stated";
    Given given;
    std::vector<std::string> unknown;
    for (std::size_t k = 0; k < table_.columns.size() && k < cells.size(); ++k) {
      if (k == table_.name_column || cells[k].empty()) continue;
      take_cell(table_.columns[k], cells[k], fabric, given, unknown);
    }
    apply_given(program_, fabric, given);
    if (fabric.source.empty()) fabric.source = path_ + ", row " + row;
    warn_unknown(unknown);
    warn_defaults(program_, given, row, row_place_);
    warn_implausible(program_, fabric, given, row);
    return Value{FabricValue{std::make_shared<design::Fabric>(std::move(fabric))}};
  }

 private:
  [[noreturn]] void fail_table(const std::string& what, Span span, const std::string& help) {
    fail(program_, Message("G1132", what, span).help(help));
  }

  const std::vector<std::string>& find_row(const std::string& row) {
    const CsvRow* found = table_.find(row);
    if (found == nullptr) fail_table("the table `" + path_ + "` has no row `" + row + "`", row_place_, table_.hint(row));
    return found->cells;
  }

  void take_cell(const CsvColumn& column, const std::string& cell, design::Fabric& fabric, Given& given,
                 std::vector<std::string>& unknown) {
    const std::vector<std::string> fields = fabric_field_names();
    if (std::find(fields.begin(), fields.end(), column.name) == fields.end())
      return unknown.push_back(column.name);
    const bool text = column.name == "kind" || column.name == "source" || column.name == "color" ||
                      column.name == "pattern";
    if (text) return take_field(program_, fabric, given, column.name, file_place_, own_text(cell), file_place_);
    const auto number = parse_number(cell);
    if (!number)
      fail_table("`" + cell + "` in column `" + column.name + "` of `" + path_ + "` is no number", row_place_,
                 "write numbers with a point, and the unit in the first row");
    if (!column.unit_text.empty() && !column.has_unit)
      fail_table("`" + column.unit_text + "` in the first row of `" + path_ + "` is no unit", file_place_,
                 did_you_mean(column.unit_text, unit_names()));
    take_field(program_, fabric, given, column.name, file_place_,
               number_value(*number * column.unit.factor, column.unit.dimension, column.unit.percent),
               file_place_);
  }

  void warn_unknown(const std::vector<std::string>& unknown) {
    if (unknown.empty()) return;
    std::string list;
    for (const std::string& name : unknown) list += (list.empty() ? "" : ", ") + name;
    std::string hint = did_you_mean(unknown[0], fabric_field_names());
    report(program_,
           Message("G1135", "columns of `" + path_ + "` that are no fields of a fabric: " + list, file_place_)
               .warning()
               .help(hint.empty() ? "they are not read" : hint));
  }

  Program& program_;
  std::string path_;
  Span file_place_, row_place_;
  CsvTable table_;
};

Value run_csv(Call& call) {
  std::string texts[2];
  for (std::size_t k = 0; k < 2; ++k) {
    const auto* text = call.arguments[k].as<std::string>();
    if (text == nullptr)
      fail(call.program, Message("G0306", kind_of(call.arguments[k]) + " where `csv` takes text in quotes",
                                 call.places[k]->span));
    texts[k] = *text;
  }
  return Table(call, texts[0]).fabric(texts[1]);
}

}  // namespace

std::vector<FunctionRecord> cloth_functions() {
  return {
      {"csv",
       "csv(\"FILE.csv\", row: \"NAME\")",
       "a fabric from a table: its first row names the fields with their units, `name, W [g/m^2], T [mm]`",
       "csv(\"fabrics.csv\", row: \"denim\")",
       {"file", "row"},
       2,
       run_csv}};
}

}  // namespace garment::interpreter::detail
