#pragma once
// How a specification laid a garment out: what the declared garment does not keep (numbers of vertices and
// edges, the way its pieces were drawn, members that mean nothing here) and the writer needs to give the same
// file back.
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/design/garment.hpp"
#include "runtime/io/pattern_panel.hpp"

namespace garment::io {

struct EdgeLayout {
  int start = -1, end = -1;  ///< numbers of vertices
  int outline = -1;          ///< index into Panel::edges; -1: it has no length and is in no outline
  bool turned = false;       ///< the outline walks it from its end to its start
};

struct PanelLayout {
  std::string panel;              ///< its name in the garment
  std::string key;                ///< its name in the file
  bool back = false;              ///< drawn as seen from the back, so mirrored in the garment
  std::vector<EdgeLayout> edges;  ///< by the file's numbers; empty: the outline's edges in order
  /// As the file has them, null where the garment has them; a list, or an object of some by their numbers.
  nlohmann::json vertices = nlohmann::json::array();
  nlohmann::json words =
      nlohmann::json::array();  ///< of each edge, without `endpoints`; a list or an object likewise
  nlohmann::json rest = nlohmann::json::object();  ///< the panel's other members
};

struct StitchLayout {
  std::string seam;      ///< its name; empty: it was left out of the garment
  bool swapped = false;  ///< the seam's first side is the stitch's second
  nlohmann::json words;  ///< the stitch as the file has it; null: as the garment has it
};

/// The file's own words are written again only where they mean what the garment says; else the garment's.
struct PatternLayout {
  nlohmann::json root = nlohmann::json::object();  ///< the document without its panels and stitches
  PatternUnits units;
  bool pairs = false;  ///< curves are plain pairs
  double raised = 0;   ///< m by which the garment was lifted after reading
  std::vector<PanelLayout> panels;
  std::vector<StitchLayout> stitches;
};

/// Layout of a document that was read into `panels` and `garment` (whose seams came from the stitches
/// `numbers`).
PatternLayout pattern_layout(const nlohmann::json& root, const PatternUnits& units,
                             const std::vector<FilePanel>& panels, const design::Garment& garment,
                             const std::vector<std::size_t>& numbers);

/// The layout as lines of JSON, one for the file and one for each panel that needs one, without what a writer
/// would say of `garment` anyway. From them `layout_of_lines` makes it again. Panels and seams go by their
/// names.
std::vector<std::string> layout_lines(const PatternLayout& layout, const design::Garment& garment);

/// What a line of layout starts with in a script.
inline constexpr std::string_view kLayoutMark = "#: ";

/// The layout that the lines of a script after `kLayoutMark` give; lines that give none are passed over.
/// `found` says whether there was one.
PatternLayout layout_of_script(std::string_view script, bool& found);

}  // namespace garment::io
