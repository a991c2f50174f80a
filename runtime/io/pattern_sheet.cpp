#include "runtime/io/pattern_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/base/number.hpp"
#include "runtime/io/cut_lines.hpp"

namespace garment::io {
namespace {

constexpr double kRoomGap = 8;   // mm between the rooms of two panels
constexpr double kAlike = 1e-4;  // m, by which the sides of a pair may differ

/// A, B, ... Z, AA, AB, ...
std::string seam_letter(std::size_t k) {
  std::string out;
  for (++k; k > 0; k = (k - 1) / 26) out.insert(out.begin(), static_cast<char>('A' + (k - 1) % 26));
  return out;
}

std::string millimetres(double m) { return format_number(std::round(m * 1e4) / 10, 6) + " mm"; }

bool known(const design::Garment& g, const design::EdgePart& part) {
  if (part.panel < 0 || part.panel >= static_cast<int>(g.panels.size()) || part.edge < 0) return false;
  const design::Panel& panel = g.panels[part.panel];
  const auto& edges = part.on == design::EdgePart::On::hole   ? panel.hole_edges
                      : part.on == design::EdgePart::On::line ? panel.lines
                                                              : panel.edges;
  return part.edge < static_cast<int>(edges.size());
}

std::vector<std::vector<SeamTag>> tags_by_panel(const design::Garment& g) {
  std::vector<std::vector<SeamTag>> out(g.panels.size());
  for (std::size_t s = 0; s < g.seams.size(); ++s)
    for (const design::SeamSide& side : g.seams[s].sides)
      for (const design::EdgePart& part : side.parts)
        if (known(g, part) && part.on == design::EdgePart::On::outline)
          out[part.panel].push_back({seam_letter(s), part.edge, part.from, part.to});
  return out;
}

/// `right` is the mirror image of `left`: same names, same lengths, same cloth.
bool mirrored(const design::Panel& left, const design::Panel& right) {
  if (left.edges.size() != right.edges.size() || left.fabric != right.fabric) return false;
  for (const design::Edge& e : left.edges)
    if (std::none_of(right.edges.begin(), right.edges.end(), [&](const design::Edge& o) {
          return o.name == e.name && std::fabs(o.curve.length() - e.curve.length()) < kAlike;
        }))
      return false;
  return true;
}

std::string without_side(const std::string& name, std::string_view side) {
  return name.ends_with(side) ? name.substr(0, name.size() - side.size()) : "";
}

/// Index of the panel that is the other one of a pair; -1 where there is none.
int partner_of(const design::Garment& g, std::size_t k, std::string_view own, std::string_view other) {
  const std::string stem = without_side(g.panels[k].name, own);
  if (stem.empty()) return -1;
  for (std::size_t j = 0; j < g.panels.size(); ++j)
    if (g.panels[j].name == stem + std::string(other) && mirrored(g.panels[k], g.panels[j]))
      return static_cast<int>(j);
  return -1;
}
bool second_of_pair(const design::Garment& g, std::size_t k) {
  return partner_of(g, k, ".right", ".left") >= 0;
}

Point cut_size(const design::Panel& panel) {
  Extent box;
  for (const design::Edge& e : panel.edges)
    for (const design::Point2& p : e.curve.polyline(1e-4)) box.grow(1000 * p);
  for (const CutLine& line : cut_lines(panel))
    for (const design::Point2& p : line) box.grow(1000 * p);
  return panel.edges.empty() ? Point(0, 0) : box.size();
}

std::string fabric_name(const design::Garment& g, const design::Panel& panel) {
  return panel.fabric >= 0 && panel.fabric < static_cast<int>(g.fabrics.size()) ? g.fabrics[panel.fabric].name
                                                                                : "";
}

CutRow row_of(const design::Garment& g, std::size_t k) {
  const design::Panel& panel = g.panels[k];
  const bool pair = partner_of(g, k, ".left", ".right") >= 0;
  return {pair ? without_side(panel.name, ".left") : panel.name, pair ? 2 : 1, pair, fabric_name(g, panel),
          cut_size(panel)};
}

std::vector<std::string> facts_of(const design::Garment& g, const design::Panel& panel,
                                  const model::PanelRange* made, const CutRow& row) {
  std::vector<std::string> out{row.pair ? "cut 2 (a pair)" : "cut " + std::to_string(row.count)};
  if (panel.fabric >= 0 && panel.fabric < static_cast<int>(g.fabrics.size()))
    out.push_back(g.fabrics[panel.fabric].name);
  Extent box;
  for (const design::Edge& e : panel.edges)
    for (const design::Point2& p : e.curve.polyline(1e-4)) box.grow(1000 * p);
  if (!panel.edges.empty())
    out.push_back(format_number(std::round(box.size()[0]), 6) + " x " +
                  format_number(std::round(box.size()[1]), 6) + " mm");
  if (made)
    out.push_back(format_number(made->area * 1e4, 4) + " cm2, " + format_number(made->mass * 1e3, 3) + " g");
  return out;
}

std::string seam_line(const design::Garment& g, std::size_t s) {
  std::string out = seam_letter(s) + "   " + g.seams[s].name + ":   ";
  bool first = true;
  for (const design::SeamSide& side : g.seams[s].sides) {
    double length = 0;
    std::string names;
    for (const design::EdgePart& part : side.parts) {
      if (!known(g, part)) continue;
      length += std::fabs(part.to - part.from);
      const std::string name =
          g.panels[part.panel].name + "." + design::edge_of(g.panels[part.panel], part).name;
      names += (names.empty() ? "" : " + ") + name;
    }
    out += (first ? "" : "   to   ") + names + " " + millimetres(length);
    first = false;
  }
  return out;
}

}  // namespace

std::vector<CutRow> cut_list(const design::Garment& g) {
  std::vector<CutRow> rows;
  for (std::size_t k = 0; k < g.panels.size(); ++k)
    if (!second_of_pair(g, k)) rows.push_back(row_of(g, k));
  return rows;
}

std::vector<std::string> seam_lines(const design::Garment& g) {
  std::vector<std::string> out;
  for (std::size_t s = 0; s < g.seams.size(); ++s) out.push_back(seam_line(g, s));
  return out;
}

std::vector<std::string> cut_lines_of(const design::Garment& g) {
  std::vector<std::string> out;
  for (const CutRow& row : cut_list(g))
    out.push_back(row.piece + ":   cut " + std::to_string(row.count) + (row.pair ? ", a pair" : "") +
                  (row.fabric.empty() ? "" : "   of " + row.fabric) + "   " +
                  format_number(std::round(row.size[0]), 6) + " x " +
                  format_number(std::round(row.size[1]), 6) + " mm");
  return out;
}

PatternSheet::PatternSheet(const design::Garment& g, const model::Model* model, bool plain,
                           double row_width) {
  std::vector<std::vector<SeamTag>> tags = tags_by_panel(g);
  panels_.reserve(g.panels.size());
  double area = 0, widest = 0;
  for (std::size_t k = 0; k < g.panels.size(); ++k) {
    if (plain && second_of_pair(g, k)) continue;
    const design::Panel& panel = g.panels[k];
    const model::PanelRange* made = nullptr;
    if (model)
      for (const model::PanelRange& r : model->panels)
        if (r.name == panel.name) made = &r;
    const bool of_fabric = panel.fabric >= 0 && panel.fabric < static_cast<int>(g.fabrics.size());
    CutRow row = row_of(g, k);
    if (!plain) row.count = 1, row.pair = false;
    panels_.emplace_back(panel, std::move(tags[k]), facts_of(g, panel, made, row),
                         plain       ? std::array{1.0, 1.0, 1.0}
                         : of_fabric ? g.fabrics[panel.fabric].color
                                     : std::array{0.6, 0.6, 0.6});
    has_allowances_ = has_allowances_ || !cut_lines(panel).empty();
    area += panels_.back().size().prod();
    widest = std::max(widest, panels_.back().size()[0]);
  }
  std::vector<std::size_t> order(panels_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return panels_[a].size()[1] > panels_[b].size()[1]; });
  if (row_width <= 0) row_width = 1.7 * std::sqrt(area);
  row_width = std::max(widest, row_width);
  corners_.resize(panels_.size());
  Point at(0, 0);
  double row_height = 0;
  for (std::size_t k : order) {
    const Point size = panels_[k].size();
    if (at[0] > 0 && at[0] + size[0] > row_width) {
      at = Point(0, at[1] + row_height + kRoomGap);
      row_height = 0;
    }
    corners_[k] = at;
    row_height = std::max(row_height, size[1]);
    size_ = size_.cwiseMax(Point(at + size));
    at[0] += size[0] + kRoomGap;
  }
}

void PatternSheet::draw(Paper& paper, const Point& origin) const {
  for (std::size_t k = 0; k < panels_.size(); ++k) panels_[k].draw(paper, origin + corners_[k]);
}

}  // namespace garment::io
