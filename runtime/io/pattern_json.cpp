#include "runtime/io/pattern_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "runtime/base/number.hpp"
#include "runtime/io/pattern_attach.hpp"
#include "runtime/io/pattern_document.hpp"
#include "runtime/io/pattern_extension.hpp"
#include "runtime/io/pattern_layout.hpp"
#include "runtime/io/pattern_names.hpp"
#include "runtime/io/pattern_panel.hpp"
#include "runtime/io/pattern_stitch.hpp"

namespace garment::io {
namespace {

using nlohmann::json;

class PatternReader {
 public:
  PatternReader(const PatternOptions& options) : options_(options) {}

  PatternResult read(std::string_view text) {
    std::optional<design::Garment> garment;
    if (auto document = parse_pattern_document(text, options_.limits, report_))
      garment = read_document(*document);
    PatternResult result;
    if (report_.errors() == 0) result.garment = std::move(garment);
    if (result.garment) result.layout = std::move(layout_);
    result.frame = frame_;
    result.findings = report_.take_findings();
    result.notes = report_.take_notes();
    return result;
  }

 private:
  std::optional<design::Garment> read_document(const PatternDocument& document) {
    const json* pattern = member(document.root, "pattern");
    const json* panels = pattern ? member(*pattern, "panels") : nullptr;
    if (!panels || !panels->is_object()) {
      report_.error("G0943",
                    fmt::format("`pattern.panels` is {}, expected an object of panels",
                                panels ? describe(*panels) : "missing"),
                    "this does not look like a sewing pattern of GarmentCode or Garment-Pattern-Generator");
      return std::nullopt;
    }
    if (panels->empty() || panels->size() > options_.limits.max_panels) {
      report_.error("G0944", fmt::format("the pattern has {} panels, expected 1 to {}", panels->size(),
                                         options_.limits.max_panels));
      return std::nullopt;
    }
    read_units(document.root);
    if (report_.errors() > 0 || !read_panels(*panels, panel_order(document, *pattern))) return std::nullopt;

    design::Garment garment;
    garment.title = options_.title;
    garment.fabrics.push_back(options_.fabric);
    std::vector<std::size_t> numbers;
    garment.seams =
        read_pattern_stitches(member(*pattern, "stitches"), panels_, options_.limits, report_, &numbers);
    if (report_.errors() > 0) return std::nullopt;
    EdgeLabels labels = take_panels(garment);
    guess_frame(document.root, garment);
    name_edges_and_seams(garment, labels, taken_);
    read_extension(document.root, panels_, numbers, garment, report_);
    if (options_.keep_layout)
      layout_ = std::make_shared<PatternLayout>(pattern_layout(document.root, units_, panels_, garment, numbers));
    if (options_.attach)
      garment.attachments = guess_attachments(garment, labels, frame_, options_.body, report_);
    return garment;
  }

  void read_units(const json& root) {
    const json* properties = member(root, "properties");
    const json* scale = properties ? member(*properties, "units_in_meter") : nullptr;
    if (!scale) {
      report_.warning("G0950", "`properties.units_in_meter` is missing; 100 is taken (centimetres)",
                      "state how many units of the file make a metre");
    } else if (!scale->is_number() || !(scale->get<double>() >= 1e-3) || !(scale->get<double>() <= 1e6)) {
      report_.error("G0950",
                    fmt::format("`properties.units_in_meter` is {}, expected a number from 0.001 to 1000000",
                                describe(*scale)),
                    "centimetres are 100 units per metre");
    } else {
      units_.per_metre = scale->get<double>();
      report_.note(fmt::format("{} units of the file make a metre", format_number(units_.per_metre)));
    }
    const json* coords = properties ? member(*properties, "curvature_coords") : nullptr;
    units_.relative_curves = !coords || *coords != "absolute";
  }

