#include "runtime/io/pattern_extension.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "runtime/base/portable_math.hpp"
#include "runtime/io/pattern_document.hpp"
#include "runtime/io/pattern_json.hpp"
#include "runtime/io/pattern_names.hpp"
#include "runtime/io/pattern_stitch.hpp"
#include "runtime/io/pattern_writer.hpp"

namespace garment::io {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::size_t kMostItems = 4096;
constexpr double kDegreesPerRadian = 180 / portable::kPi;

/// Calls `visit(key, number)` for every figure of a fabric, SI.
template <class Fabric, class Visit>
void each_figure(Fabric& f, const Visit& visit) {
  visit("areal_density", f.areal_density);
  visit("thickness", f.thickness);
  for (int d = 0; d < 2; ++d) {
    const std::string way = d == 0 ? "_warp" : "_weft";
    visit("tensile_max_strain" + way, f.tensile[d].max_strain);
    visit("tensile_linearity" + way, f.tensile[d].linearity);
    visit("tensile_max_force" + way, f.tensile[d].max_force);
    visit("tensile_resilience" + way, f.tensile[d].resilience);
    visit("bending_rigidity" + way, f.bending_rigidity[d]);
    visit("bending_friction" + way, f.bending_friction[d]);
  }
  visit("shear_rigidity", f.shear_rigidity);
  visit("shear_friction", f.shear_friction);
  visit("shear_friction_5", f.shear_friction_5);
  visit("twist_rigidity", f.twist_rigidity);
  visit("friction", f.friction);
  visit("damping", f.damping);
}

ordered_json fabric_json(const design::Fabric& fabric) {
  ordered_json out{{"name", fabric.name}};
  if (!fabric.kind.empty()) out["kind"] = fabric.kind;
  if (!fabric.source.empty()) out["source"] = fabric.source;
  each_figure(fabric, [&](const std::string& key, double value) { out[key] = value; });
  ordered_json color = ordered_json::array();  // eight bits each, as a script has them
  for (double channel : fabric.color)
    color.push_back(std::round(std::round(channel * 255) / 255 * 1e4) / 1e4);
  out["color"] = std::move(color);
  return out;
}

/// Place of an arc length of an outline edge in the file: number of its edge, and centimetres from that one's
/// start.
std::optional<std::pair<int, double>> place_in_file(const CutPanel& cut, const WrittenPanel& written,
                                                    int edge, double at) {
  for (std::size_t k = 0; k < cut.edges.size(); ++k) {
    const CutEdge& e = cut.edges[k];
    if (e.edge != edge || e.dart >= 0 || at < e.from - 1e-9 || at > e.to + 1e-9) continue;
    const double along = written.turned[k] ? e.to - at : at - e.from;
    return std::pair(written.edges[k], std::round(along * 1e12) / 1e10);
  }
  return std::nullopt;
}

ordered_json panel_json(const design::Garment& garment, std::size_t p, const CutPanel& cut,
                        const WrittenPanel& written) {
  const design::Panel& panel = garment.panels[p];
  ordered_json out;
  if (panel.fabric >= 0 && panel.fabric < static_cast<int>(garment.fabrics.size()))
    out["fabric"] = garment.fabrics[static_cast<std::size_t>(panel.fabric)].name;
  if (panel.grain_angle != 0)
    out["grain"] = std::round((written.back ? -1 : 1) * panel.grain_angle * kDegreesPerRadian * 1e10) / 1e10;
  ordered_json names = ordered_json::object(), notches = ordered_json::array();
  std::set<std::string> taken;
  for (std::size_t k = 0; k < cut.edges.size(); ++k) {
    const CutEdge& e = cut.edges[k];
    const std::string& name = e.dart >= 0 ? panel.darts[static_cast<std::size_t>(e.dart)].name
                                          : panel.edges[static_cast<std::size_t>(e.edge)].name;
    names[std::to_string(written.edges[k])] = unique_name(identifier(name, "edge"), taken);
  }
  for (const design::Notch& notch : panel.notches)
    if (const int edge = outline_edge(panel, notch.edge); edge >= 0)
      if (const auto place = place_in_file(cut, written, edge, notch.at))
        notches.push_back(
            {{"name", identifier(notch.name, "notch")}, {"edge", place->first}, {"at", place->second}});
  out["edges"] = std::move(names);
  if (!notches.empty()) out["notches"] = std::move(notches);
  return out;
}

const char* relation_of(double ratio) {
  return ratio == 1 ? "plain" : ratio >= 1.5 ? "gather" : ratio > 1 ? "ease" : "stretch";
}

ordered_json block(const design::Garment& garment, const CutGarment& cut, const WrittenPattern& written) {
  ordered_json out{{"edition", 1}};
  ordered_json fabrics = ordered_json::array(), panels = ordered_json::object(),
               seams = ordered_json::array();
  for (const design::Fabric& fabric : garment.fabrics) fabrics.push_back(fabric_json(fabric));
  for (std::size_t p = 0; p < garment.panels.size(); ++p)
    panels[written.panels[p].key] = panel_json(garment, p, cut.panels[p], written.panels[p]);
  for (std::size_t s = 0; s < garment.seams.size(); ++s) {
    const design::Seam& seam = garment.seams[s];
    if (written.stitches[s].empty()) continue;
    const double ratio = seam.ratio.empty() || !std::isfinite(seam.ratio[0]) ? 1 : seam.ratio[0];
    seams.push_back({{"name", identifier(seam.name, "seam")},
                     {"stitches", written.stitches[s]},
                     {"relation", relation_of(ratio)},
                     {"ratio", ratio}});
  }
  out["fabrics"] = std::move(fabrics);
  out["panels"] = std::move(panels);
  out["seams"] = std::move(seams);
  if (const auto lost = not_written(garment, cut); !lost.empty()) out["not_written"] = lost;
  return out;
}

/// Reads the parts of a block, each on its own.
class ExtensionReader {
 public:
  ExtensionReader(const std::vector<FilePanel>& files, const std::vector<std::size_t>& numbers,
                  design::Garment& garment, PatternReport& report)
      : files_(files), numbers_(numbers), garment_(garment), report_(report) {}

