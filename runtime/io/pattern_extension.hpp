#pragma once
// The block `garment` of a specification: what the format has no place for. Other readers pass over it.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/design/garment.hpp"
#include "runtime/io/cut_outline.hpp"
#include "runtime/io/pattern_panel.hpp"
#include "runtime/io/pattern_report.hpp"

namespace garment::io {

inline constexpr const char* kExtension = "garment";

/// Where a panel went in the file.
struct WrittenPanel {
  std::string key;
  bool back = false;         ///< written mirrored, as seen from the back
  std::vector<int> edges;    ///< by CutPanel::edges: number of the edge in the file
  std::vector<bool> turned;  ///< the file draws it the other way
};

struct WrittenPattern {
  std::vector<WrittenPanel> panels;
  std::vector<std::vector<int>> stitches;  ///< by seam: numbers of its stitches in the file
};

/// Adds the block to `root`, which holds all else, where it says anything that a reader would not come to by
/// itself. `stated` is the block that the file had, or null; with one there is one again in any case. Names
/// alone, which are guesses at first, give none to a file that came `from_elsewhere`.
void add_extension(nlohmann::ordered_json& root, const design::Garment& garment, const CutGarment& cut,
                   const WrittenPattern& written, const nlohmann::json* stated, bool from_elsewhere);

/// What the file does not say at all: "hem front_hem", "button top", ...
std::vector<std::string> not_written(const design::Garment& garment, const CutGarment& cut);

/// Puts what the block of `root` says over what was guessed: fabrics, and which panel is of which; grain,
/// notches, names of edges; names and relations of seams. `numbers` are the stitches of the seams. What is
/// not as it should be is passed over with a warning (G0958).
void read_extension(const nlohmann::json& root, const std::vector<FilePanel>& files,
                    const std::vector<std::size_t>& numbers, design::Garment& garment, PatternReport& report);

}  // namespace garment::io
