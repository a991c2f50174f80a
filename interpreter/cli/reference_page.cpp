#include "interpreter/cli/reference_page.hpp"

#include "interpreter/cli/reference_library.hpp"
#include "interpreter/language/construct_table.hpp"

namespace garment::cli {
namespace {

std::string table_cell(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '|') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

std::string command_text(const CLI::App& command) {
  std::string call = "garment " + command.get_name(), rows;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) {
      std::string name = option->get_single_name();
      for (char& c : name) c = static_cast<char>(c >= 'a' && c <= 'z' ? c - 32 : c);
      call += ' ' + name + (option->get_expected_max() > 1 ? " ..." : "");
    }
    if (option->get_name(false, true) == "-h,--help" || option->get_group().empty()) continue;  // hidden ones have no group
    const std::string name =
        option->get_positional() ? option->get_single_name() : option->get_name(false, true);
    rows += "| `" + table_cell(name) + "` | " + table_cell(option->get_description()) + " |\n";
  }
  std::string text = "### " + command.get_name() + "\n\n```\n" + call + "\n```\n\n";
  std::string doc = command.get_description();
  if (!doc.empty() && doc[0] >= 'a' && doc[0] <= 'z') doc[0] = static_cast<char>(doc[0] - 32);
  text += doc + ".\n\n";
  return rows.empty() ? text : text + "| option | meaning |\n|---|---|\n" + rows + '\n';
}

}  // namespace

std::string reference_page(const CLI::App& app, const std::string& stdlib_dir, Host& host) {
  std::string text = interpreter::reference_markdown() + library_chapter(stdlib_dir, host) + "## Commands\n\n";
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    text += command_text(*command);
  return text +
         "Exit codes: 0 ok, 1 diagnostics, 2 wrong usage, 3 input or output, 4 the simulation failed, 5 an "
         "`expect` failed or a layer lies on the wrong side, 130 interrupted.\n";
}

}  // namespace garment::cli