  void read(const json& value) {
    if (!value.is_object()) return refuse("the block", value, "an object");
    read_fabrics(member(value, "fabrics"));
    if (const json* panels = member(value, "panels")) {
      if (!panels->is_object()) return refuse("`panels`", *panels, "an object");
      for (std::size_t p = 0; p < files_.size(); ++p)
        if (const json* panel = member(*panels, files_[p].file_name.c_str())) read_panel(*panel, p);
    }
    if (const json* seams = member(value, "seams")) {
      if (!seams->is_array() || seams->size() > kMostItems)
        return refuse("`seams`", *seams, "a list of at most 4096");
      last_.clear();
      for (std::size_t s = 0; s < numbers_.size(); ++s) seam_of_[numbers_[s]] = s;
      for (const design::Seam& seam : garment_.seams) names_.insert(seam.name);
      for (const design::Panel& panel : garment_.panels) names_.insert(panel.name);
      for (const design::Fabric& fabric : garment_.fabrics) names_.insert(fabric.name);
      for (const json& seam : *seams) read_seam(seam);
    }
  }

 private:
  void refuse(const std::string& what, const json& found, const char* expected) {
    report_.warning("G0958",
                    fmt::format("block `{}`: {} is {}, expected {}; it is passed over", kExtension, what,
                                describe(found), expected),
                    "correct it, or remove the block: the pattern itself does not need it");
  }

  static std::optional<std::string> name_in(const json& object) {
    const json* name = member(object, "name");
    if (!name || !name->is_string() || name->get_ref<const std::string&>().size() > 200) return std::nullopt;
    return identifier(name->get_ref<const std::string&>(), "name");
  }

  void read_fabrics(const json* list) {
    if (!list) return;
    if (!list->is_array() || list->empty() || list->size() > 1000)
      return refuse("`fabrics`", *list, "a list of fabrics");
    std::vector<design::Fabric> fabrics;
    for (const json& item : *list) {
      design::Fabric fabric = garment_.fabrics[0];
      const auto name = name_in(item);
      if (!name) return refuse("a fabric", item, "an object with a `name` and figures in SI units");
      fabric.name = *name;
      for (auto [key, text] : {std::pair("kind", &fabric.kind), std::pair("source", &fabric.source)}) {
        const json* words = member(item, key);
        *text = words && words->is_string() ? words->get<std::string>().substr(0, 500) : std::string();
      }
      each_figure(fabric, [&](const std::string& key, double& figure) {
        const json* value = member(item, key.c_str());
        if (!value) return;
        if (value->is_number() && value->get<double>() >= 0 && value->get<double>() < 1e9)
          figure = value->get<double>();
        else
          refuse("`" + key + "`", *value, "a number in SI units");
      });
      if (const json* color = member(item, "color"))
        for (std::size_t c = 0; c < 3; ++c)
          if (auto value = number_at(*color, c, 1)) fabric.color[c] = std::max(0.0, *value);
      fabrics.push_back(std::move(fabric));
    }
    garment_.fabrics = std::move(fabrics);
  }

