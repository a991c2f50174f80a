#include "runtime/io/dxf_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "runtime/base/number.hpp"
#include "runtime/io/dxf_panel.hpp"
#include "runtime/io/dxf_piece.hpp"
#include "runtime/io/flat_layout.hpp"
#include "runtime/io/pattern_names.hpp"

namespace garment::io {
namespace {

using design::Panel;

/// Metres a unit of the file is, and what it is called.
struct Unit {
  double metres = 1e-3;
  const char* name = "mm";
};
constexpr Unit kUnits[] = {
    {1e-3, "mm"}, {1e-2, "cm"}, {0.0254, "inch"}, {1, "m"}, {1e-4, "tenths of a millimetre"}};
constexpr double kSmallest = 0.15, kLargest = 4;  // m: what the largest piece of a style measures

void scale(DxfPiece& piece, double factor) {
  for (auto& [layer, list] : piece.courses)
    for (DxfCourse& c : list)
      for (DxfVertex& v : c.points) v.point *= factor;
  for (auto& [layer, list] : piece.points)
    for (Point2& p : list) p *= factor;
}

class DxfReader {
 public:
  explicit DxfReader(const DxfOptions& options) : options_(options) {}

  DxfResult read(std::string_view bytes) {
    DxfResult result;
    if (const auto document = parse_dxf(bytes, options_.limits, report_)) {
      DxfStyle style = dxf_style(*document, options_.limits, report_);
      result.sizes = style.sizes;
      if (report_.errors() == 0) result.garment = garment_of(*document, std::move(style));
    }
    if (report_.errors() > 0) result.garment.reset();
    result.findings = report_.take_findings();
    result.notes = report_.take_notes();
    return result;
  }

 private:
  static std::string said(const std::map<std::string, std::string>& facts, const char* key) {
    const auto found = facts.find(key);
    return found == facts.end() ? std::string() : found->second;
  }

  std::optional<design::Garment> garment_of(const DxfDocument& document, DxfStyle style) {
    if (style.pieces.empty()) {
      report_.error(
          "G0968",
          fmt::format(
              "no pattern piece in the file ({} blocks, {} other entities), expected a boundary on layer 1",
              document.blocks.size(), document.entities.size()),
          "is this an AAMA or ASTM file? other drawings can come as SVG");
      return std::nullopt;
    }
    const double factor = unit(document, style).metres;
    const auto size = chosen_size(style);
    if (!size) return std::nullopt;
    if (const std::string name = said(style.facts, "style name"); !name.empty())
      report_.note("style " + in_ticks(name));
    if (!size->empty()) report_.note(fmt::format("size {} of {}", in_ticks(*size), style.sizes.size()));
    design::Garment garment;
    garment.title = options_.title;
    garment.fabrics.push_back(options_.fabric);
    std::set<std::string> taken{options_.fabric.name};
    for (DxfPiece& piece : style.pieces) {
      if (!piece.size.empty() && piece.size != *size) continue;
      if (garment.panels.size() >= options_.max_panels) {
        report_.error("G0962", fmt::format("line {}: more than {} pieces", piece.line, options_.max_panels),
                      "is this the right file?");
        return std::nullopt;
      }
      scale(piece, factor);
      const std::map<std::string, std::string> facts = piece.facts;
      const std::string name = piece.name;
      auto panel = read_dxf_piece(std::move(piece), report_);
      if (!panel) continue;
      panel->name = unique_name(identifier(name, "piece"), taken);
      panel->resolution = options_.resolution;
      tell(name, panel->name, facts);
      garment.panels.push_back(std::move(*panel));
    }
    if (garment.panels.empty()) {
      report_.error("G0968", "no piece of the file has an outline that can be read",
                    "see the warnings above");
      return std::nullopt;
    }
    tell_passed_over(document);
    lay_flat(garment);
    return garment;
  }

  void tell_passed_over(const DxfDocument& document) {
    std::size_t all = 0;
    std::string kinds;
    for (const auto& [kind, number] : document.passed_over) {
      all += number;
      kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", number, in_ticks(kind));
    }
    if (all > 0)
      report_.warning("G0969",
                      fmt::format("{} of the file {} of kinds that are not read: {}; expected lines, polylines, arcs, "
                                  "ellipses, splines, points and texts",
                                  all == 1 ? "1 entity" : fmt::format("{} entities", all), all == 1 ? "is" : "are",
                                  kinds),
                      "where they are part of a piece, explode them before the export");
  }

