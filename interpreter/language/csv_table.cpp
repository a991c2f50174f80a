#include "interpreter/language/csv_table.hpp"

#include <algorithm>

#include "interpreter/language/evaluate.hpp"
#include "interpreter/language/files.hpp"

namespace garment::interpreter {
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

void read_header(CsvTable& table, const std::vector<std::string>& cells) {
  for (const std::string& cell : cells) {
    CsvColumn column;
    std::size_t at = cell.find_first_of("[(");
    if (at == std::string::npos) at = cell.find(' ');
    column.name = trimmed(cell.substr(0, at));
    std::replace(column.name.begin(), column.name.end(), ' ', '_');
    if (at != std::string::npos) {
      std::string unit = trimmed(cell.substr(at));
      if (unit.size() > 2 && (unit[0] == '[' || unit[0] == '('))
        unit = trimmed(unit.substr(1, unit.size() - 2));
      column.unit_text = unit;
      if (const auto known = find_unit(unit)) column.unit = *known, column.has_unit = true;
    }
    if (column.name == "name" || column.name == "id" || column.name == "row")
      table.name_column = table.columns.size();
    table.columns.push_back(std::move(column));
  }
}

}  // namespace

std::vector<std::string> CsvTable::names() const {
  std::vector<std::string> out;
  for (const CsvRow& row : rows)
    if (row.cells.size() > name_column) out.push_back(row.cells[name_column]);
  return out;
}

const CsvRow* CsvTable::find(const std::string& name) const {
  for (const CsvRow& row : rows)
    if (row.cells.size() > name_column && row.cells[name_column] == name) return &row;
  return nullptr;
}

std::string CsvTable::hint(const std::string& name) const {
  const std::vector<std::string> all = names();
  std::string out = did_you_mean(name, all);
  if (!out.empty() || all.empty() || all.size() > 12) return out;
  out = "its rows are ";
  for (std::size_t k = 0; k < all.size(); ++k) out += (k > 0 ? ", " : "") + all[k];
  return out;
}

std::string read_named_file(Program& program, const std::string& path, Span place, std::uint64_t most,
                            const char* code, const std::string& what) {
  const std::string file = readable_path(program, path, place);
  const std::string& folder = program.options.script_dir;
  HostResult<std::string> text =
      program.host.read_file(folder.empty() || file[0] == '/' ? file : folder + '/' + file, most);
  if (!text)
    fail(program, Message(code, what + " `" + path + "` cannot be read: " + text.error.message, place)
                      .help("put the file beside the script"));
  return std::move(*text.value);
}

CsvTable read_csv_table(Program& program, const std::string& path, Span place, const char* code,
                        const std::string& example) {
  const std::string text = read_named_file(program, path, place, kMaxTable, code, "the table");
  CsvTable table;
  std::string_view rest = text;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (trimmed(line).empty() || trimmed(line)[0] == '#') continue;
    count_step(program, place);
    if (table.columns.empty())
      read_header(table, cells_of(line));
    else
      table.rows.push_back({cells_of(line), number});
  }
  if (table.columns.empty())
    fail(program, Message(code, "the table `" + path + "` is empty", place)
                      .help("its first row names the fields: `" + example + "`"));
  return table;
}

}  // namespace garment::interpreter