  /// The outline edge behind a number of the file; -1 and a warning where there is none.
  const FileEdge* edge_at(const json& number, std::size_t p) {
    const auto index = index_below(number, files_[p].edges.size());
    if (index && files_[p].edges[static_cast<std::size_t>(*index)].edge >= 0)
      return &files_[p].edges[static_cast<std::size_t>(*index)];
    refuse("an edge of panel " + in_ticks(files_[p].file_name), number,
           "the number of an edge of some length");
    return nullptr;
  }

  void read_panel(const json& value, std::size_t p) {
    design::Panel& panel = garment_.panels[p];
    if (const json* fabric = member(value, "fabric"))
      for (std::size_t f = 0; f < garment_.fabrics.size(); ++f)
        if (*fabric == garment_.fabrics[f].name) panel.fabric = static_cast<int>(f);
    if (const json* grain = member(value, "grain");
        grain && grain->is_number() && std::fabs(grain->get<double>()) <= 360)
      panel.grain_angle = (files_[p].back ? -1 : 1) * grain->get<double>() / kDegreesPerRadian;
    if (const json* names = member(value, "edges"); names && names->is_object()) name_edges(*names, p);
    const json* notches = member(value, "notches");
    if (!notches) return;
    if (!notches->is_array() || notches->size() > kMostItems)
      return refuse("`notches`", *notches, "a list of at most 4096");
    last_.clear();
    std::set<std::string> taken;
    for (const design::Edge& edge : panel.edges) taken.insert(edge.name);
    for (const json& item : *notches) {
      const auto name = name_in(item);
      const json *number = member(item, "edge"), *at = member(item, "at");
      if (!name || !number || !at || !at->is_number())
        return refuse("a notch", item, "an object of `name`, `edge` and `at`");
      const FileEdge* edge = edge_at(*number, p);
      if (!edge) continue;
      const design::Edge& on = panel.edges[static_cast<std::size_t>(edge->edge)];
      const double length = on.curve.length(), along = at->get<double>() / 100;
      if (!(along >= -1e-6 && along <= length + 1e-6)) {
        refuse("`at` of a notch", *at, "centimetres along its edge");
        continue;
      }
      const double place = std::clamp(edge->turned ? length - along : along, 0.0, length);
      panel.notches.push_back({fresh(*name, taken), {}, on.name, place});
    }
  }

  void name_edges(const json& names, std::size_t p) {
    design::Panel& panel = garment_.panels[p];
    std::set<std::string> taken;
    std::vector<std::string> named(panel.edges.size());
    last_.clear();
    for (std::size_t i = 0; i < files_[p].edges.size(); ++i) {
      const json* name = member(names, std::to_string(i).c_str());
      const int edge = files_[p].edges[i].edge;
      if (edge < 0 || !name || !name->is_string()) continue;
      named[static_cast<std::size_t>(edge)] =
          fresh(identifier(name->get<std::string>().substr(0, 200), "edge"), taken);
    }
    for (std::size_t e = 0; e < named.size(); ++e)
      panel.edges[e].name = named[e].empty() ? fresh(panel.edges[e].name, taken) : named[e];
  }

  void read_seam(const json& value) {
    const auto name = name_in(value);
    const json *stitches = member(value, "stitches"), *ratio = member(value, "ratio");
    if (!name || !stitches || !stitches->is_array())
      return refuse("a seam", value, "an object of `name`, `stitches` and `ratio`");
    for (const json& number : *stitches) {
      const auto found =
          number.is_number_unsigned() ? seam_of_.find(number.get<std::size_t>()) : seam_of_.end();
      if (found == seam_of_.end()) continue;
      design::Seam& seam = garment_.seams[found->second];
      names_.erase(seam.name);
      seam.name = fresh(*name, names_);
      // The lengths decide which side is the longer; only a relation that they bear out is taken.
      const double stated_one = ratio && ratio->is_number() ? ratio->get<double>() : 0;
      const double length = seam_length(seam, 0), other = seam_length(seam, 1);
      if (stated_one >= 1 && std::fabs(length - stated_one * other) <= kPlainSeam) seam.ratio[0] = stated_one;
      seam_of_.erase(found);
    }
  }

