#pragma once
// `garment measure`: what a tape finds on a body, from a mesh or from a script's bodies.
#include <optional>
#include <string>

#include "interpreter/cli/project.hpp"

namespace garment::cli {

struct MeasureOptions {
  ProjectOptions project;       ///< `file` is an .obj mesh or a script
  std::string unit = "cm";      ///< of the table and of the CSV: cm, mm or in
  std::optional<double> scale;  ///< metres for one unit of the mesh
  bool csv = false;
  std::string picture;  ///< PNG file to write
};

/// Prints a table, CSV or (with --json) an object with all measures in metres; writes the picture.
ExitCode measure(const MeasureOptions& options, Host& host, Terminal& terminal);

}  // namespace garment::cli
