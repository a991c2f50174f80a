#pragma once
// Tables in text: commas between cells, names with their units in the first row.
#include <string>
#include <vector>

#include "interpreter/language/program.hpp"

namespace garment::interpreter {

struct CsvColumn {
  std::string name;       ///< "waist" of `waist [cm]`; blanks within it become _
  std::string unit_text;  ///< "cm", or empty
  UnitValue unit;
  bool has_unit = false;  ///< `unit_text` is in the table of units
};
struct CsvRow {
  std::vector<std::string> cells;
  std::size_t line = 0;
};
struct CsvTable {
  std::vector<CsvColumn> columns;
  std::vector<CsvRow> rows;
  std::size_t name_column = 0;  ///< `name`, `id` or `row`; the first where there is none

  /// Names of the rows, in their order.
  std::vector<std::string> names() const;
  /// The row of this name; null where there is none.
  const CsvRow* find(const std::string& name) const;
  /// "did you mean `denim`?", or the names of all rows where they are few.
  std::string hint(const std::string& name) const;
};

/// Reads a file that the script names; at most 4 MB. Lines that begin with # and empty ones are passed over.
/// Where the file cannot be read or is empty: `code`, at `place`, with `example` of a first row in the
/// remedy.
CsvTable read_csv_table(Program& program, const std::string& path, Span place, const char* code,
                        const std::string& example);

/// The text of a file that the script names, as `readable_path` allows; else a report of `code` and Stop.
std::string read_named_file(Program& program, const std::string& path, Span place, std::uint64_t most,
                            const char* code, const std::string& what);

}  // namespace garment::interpreter
