#include "runtime/io/svg_writer.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/base/number.hpp"
#include "runtime/io/cut_lines.hpp"
#include "runtime/io/svg_panel.hpp"

namespace garment::io {
namespace {

constexpr double kBorder = 20;  // mm
constexpr double kGap = 8;      // mm between the rooms of two panels

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

std::vector<std::string> facts_of(const design::Garment& g, const design::Panel& panel,
                                  const model::PanelRange* made) {
  std::vector<std::string> out;
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

/// "A  side_left:  front 573 mm, back 573 mm"
std::string seam_line(const design::Garment& g, std::size_t s) {
  std::string out = seam_letter(s) + "   " + g.seams[s].name + ":   ";
  bool first = true;
  for (const design::SeamSide& side : g.seams[s].sides) {
    double length = 0;
    std::string names;
    for (const design::EdgePart& part : side.parts) {
      if (!known(g, part)) continue;
      length += std::fabs(part.to - part.from);
      const std::string name = g.panels[part.panel].name + "." + design::edge_of(g.panels[part.panel], part).name;
      names += (names.empty() ? "" : " + ") + name;
    }
    out += (first ? "" : "   to   ") + names + " " + millimetres(length);
    first = false;
  }
  return out;
}

/// Rows of panels, the tallest first, wider than high.
struct Layout {
  std::vector<Point> corners;
  Point size{0, 0};
};

Layout lay_out(const std::vector<SvgPanel>& panels) {
  Layout out;
  out.corners.resize(panels.size());
  double area = 0, widest = 0;
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < panels.size(); ++k) {
    area += panels[k].size().prod();
    widest = std::max(widest, panels[k].size()[0]);
    order.push_back(k);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return panels[a].size()[1] > panels[b].size()[1]; });
  const double row_width = std::max(widest, 1.7 * std::sqrt(area));
  Point at(0, 0);
  double row_height = 0;
  for (std::size_t k : order) {
    const Point size = panels[k].size();
    if (at[0] > 0 && at[0] + size[0] > row_width) {
      at = Point(0, at[1] + row_height + kGap);
      row_height = 0;
    }
    out.corners[k] = at;
    row_height = std::max(row_height, size[1]);
    out.size = out.size.cwiseMax(Point(at + size));
    at[0] += size[0] + kGap;
  }
  return out;
}

void draw_scale_bar(SvgPaper& paper, const Point& at) {
  const Pen pen{"#1b1d22", 0.4, "", "none"};
  Pen filled = pen;
  filled.fill = "#1b1d22";
  for (int k = 0; k < 10; ++k) {
    const double x = at[0] + 10 * k;
    paper.polyline({{x, at[1]}, {x + 10, at[1]}, {x + 10, at[1] + 3}, {x, at[1] + 3}}, true,
                   k % 2 == 0 ? filled : pen);
  }
  paper.text(at + Point(0, 7), "0", {4, Anchor::middle, 0, false, "#1b1d22"});
  paper.text(at + Point(100, 7), "100 mm", {4, Anchor::middle, 0, false, "#1b1d22"});
}

std::string write(const design::Garment& g, const model::Model* model) {
  std::vector<std::vector<SeamTag>> tags = tags_by_panel(g);
  std::vector<SvgPanel> panels;
  panels.reserve(g.panels.size());
  for (std::size_t k = 0; k < g.panels.size(); ++k) {
    const design::Panel& panel = g.panels[k];
    const model::PanelRange* made = nullptr;
    if (model)
      for (const model::PanelRange& r : model->panels)
        if (r.name == panel.name) made = &r;
    const bool of_fabric = panel.fabric >= 0 && panel.fabric < static_cast<int>(g.fabrics.size());
    panels.emplace_back(panel, std::move(tags[k]), facts_of(g, panel, made),
                        of_fabric ? g.fabrics[panel.fabric].color : std::array{0.6, 0.6, 0.6});
  }
  SvgPaper paper;
  const Layout layout = lay_out(panels);
  const Point origin(kBorder, kBorder + 22);
  paper.text({kBorder, kBorder + 6}, g.title.empty() ? "pattern" : g.title,
             {11, Anchor::start, 0, true, "#1b1d22"});
  for (std::size_t k = 0; k < panels.size(); ++k) panels[k].draw(paper, origin + layout.corners[k]);
  Point at(kBorder, origin[1] + layout.size[1] + 14);
  draw_scale_bar(paper, at);
  const bool allowed = std::any_of(g.panels.begin(), g.panels.end(),
                                   [](const design::Panel& panel) { return !cut_lines(panel).empty(); });
  paper.text(at + Point(125, 2),
             allowed ? "Thick outlines are stitch lines, thin ones outside cut lines. Lengths in mm."
                     : "Outlines are stitch lines: add seam allowance. Lengths in mm.",
             {4.5, Anchor::start, 0, false, "#3c414b"});
  double width = std::max(layout.size[0], 260.0);
  at[1] += 20;
  for (std::size_t s = 0; s < g.seams.size(); ++s) {
    const std::string line = seam_line(g, s);
    paper.text(at, line, {5, Anchor::start, 0, false, "#1b1d22"});
    width = std::max(width, lettering_width(line, 5));
    at[1] += 7.5;
  }
  return paper.finish(Point(width + 2 * kBorder, at[1] + kBorder), g.title.empty() ? "pattern" : g.title);
}

}  // namespace

std::string write_pattern_svg(const design::Garment& garment) { return write(garment, nullptr); }

std::string write_pattern_svg(const design::Garment& garment, const model::Model& model) {
  return write(garment, &model);
}

}  // namespace garment::io
