#pragma once
// Pattern files of other systems: in as scripts, out as flat patterns.
#include <string>

#include "interpreter/cli/pattern_files.hpp"
#include "interpreter/cli/project.hpp"

namespace garment::cli {

struct ImportOptions {
  std::string file, out, body;
  PatternFileOptions read;
  bool list_sizes = false;  ///< only say which sizes the file has
  bool force = false;       ///< overwrite an existing file
};
/// A pattern file as a script or, by the ending of `out`, as another pattern file.
ExitCode import_pattern(const ImportOptions& options, Host& host, Terminal& terminal);

struct ExportOptions {
  ProjectOptions project;
  PatternFileOptions read;
  std::string out;
};
/// The flat pattern of a script or of a pattern file, in the format that the ending of `out` names.
ExitCode export_pattern(const ExportOptions& options, Host& host, Terminal& terminal);

}  // namespace garment::cli
