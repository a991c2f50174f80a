#pragma once
// What a command works on: a script, or a sewing-pattern specification, evaluated to a declared garment.
#include <optional>
#include <string>
#include <vector>

#include "grammar/diagnostic.hpp"
#include "interpreter/cli/exit_codes.hpp"
#include "interpreter/cli/terminal.hpp"
#include "interpreter/language/interpret.hpp"
#include "runtime/base/host.hpp"
#include "runtime/io/pattern_json.hpp"

namespace garment::cli {

struct ProjectOptions {
  std::string file;
  std::vector<std::string> params;     ///< "long=70cm"
  std::string body;                    ///< OBJ file that a specification is worn by
  bool worn = false;                   ///< a specification without a body is an error; else its attachments are left out
  std::string stdlib_dir;
  std::vector<std::string> library_dirs;  ///< where `use NAME` looks first
  std::optional<interpreter::Study> study;  ///< one round of a `vary`
  bool only_errors = false;            ///< keep warnings to itself
  bool build_bodies = true;            ///< see InterpretOptions
  std::vector<std::string> allow_read;   ///< further folders below which a script may read
  std::vector<std::string> allow_write;  ///< further folders below which it may write
};

struct Project {
  std::string name;                    ///< the file's name without folder and ending
  grammar::Sources sources;
  interpreter::Interpretation result;
  grammar::SourceId source = 0;
  bool is_pattern = false;             ///< came from a specification
};

/// Reads and evaluates. Prints what is wrong; returns kOk when the garment can be used (warnings are no obstacle).
ExitCode load(Project& project, const ProjectOptions& options, Host& host, Terminal& terminal);

/// Raises or lowers an imported garment into the space of its body: specifications of the older format are drawn about
/// the pelvis, bodies may stand on the floor, and the other way round. Gives how far it was raised, m.
double share_frame(design::Garment& garment, io::PatternFrame frame, const body::Body& body);

/// Prints diagnostics in the chosen form. With `--json` they go to standard output.
void show(const grammar::Diagnostics& diagnostics, const grammar::Sources& sources, Terminal& terminal);

/// A coded error that has no place in a script ("cannot read FILE").
grammar::Diagnostic plain_error(std::string code, std::string message, std::string help);

/// Path without folder and ending.
std::string stem_of(const std::string& path);
/// Folder of a path, "." when it has none.
std::string folder_of(const std::string& path);
bool ends_with(const std::string& text, std::string_view ending);

}  // namespace garment::cli
