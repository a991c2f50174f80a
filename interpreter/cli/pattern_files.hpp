#pragma once
// Formats of flat patterns by the endings of files: which are read, which are written.
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/finding.hpp"
#include "runtime/design/garment.hpp"
#include "runtime/io/pattern_json.hpp"

namespace garment::cli {

struct PatternFileOptions {
  std::string title;
  std::string size;  ///< of a file with several; empty: its sample size
};

struct PatternFile {
  std::optional<design::Garment> garment;
  std::shared_ptr<io::PatternLayout> layout;  ///< of a specification
  std::optional<io::PatternFrame> frame;      ///< of a specification, which has places in space
  std::vector<std::string> sizes;             ///< in the order of the file
  Findings findings;
  std::vector<std::string> notes;
};

/// ".json", ".dxf", ".svg" of a path, in lower case; "" where there is no ending.
std::string ending_of(const std::string& path);
bool is_pattern_ending(const std::string& ending);

/// Reads a pattern in the format that `ending` names (one of is_pattern_ending).
PatternFile read_pattern_file(const std::string& ending, std::string_view bytes,
                              const PatternFileOptions& options);

struct PatternBytes {
  std::optional<std::string> bytes;  ///< none: no format of this ending is written
  Findings findings;
};
PatternBytes write_pattern_file(const std::string& ending, const design::Garment& garment,
                                const io::PatternLayout* layout);

}  // namespace garment::cli