  static double seam_length(const design::Seam& seam, std::size_t side) {
    return std::fabs(seam.sides[side].parts[0].to - seam.sides[side].parts[0].from);
  }

  /// As unique_name, but quick where thousands have one name: numbers go on from the last one given.
  std::string fresh(const std::string& base, std::set<std::string>& taken) {
    if (taken.insert(base).second) return base;
    int& last = last_[base];
    std::string name;
    do name = fmt::format("{}_{}", base, last = std::max(last, 1) + 1);
    while (!taken.insert(name).second);
    return name;
  }

  const std::vector<FilePanel>& files_;
  const std::vector<std::size_t>& numbers_;
  design::Garment& garment_;
  PatternReport& report_;
  std::map<std::size_t, std::size_t> seam_of_;  // by stitch
  std::set<std::string> names_;                 // of the whole garment
  std::map<std::string, int> last_;
};

/// Without the names of edges and seams.
json nameless(json block) {
  for (json& panel : block["panels"]) panel.erase("edges");
  for (json& seam : block["seams"]) seam.erase("name");
  return block;
}

}  // namespace

void add_extension(ordered_json& root, const design::Garment& garment, const CutGarment& cut,
                   const WrittenPattern& written, const json* stated, bool from_elsewhere) {
  ordered_json mine = block(garment, cut, written);
  if (!stated) {
    PatternOptions options;
    options.fabric = import_fabric();
    options.keep_layout = false;
    const PatternResult read = read_pattern(root.dump(-1, ' ', true), options);
    if (read.garment && read.garment->panels.size() == garment.panels.size() &&
        read.garment->seams.size() == garment.seams.size()) {
      bool same = true;
      for (std::size_t p = 0; p < garment.panels.size(); ++p)
        same = same && read.garment->panels[p].edges.size() == garment.panels[p].edges.size();
      if (same) {
        json one = mine, other = block(*read.garment, cut_garment(*read.garment), written);
        if (from_elsewhere) one = nameless(std::move(one)), other = nameless(std::move(other));
        if (same_numbers(one, other, 1e-7)) return;
      }
    }
  }
  root[kExtension] = std::move(mine);
}

std::vector<std::string> not_written(const design::Garment& garment, const CutGarment& cut) {
  std::vector<std::string> lost;
  auto add = [&](const char* word, const auto& list) {
    for (const auto& item : list) lost.push_back(fmt::format("{} {}", word, item.name));
  };
  for (int s : cut.left_out) lost.push_back("seam " + garment.seams[static_cast<std::size_t>(s)].name);
  for (const design::Panel& panel : garment.panels) {
    auto add_inside = [&](const char* word, const auto& list) {
      for (const auto& item : list) lost.push_back(fmt::format("{} {}.{}", word, panel.name, item.name));
    };
    add_inside("hole", panel.holes);
    add_inside("line", panel.lines);
    add_inside("point", panel.points);
    add_inside("slit", panel.slits);
    add_inside("dart", panel.inside_darts);
    add_inside("pleat", panel.pleats);
    for (const design::Edge& edge : panel.edges)
      if (edge.allowance > 0) {
        lost.push_back("the allowances of " + panel.name);
        break;
      }
    if (panel.placement.kind == design::Placement::Kind::on_part ||
        panel.placement.kind == design::Placement::Kind::around)
      lost.push_back(fmt::format("the place of {} on {}", panel.name, panel.placement.body));
  }
  add("hem", garment.hems);
  add("tack", garment.tacks);
  add("button", garment.buttons);
  add("zip", garment.zips);
  add("region", garment.regions);
  add("layer", garment.layers);
  add("pad", garment.pads);
  for (const design::Press& press : garment.presses) lost.push_back("iron " + press.name);
  return lost;
}

void read_extension(const json& root, const std::vector<FilePanel>& files,
                    const std::vector<std::size_t>& numbers, design::Garment& garment,
                    PatternReport& report) {
  if (const json* value = member(root, kExtension))
    ExtensionReader(files, numbers, garment, report).read(*value);
}

}  // namespace garment::io