  /// The file's own order: `panel_order` where it is a permutation of the panels, else as they stand.
  static std::vector<std::string> panel_order(const PatternDocument& document, const json& pattern) {
    const json* stated = member(pattern, "panel_order");
    if (!stated || !stated->is_array() || stated->size() != document.panel_order.size())
      return document.panel_order;
    std::set<std::string> known(document.panel_order.begin(), document.panel_order.end());
    std::vector<std::string> order;
    for (const json& name : *stated) {
      if (!name.is_string() || known.erase(name.get_ref<const std::string&>()) == 0)
        return document.panel_order;
      order.push_back(name.get<std::string>());
    }
    return order;
  }

  bool read_panels(const json& panels, const std::vector<std::string>& order) {
    std::size_t total = 0;
    for (const std::string& name : order) {
      const json& value = panels.at(name);
      for (const char* key : {"edges", "vertices"})
        if (const json* list = member(value, key); list && list->is_array()) total += list->size();
      if (total > 2 * options_.limits.max_total) {
        report_.error("G0944",
                      fmt::format("the panels have more than {} edges together", options_.limits.max_total));
        return false;
      }
      if (auto panel = read_pattern_panel(name, value, units_, options_.limits, report_))
        panels_.push_back(std::move(*panel));
    }
    return report_.errors() == 0;  // without a panel its stitches would only give false alarms
  }

  /// Moves the panels into `garment` under names the language can hold, and gives the labels by outline edge.
  EdgeLabels take_panels(design::Garment& garment) {
    taken_ = {options_.body, options_.fabric.name};
    EdgeLabels labels;
    for (FilePanel& file : panels_) {
      file.panel.name = unique_name(identifier(file.file_name, "panel"), taken_);
      if (file.panel.name != file.file_name)
        report_.note(fmt::format("panel {} is called `{}`", in_ticks(file.file_name), file.panel.name));
      file.panel.resolution = options_.resolution;
      std::vector<std::string>& of_panel = labels.emplace_back(file.panel.edges.size());
      for (FileEdge& edge : file.edges)
        if (edge.edge >= 0) of_panel[edge.edge] = edge.label;
      garment.panels.push_back(std::move(file.panel));
    }
    return labels;
  }

  void guess_frame(const json& root, const design::Garment& garment) {
    if (options_.frame) {
      frame_ = *options_.frame;
      return;
    }
    frame_ = stated_frame(root).value_or(frame_by_height(garment));
    report_.note(frame_ == PatternFrame::floor ? "its space: the body stands on y = 0"
                                               : "its space: y = 0 is the pelvis of a body in T-pose");
  }

  /// Only the older format writes curves as plain pairs, only the newer one as objects with a `type`.
  static std::optional<PatternFrame> stated_frame(const json& root) {
    for (const json& panel : root.at("pattern").at("panels"))
      for (const json& edge : panel.at("edges"))
        if (const json* curvature = member(edge, "curvature"); curvature && !curvature->is_null())
          return curvature->is_array() ? PatternFrame::pelvis : PatternFrame::floor;
    return std::nullopt;
  }

  /// Below the pelvis there is nothing in a frame that stands on the floor; and what ends below 0.75 m there
  /// would be socks.
  static PatternFrame frame_by_height(const design::Garment& garment) {
    double low = 1e9, high = -1e9;
    for (const design::Panel& panel : garment.panels)
      for (const design::Edge& edge : panel.edges) {
        double y = placed(panel, edge.curve.start()).y();
        low = std::min(low, y);
        high = std::max(high, y);
      }
    return low < -0.15 || high < 0.75 ? PatternFrame::pelvis : PatternFrame::floor;
  }

  const PatternOptions& options_;
  PatternReport report_;
  PatternUnits units_;
  PatternFrame frame_ = PatternFrame::floor;
  std::vector<FilePanel> panels_;
  std::shared_ptr<PatternLayout> layout_;
  std::set<std::string> taken_;
};

}  // namespace

PatternResult read_pattern(std::string_view json_text, const PatternOptions& options) {
  return PatternReader(options).read(json_text);
}

void move_garment(design::Garment& garment, const Eigen::Vector3d& offset) {
  for (design::Panel& panel : garment.panels)
    if (panel.placement.kind == design::Placement::Kind::rigid) panel.placement.translation += offset;
}

}  // namespace garment::io
