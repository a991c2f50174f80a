#include "runtime/io/pattern_layout.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "runtime/base/number.hpp"
#include "runtime/io/pattern_document.hpp"
#include "runtime/io/pattern_writer.hpp"

namespace garment::io {
namespace {

using nlohmann::json;

bool has_pairs(const json& panels) {
  for (const json& panel : panels)
    for (const json& edge : panel.at("edges"))
      if (const json* curvature = member(edge, "curvature"); curvature && !curvature->is_null())
        return curvature->is_array();
  return false;
}

PanelLayout panel_layout(const json& value, const FilePanel& file, const std::string& name) {
  PanelLayout layout;
  layout.panel = name;
  layout.key = file.file_name;
  layout.back = file.back;
  layout.vertices = value.at("vertices");
  const json& edges = value.at("edges");
  for (std::size_t i = 0; i < file.edges.size(); ++i) {
    const json& ends = edges[i].at("endpoints");
    layout.edges.push_back(
        {ends[0].get<int>(), ends[1].get<int>(), file.edges[i].edge, file.edges[i].turned});
    json words = edges[i];
    words.erase("endpoints");
    layout.words.push_back(std::move(words));
  }
  layout.rest = value;
  layout.rest.erase("vertices");
  layout.rest.erase("edges");
  for (const char* key : {"translation", "rotation"})
    if (!layout.rest.contains(key)) layout.rest[key] = nullptr;
  return layout;
}

/// The stitch's first side is the seam's second.
bool is_swapped(const json& stitch, const design::Seam& seam, const std::vector<FilePanel>& panels) {
  const design::EdgePart& first = seam.sides[0].parts[0];
  const FilePanel& panel = panels[static_cast<std::size_t>(first.panel)];
  return stitch[0].at("panel") != panel.file_name ||
         panel.edges[stitch[0].at("edge").get<std::size_t>()].edge != first.edge;
}

/// Nothing but what a writer would give: two sides of two members, perhaps the third item.
bool is_plain(const json& stitch) {
  return stitch.size() >= 2 && stitch[0].is_object() && stitch[0].size() == 2 && stitch[1].is_object() &&
         stitch[1].size() == 2;
}

/// Vertices 0, 1, 2, ... with edge i from i to i + 1, all of them in the outline as drawn.
bool is_standard(const PanelLayout& layout) {
  const int n = static_cast<int>(layout.edges.size());
  for (int i = 0; i < n; ++i) {
    const EdgeLayout& e = layout.edges[static_cast<std::size_t>(i)];
    if (e.start != i || e.end != (i + 1) % n || e.outline != i || e.turned) return false;
  }
  return layout.vertices.size() == layout.edges.size();
}

/// Drops from `words` what is said the same, to the digits that a script keeps, in `plain`.
void drop_same(json& words, const json& plain, const char* key) {
  if (!words.contains(key) || !plain.contains(key)) return;
  const json &a = words[key], &b = plain[key];
  if (same_numbers(a, b, 1e-9)) words.erase(key);
}

json panel_line(PanelLayout layout, const json& plain) {
  json line{{"panel", layout.panel}};
  if (layout.key != layout.panel) line["key"] = layout.key;
  if (layout.back) line["back"] = true;
  if (!is_standard(layout)) {
    json edges = json::array();
    for (const EdgeLayout& e : layout.edges)
      edges.push_back(e.turned ? json{e.start, e.end, e.outline, "turned"} : json{e.start, e.end, e.outline});
    line["edges"] = std::move(edges);
    line["vertices"] = layout.vertices.size();
  }
  json at = json::object(), words = json::object();
  for (std::size_t v = 0; v < layout.vertices.size(); ++v)
    if (!same_numbers(layout.vertices[v], plain.at("vertices")[v], 1e-7))
      at[std::to_string(v)] = layout.vertices[v];
  for (std::size_t e = 0; e < layout.edges.size(); ++e) {
    json own = layout.words[e];
    const json& written = plain.at("edges")[e];
    if (!is_circle(written)) drop_same(own, written, "curvature");
    if (!own.empty()) words[std::to_string(e)] = std::move(own);
  }
  if (!at.empty()) line["at"] = std::move(at);
  if (!words.empty()) line["words"] = std::move(words);
  for (const char* key : {"translation", "label"}) drop_same(layout.rest, plain, key);
  // Half turns are the same either way round: a rounded matrix cannot say which was meant.
  const json* turn = member(layout.rest, "rotation");
  bool half_turns = !turn || !turn->is_array();
  for (std::size_t i = 0; i < 3 && !half_turns; ++i) half_turns = !number_at(*turn, i, 179);
  if (!half_turns) drop_same(layout.rest, plain, "rotation");
  if (!layout.rest.empty()) line["rest"] = std::move(layout.rest);
  return line;
}

/// A whole number from `low` up to below `high`, or nothing.
std::optional<int> whole(const json& value, int low, int high) {
  if (!value.is_number_integer()) return std::nullopt;
  const auto number = value.get<std::int64_t>();
  if (number < low || number >= high) return std::nullopt;
  return static_cast<int>(number);
}

constexpr int kMostEdges = 4096;

bool read_edges(const json& list, PanelLayout& layout) {
  for (const json& item : list) {
    if (!item.is_array() || item.size() < 3) return false;
    auto start = whole(item[0], 0, kMostEdges), end = whole(item[1], 0, kMostEdges),
         outline = whole(item[2], -1, kMostEdges);
    if (!start || !end || !outline) return false;
    layout.edges.push_back({*start, *end, *outline, item.size() > 3});
  }
  return layout.edges.size() <= static_cast<std::size_t>(kMostEdges);
}

/// Puts the members of `sparse`, numbered by their keys, into `list`.
void fill(const json& line, const char* key, json& list) {
  const json* sparse = member(line, key);
  if (!sparse || !sparse->is_object()) return;
  for (const auto& [number, value] : sparse->items())
    if (const auto i = parse_number(number); i && *i >= 0 && *i < static_cast<double>(list.size()))
      list[static_cast<std::size_t>(*i)] = value;
}

std::optional<PanelLayout> panel_of_line(const json& line) {
  PanelLayout layout;
  layout.panel = layout.key = line.at("panel").get<std::string>();
  if (const json* key = member(line, "key"); key && key->is_string()) layout.key = key->get<std::string>();
  const json* back = member(line, "back");
  layout.back = back && *back == true;
  if (const json* edges = member(line, "edges")) {
    const json* count = member(line, "vertices");
    auto n = count ? whole(*count, 0, kMostEdges + 1) : std::nullopt;
    if (!edges->is_array() || !n || !read_edges(*edges, layout)) return std::nullopt;
    for (const EdgeLayout& e : layout.edges)
      if (e.start >= *n || e.end >= *n) return std::nullopt;
    layout.vertices = json(static_cast<std::size_t>(*n), nullptr);
    layout.words = json(layout.edges.size(), json::object());
  } else {
    // As many as the garment has: the writer makes them.
    layout.vertices = nullptr;
    layout.words = json::object();
    for (const char* key : {"at", "words"})
      if (const json* sparse = member(line, key); sparse && sparse->is_object())
        (key[0] == 'a' ? layout.vertices : layout.words) = *sparse;
  }
  if (layout.vertices.is_array()) {
    fill(line, "at", layout.vertices);
    fill(line, "words", layout.words);
  }
  if (const json* rest = member(line, "rest"); rest && rest->is_object()) layout.rest = *rest;
  return layout;
}

void read_file_line(const json& line, PatternLayout& layout) {
  layout.root = line.at("file");
  if (const json* pairs = member(line, "pairs")) layout.pairs = *pairs == true;
  if (const json* raised = member(line, "raised"); raised && raised->is_number())
    layout.raised = raised->get<double>();
  if (const json* properties = member(layout.root, "properties")) {
    const json* scale = member(*properties, "units_in_meter");
    if (scale && scale->is_number() && scale->get<double>() >= 1e-3 && scale->get<double>() <= 1e6)
      layout.units.per_metre = scale->get<double>();
    const json* coords = member(*properties, "curvature_coords");
    layout.units.relative_curves = !coords || *coords != "absolute";
  }
  const json* stitches = member(line, "stitches");
  if (!stitches || !stitches->is_array()) return;
  for (const json& item : *stitches) {
    StitchLayout stitch;
    if (const json* seam = member(item, "seam"); seam && seam->is_string())
      stitch.seam = seam->get<std::string>();
    if (const json* swapped = member(item, "swapped")) stitch.swapped = *swapped == true;
    if (const json* words = member(item, "words")) stitch.words = *words;
    layout.stitches.push_back(std::move(stitch));
  }
}

}  // namespace

PatternLayout pattern_layout(const json& root, const PatternUnits& units,
                             const std::vector<FilePanel>& panels, const design::Garment& garment,
                             const std::vector<std::size_t>& numbers) {
  PatternLayout layout;
  layout.units = units;
  layout.root = root;
  const json& pattern = root.at("pattern");
  layout.root["pattern"].erase("panels");
  layout.pairs = has_pairs(pattern.at("panels"));
  for (std::size_t p = 0; p < panels.size(); ++p)
    layout.panels.push_back(
        panel_layout(pattern.at("panels").at(panels[p].file_name), panels[p], garment.panels[p].name));
  const json* stitches = member(pattern, "stitches");
  if (!stitches) return layout;
  layout.root["pattern"]["stitches"] = json::array();
  for (const json& stitch : *stitches) layout.stitches.push_back({"", false, stitch});
  for (std::size_t s = 0; s < numbers.size(); ++s) {
    StitchLayout& stitch = layout.stitches[numbers[s]];
    stitch.seam = garment.seams[s].name;
    stitch.swapped = is_swapped(stitch.words, garment.seams[s], panels);
  }
  return layout;
}

std::vector<std::string> layout_lines(const PatternLayout& layout, const design::Garment& garment) {
  PatternLayout bare = layout;  // the structure without the file's numbers: what would be written then?
  for (PanelLayout& panel : bare.panels) {
    for (json& vertex : panel.vertices) vertex = nullptr;
    for (json& words : panel.words) words = json::object();
    panel.rest = json::object();
  }
  const json plain = json::parse(write_pattern_json(garment, &bare).text).at("pattern").at("panels");
  std::vector<std::string> lines;
  json file{{"file", layout.root}};
  if (layout.pairs) file["pairs"] = true;
  if (layout.raised != 0) file["raised"] = layout.raised;
  json stitches = json::array();
  bool as_sewn = layout.stitches.size() == garment.seams.size();
  for (std::size_t s = 0; s < layout.stitches.size(); ++s) {
    const StitchLayout& stitch = layout.stitches[s];
    json item = json::object();
    if (!stitch.seam.empty()) item["seam"] = stitch.seam;
    if (stitch.swapped) item["swapped"] = true;
    if (stitch.seam.empty() || !is_plain(stitch.words)) item["words"] = stitch.words;
    as_sewn = as_sewn && !stitch.swapped && !item.contains("words") && stitch.seam == garment.seams[s].name;
    stitches.push_back(std::move(item));
  }
  if (!as_sewn) file["stitches"] = std::move(stitches);
  lines.push_back(file.dump(-1, ' ', true));
  for (const PanelLayout& panel : layout.panels) {
    if (!plain.contains(panel.key)) continue;
    const json line = panel_line(panel, plain.at(panel.key));
    if (line.size() > 1) lines.push_back(line.dump(-1, ' ', true));
  }
  return lines;
}

PatternLayout layout_of_script(std::string_view script, bool& found) {
  PatternLayout layout;
  found = false;
  while (!script.empty()) {
    const std::size_t end = std::min(script.find('\n'), script.size());
    std::string_view text = script.substr(0, end);
    script.remove_prefix(std::min(end + 1, script.size()));
    if (!text.starts_with(kLayoutMark)) continue;
    text.remove_prefix(kLayoutMark.size());
    PatternLimits limits;
    PatternReport ignored;
    auto document = parse_pattern_document(text, limits, ignored);
    if (!document || !document->root.is_object()) continue;
    const json& line = document->root;
    if (const json* file = member(line, "file"); file && file->is_object()) {
      read_file_line(line, layout);
      found = true;
    } else if (const json* panel = member(line, "panel"); panel && panel->is_string()) {
      if (auto one = panel_of_line(line)) layout.panels.push_back(std::move(*one));
    }
  }
  return layout;
}

}  // namespace garment::io
