#include "interpreter/language/unparse_seam.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "interpreter/language/unparse_cloth.hpp"

namespace garment::interpreter::text {
namespace {

using design::EdgePart;

/// A link of a side: its part and how full it is sewn in.
struct Link {
  EdgePart part;
  double fullness = 1;
};
using Links = std::vector<Link>;

constexpr double kSliver = 1e-8;  ///< m; shorter rests of an edge are none

bool counter_clockwise(const design::Panel& panel) {
  double area = 0;
  for (const design::Edge& edge : panel.edges) area += edge.curve.area_term();
  return area > 0;
}

/// True where the part walks its loop counter-clockwise.
bool with_loop(const design::Garment& garment, const EdgePart& part) {
  const design::Panel& panel = garment.panels[part.panel];
  const bool drawn = part.from < part.to;
  if (part.on == EdgePart::On::line) return drawn;
  if (part.on == EdgePart::On::outline) return drawn == counter_clockwise(panel);
  double area = 0;  // round a hole the cloth lies to the left of the clockwise way
  for (const design::Hole& hole : panel.holes)
    for (int k = hole.first; k < hole.first + hole.count; ++k)
      if (part.edge >= hole.first && part.edge < hole.first + hole.count) area += panel.hole_edges[k].curve.area_term();
  return drawn == (area < 0);
}

void turn_round(Links& links) {
  std::reverse(links.begin(), links.end());
  for (Link& link : links) std::swap(link.part.from, link.part.to);
}

/// Links in the order written, each counter-clockwise unless it has a minus.
std::string chain(const design::Garment& garment, const Names& names, const Links& links) {
  std::string text;
  for (std::size_t i = 0; i < links.size(); ++i)
    text += fmt::format("{}{}{}", i > 0 ? " + " : "", with_loop(garment, links[i].part) ? "" : "-",
                        edge_part(garment, names, links[i].part));
  return text;
}

/// " ease 5%", " gather 1.8", " stretch 10%" or nothing, for a side that is `ratio` times as long as the
/// last.
std::string relation(double ratio) {
  if (!std::isfinite(ratio) || ratio <= 0 || std::abs(ratio - 1) < 1e-12) return {};
  if (ratio >= 1.5) return " gather " + number(ratio);
  if (ratio > 1) return fmt::format(" ease {}%", number(std::round((ratio - 1) * 1e12) / 1e10));
  return fmt::format(" stretch {}%", number(std::round((1 / ratio - 1) * 1e12) / 1e10));
}

/// " ease 6% [5 cm .. 12 cm]" for each run of links with a fullness of its own.
std::string part_relations(const Links& links) {
  std::string text;
  double at = 0;
  for (std::size_t i = 0; i < links.size();) {
    const double fullness = links[i].fullness, from = at;
    for (; i < links.size() && links[i].fullness == fullness; ++i)
      at += std::abs(links[i].part.to - links[i].part.from);
    if (std::abs(fullness - 1) < 1e-12) continue;
    text += fmt::format("{} [{} .. {}]", relation(fullness), from <= kSliver ? "start" : length(from),
                        i == links.size() ? "end" : length(at));
  }
  return text;
}

}  // namespace

std::string edge_part(const design::Garment& garment, const Names& names, const EdgePart& part) {
  std::string name = fmt::format("{}.{}", names.panels[part.panel], edge_name(names, part));
  double from = std::min(part.from, part.to), to = std::max(part.from, part.to);
  double whole = design::edge_of(garment.panels[part.panel], part).curve.length();
  bool at_start = from <= kSliver, at_end = to >= whole - kSliver;
  if (at_start && at_end) return name;
  return fmt::format("{}[{} .. {}]", name, at_start ? "start" : length(from), at_end ? "end" : length(to));
}

std::string seam(const design::Garment& garment, const Names& names, std::size_t index) {
  const design::Seam& seam = garment.seams[index];
  std::vector<Links> sides;
  for (const design::SeamSide& side : seam.sides) {
    Links& links = sides.emplace_back();
    for (std::size_t k = 0; k < side.parts.size(); ++k) links.push_back({side.parts[k], side.fullness_of(k)});
  }
  // The rule walks the first side with its loop; turning all sides round at once changes nothing.
  if (!sides.empty() && !sides[0].empty() && !with_loop(garment, sides[0][0].part))
    for (Links& links : sides) turn_round(links);

  bool on_a_line = false;
  for (const Links& links : sides)
    for (const Link& link : links) on_a_line = on_a_line || link.part.on == EdgePart::On::line;

  std::string text = fmt::format("seam {}:", names.seams[index]);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i].empty()) continue;
    // Later sides are written with their loops too, and the seam runs them from the end to the start.
    // Where a line is sewn to, it runs them from start to end.
    const bool with = with_loop(garment, sides[i][0].part), reversed = i > 0 && with != on_a_line;
    if (i > 0 && !with) turn_round(sides[i]);
    text += fmt::format("{} {}", i > 0 ? " to" : "", chain(garment, names, sides[i]));
    const std::string parts = part_relations(sides[i]);
    if (!parts.empty())
      text += parts;
    else if (i + 1 < sides.size() && i < seam.ratio.size())
      text += relation(seam.ratio[i]);
    if (reversed) text += " reversed";
  }
  return text + finish_clauses(garment, names, seam);
}

}  // namespace garment::interpreter::text
