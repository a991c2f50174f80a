#pragma once
// One panel of a pattern file: vertices and edges in, a closed outline that runs counter-clockwise out.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/design/panel.hpp"
#include "runtime/io/pattern_json.hpp"
#include "runtime/io/pattern_report.hpp"

namespace garment::io {

constexpr double kShortestEdge = 1e-4;    ///< m; what is shorter is no edge, neither here nor in a script
constexpr double kLeastPanelArea = 1e-6;  ///< m^2; less is no panel

/// What became of edge i of the file.
struct FileEdge {
  int edge = -1;        ///< index into Panel::edges; -1: dropped because it has no length
  bool turned = false;  ///< the outline walks it from its end to its start
  std::string label;
};

struct FilePanel {
  std::string file_name;        ///< the key in the file
  design::Panel panel;          ///< edges still without names
  std::vector<FileEdge> edges;  ///< by the file's edge numbers
  bool back = false;            ///< drawn clockwise, so seen from its back: `panel` is its mirror image
};

/// Units and conventions of the whole file.
struct PatternUnits {
  double per_metre = 100;
  bool relative_curves = true;  ///< control points in the edge's own frame; otherwise in the panel's
};

/// Reads one panel; nothing and errors in `report` where it cannot be one.
std::optional<FilePanel> read_pattern_panel(const std::string& file_name, const nlohmann::json& value,
                                            const PatternUnits& units, const PatternLimits& limits,
                                            PatternReport& report);

/// Signed area of a closed loop of edges, m^2; positive counter-clockwise.
double signed_area(const std::vector<design::Edge>& edges);
/// Where a point of a rigidly placed panel stands in space.
inline Eigen::Vector3d placed(const design::Panel& panel, const geometry::Point2& p) {
  return panel.placement.rotation * Eigen::Vector3d(p.x(), p.y(), 0) + panel.placement.translation;
}

}  // namespace garment::io