  void tell(const std::string& name, const std::string& panel,
            const std::map<std::string, std::string>& facts) {
    std::string words;
    for (const char* key : {"quantity", "category", "fabric", "material", "annotation"})
      if (const std::string value = said(facts, key); !value.empty())
        words += fmt::format(", {} {}", key, in_ticks(value));
    if (panel != name || !words.empty())
      report_.note(fmt::format("panel {}: piece {}{}", panel, in_ticks(name), words));
  }

  Unit unit(const DxfDocument& document, const DxfStyle& style) {
    std::vector<Unit> choices;
    auto add = [&](const char* name) {
      for (const Unit& u : kUnits)
        if (std::string_view(name) == u.name) choices.push_back(u);
    };
    const std::string stated = lower(said(style.facts, "units"));
    if (stated.find("english") != std::string::npos || stated.find("imperial") != std::string::npos ||
        stated.find("inch") != std::string::npos)
      add("inch");
    else if (stated == "cm" || stated.find("centi") != std::string::npos)
      add("cm");
    else if (!stated.empty())
      add("mm");
    auto variable = [&](const char* name) {
      const auto found = document.header.find(name);
      return found == document.header.end() ? -1 : found->second;
    };
    const double units = variable("$INSUNITS"), measurement = variable("$MEASUREMENT");
    if (units == 1) add("inch");
    if (units == 4) add("mm");
    if (units == 5) add("cm");
    if (units == 6) add("m");
    if (measurement == 0) add("inch");
    const std::size_t stated_ones = choices.size();
    for (const Unit& u : kUnits) choices.push_back(u);
    double largest = 0;
    for (const DxfPiece& piece : style.pieces) {
      Point2 low(1e300, 1e300), high(-1e300, -1e300);
      for (DxfLayer layer : {DxfLayer::boundary, DxfLayer::sew})
        if (const auto found = piece.courses.find(layer); found != piece.courses.end())
          for (const DxfCourse& c : found->second)
            for (const DxfVertex& v : c.points) low = low.cwiseMin(v.point), high = high.cwiseMax(v.point);
      if (high.x() >= low.x()) largest = std::max(largest, (high - low).maxCoeff());
    }
    std::size_t best = 0;
    while (best < choices.size() &&
           !(largest * choices[best].metres >= kSmallest && largest * choices[best].metres <= kLargest))
      ++best;
    if (best == choices.size()) {
      report_.warning("G0966",
                      fmt::format("the largest piece measures {} units of the file, which is no garment's in "
                                  "any unit; {} are taken",
                                  format_number(largest, 4), choices[0].name),
                      "state `Units: METRIC` (millimetres) or `Units: ENGLISH` (inches)");
      best = 0;
    } else if (best > 0 || stated_ones == 0) {
      report_.warning(
          "G0966",
          fmt::format("the unit of the file is {}, and its largest piece measures {} units; {} are taken",
                      stated_ones > 0 ? fmt::format("stated as {}", choices[0].name) : "not stated",
                      format_number(largest, 4), choices[best].name),
          "state `Units: METRIC` (millimetres) or `Units: ENGLISH` (inches)");
    } else {
      report_.note(fmt::format("a unit of the file is 1 {}", choices[0].name));
    }
    return choices[best];
  }

  std::optional<std::string> chosen_size(const DxfStyle& style) {
    if (style.sizes.empty()) {
      if (options_.size.empty()) return std::string();
    } else {
      for (const std::string& wanted :
           {options_.size, options_.size.empty() ? said(style.facts, "sample size") : std::string(),
            options_.size.empty() ? said(style.facts, "base size") : std::string()})
        for (const std::string& size : style.sizes)
          if (!wanted.empty() && lower(size) == lower(wanted)) return size;
    }
    if (options_.size.empty()) {
      if (style.sizes.size() > 1)
        report_.warning("G0967",
                        fmt::format("the file has {} sizes and none that is its sample size; {} is taken",
                                    style.sizes.size(), in_ticks(style.sizes[style.sizes.size() / 2])),
                        "choose one with --size; --sizes lists them");
      return style.sizes[style.sizes.size() / 2];
    }
    std::string known;
    for (std::size_t i = 0; i < style.sizes.size() && i < 30; ++i)
      known += (i > 0 ? ", " : "") + in_ticks(style.sizes[i]);
    report_.error("G0967",
                  fmt::format("size {} is not in the file, expected {}", in_ticks(options_.size),
                              known.empty() ? "none: it has no sizes" : "one of " + known),
                  "--sizes lists the sizes of a file");
    return std::nullopt;
  }

  const DxfOptions& options_;
  PatternReport report_;
};

}  // namespace

DxfResult read_dxf(std::string_view bytes, const DxfOptions& options) {
  return DxfReader(options).read(bytes);
}

}  // namespace garment::io
