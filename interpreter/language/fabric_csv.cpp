// `csv("fabrics.csv", row: "denim")`: a fabric from a table. The first row names the fields, with their
// units: `name, W [g/m^2], T [mm], EM_warp [%], B [gf*cm^2/cm]`.
#include <algorithm>

#include "interpreter/language/collections.hpp"
#include "interpreter/language/evaluate.hpp"
#include "interpreter/language/fabric_fields.hpp"
#include "interpreter/language/fabrics.hpp"
#include "interpreter/language/files.hpp"
#include "interpreter/language/function_table.hpp"
#include "runtime/base/number.hpp"

namespace garment::interpreter::detail {
namespace {

constexpr std::uint64_t kMaxTable = 4u << 20;

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

/// Cells of one line; quotes hold commas, a doubled quote is one.
std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> cells(1);
  bool quoted = false, was_quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const char c = line[k];
    if (quoted && c == '"' && k + 1 < line.size() && line[k + 1] == '"') {
      cells.back() += '"';
      ++k;
    } else if (c == '"' && (quoted || trimmed(cells.back()).empty())) {
      quoted = !quoted;
      was_quoted = true;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
      was_quoted = false;
    } else if (!(was_quoted && !quoted && (c == ' ' || c == '\t'))) {
      cells.back() += c;
    }
  }
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

/// A column: its field and the unit of its numbers.
struct Column {
  std::string name, unit_text;
  UnitValue unit;
  bool has_unit = false;
};

class Table {
 public:
  Table(Call& call, std::string path) : program_(call.program), path_(std::move(path)) {
    file_place_ = call.places[0]->span;
    row_place_ = call.given(1) ? call.places[1]->span : call.expr.span;
    read_lines();
  }

  Value fabric(const std::string& row) {
    const std::vector<std::string>& cells = find_row(row);
    design::Fabric fabric;
    fabric.kind = "stated";
    Given given;
    std::vector<std::string> unknown;
    for (std::size_t k = 0; k < columns_.size() && k < cells.size(); ++k) {
      if (k == name_column_ || cells[k].empty()) continue;
      take_cell(columns_[k], cells[k], fabric, given, unknown);
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

  void read_lines() {
    const std::string file = readable_path(program_, path_, file_place_);
    const std::string& folder = program_.options.script_dir;
    const HostResult<std::string> text =
        program_.host.read_file(folder.empty() || file[0] == '/' ? file : folder + '/' + file, kMaxTable);
    if (!text)
      fail_table("the table `" + path_ + "` cannot be read: " + text.error.message, file_place_,
                 "put the file beside the script");
    std::string_view rest = *text.value;
    if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      std::string_view line = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      if (line.ends_with('\r')) line.remove_suffix(1);
      if (trimmed(line).empty() || trimmed(line)[0] == '#') continue;
      count_step(program_, file_place_);
      if (columns_.empty())
        read_header(cells_of(line));
      else
        rows_.push_back(cells_of(line));
    }
    if (columns_.empty())
      fail_table("the table `" + path_ + "` is empty", file_place_,
                 "its first row names the fields: `name, W [g/m^2], T [mm], B [gf*cm^2/cm]`");
  }

  void read_header(const std::vector<std::string>& cells) {
    for (const std::string& cell : cells) {
      Column column;
      const std::size_t at = cell.find_first_of(" [(");
      column.name = trimmed(cell.substr(0, at));
      if (at != std::string::npos) {
        std::string unit = trimmed(cell.substr(at));
        if (unit.size() > 2 && (unit[0] == '[' || unit[0] == '('))
          unit = trimmed(unit.substr(1, unit.size() - 2));
        column.unit_text = unit;
        if (const auto known = find_unit(unit)) column.unit = *known, column.has_unit = true;
      }
      if (column.name == "name" || column.name == "id" || column.name == "row")
        name_column_ = columns_.size();
      columns_.push_back(std::move(column));
    }
  }

  const std::vector<std::string>& find_row(const std::string& row) {
    std::vector<std::string> names;
    for (const std::vector<std::string>& cells : rows_) {
      if (cells.size() <= name_column_) continue;
      if (cells[name_column_] == row) return cells;
      names.push_back(cells[name_column_]);
    }
    std::string hint = did_you_mean(row, names);
    if (hint.empty() && !names.empty() && names.size() <= 12) {
      hint = "its rows are ";
      for (std::size_t k = 0; k < names.size(); ++k) hint += (k > 0 ? ", " : "") + names[k];
    }
    fail_table("the table `" + path_ + "` has no row `" + row + "`", row_place_, hint);
  }

  void take_cell(const Column& column, const std::string& cell, design::Fabric& fabric, Given& given,
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
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
  std::size_t name_column_ = 0;
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
