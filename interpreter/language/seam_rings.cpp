// Where closed seams begin.
#include "interpreter/language/seam_rings.hpp"

#include <algorithm>
#include <cmath>

#include "interpreter/language/edges.hpp"

namespace garment::interpreter {
namespace {

using design::EdgePart;
using design::Point2;
using design::SeamSide;

constexpr double kOnRing = 1e-3;  // m: a place this near is on the ring

/// Makes the side begin with its part `first`.
void turn(SeamSide& side, std::size_t first) {
  const auto by = static_cast<std::ptrdiff_t>(first);
  std::rotate(side.parts.begin(), side.parts.begin() + by, side.parts.end());
  if (!side.fullness.empty())
    std::rotate(side.fullness.begin(), side.fullness.begin() + by, side.fullness.end());
}

/// Cuts part `k` at arc length `s` of its edge.
void cut(SeamSide& side, std::size_t k, double s) {
  EdgePart rest = side.parts[k];
  side.parts[k].to = rest.from = s;
  side.parts.insert(side.parts.begin() + static_cast<std::ptrdiff_t>(k) + 1, rest);
  if (!side.fullness.empty())
    side.fullness.insert(side.fullness.begin() + static_cast<std::ptrdiff_t>(k), side.fullness[k]);
}

/// Turns the ring to begin at one of the corners; false if none is on it.
bool begin_at_corner(SeamCorners& corners, SeamSide& side, const std::vector<std::size_t>& wanted) {
  for (std::size_t k = 0; k < side.parts.size(); ++k) {
    const std::size_t corner = corners.of(side.parts[k], false);
    if (std::find(wanted.begin(), wanted.end(), corner) == wanted.end()) continue;
    turn(side, k);
    return true;
  }
  return false;
}

bool begin_at_point(const Program& program, SeamSide& side, int panel, const Point2& p) {
  for (std::size_t k = 0; k < side.parts.size(); ++k) {
    const EdgePart part = side.parts[k];
    if (part.panel != panel) continue;
    const geometry::Curve& curve =
        design::edge_of(program.panels[static_cast<std::size_t>(panel)].panel, part).curve;
    const double s = curve.nearest(p);
    if ((curve.point_at(s) - p).norm() > kOnRing) continue;
    const double low = std::min(part.from, part.to), high = std::max(part.from, part.to);
    if (s < low - kOnRing || s > high + kOnRing) continue;
    if (std::fabs(s - part.from) < kOnRing) return turn(side, k), true;
    if (std::fabs(s - part.to) < kOnRing) return turn(side, (k + 1) % side.parts.size()), true;
    cut(side, k, s);
    return turn(side, k + 1), true;
  }
  return false;
}

std::vector<std::size_t> ends_of(SeamCorners& corners, const std::vector<EdgePart>& parts) {
  return {corners.of(parts.front(), false), corners.of(parts.back(), true)};
}

bool begin_at(Program& program, SeamCorners& corners, SeamSide& side, const SeamStart& start) {
  if (start.panel >= 0) return begin_at_point(program, side, start.panel, start.point);
  if (start.zip >= 0) {
    const design::Zip& zip = program.garment.zips[static_cast<std::size_t>(start.zip)];
    return !zip.sides[0].empty() && begin_at_corner(corners, side, ends_of(corners, zip.sides[0]));
  }
  const SeamInfo& other = program.seams[static_cast<std::size_t>(start.seam)];
  return other.ready && begin_at_corner(corners, side, ends_of(corners, other.seam.sides[0].parts));
}

/// A whole loop without any corner, from where it was drawn: nothing but the drawing says where it begins.
bool is_round(const Program& program, const SeamSide& side) {
  const EdgePart& first = side.parts.front();
  const geometry::Curve& curve =
      design::edge_of(program.panels[static_cast<std::size_t>(first.panel)].panel, first).curve;
  if (first.from > kOnRing && first.from < curve.length() - kOnRing)
    return false;                     // a part was named: its start is meant
  constexpr double kSmooth = 0.9998;  // cosine of about 1 deg
  double length = 0;
  for (const EdgePart& part : side.parts) length += std::fabs(part.to - part.from);
  if (length < 10 * kOnRing) return false;  // a crumb of an edge, whose ends are one corner
  for (std::size_t k = 0; k < side.parts.size(); ++k) {
    const EdgePart &a = side.parts[k], &b = side.parts[(k + 1) % side.parts.size()];
    if (a.panel != b.panel || a.on != b.on) return false;
    const design::Panel& panel = program.panels[static_cast<std::size_t>(a.panel)].panel;
    auto way = [&](const EdgePart& part, double s) {
      const Point2 t = design::edge_of(panel, part).curve.tangent_at(s);
      return part.to >= part.from ? t : Point2(-t);
    };
    const Point2 end = design::edge_of(panel, a).curve.point_at(a.to),
                 begin = design::edge_of(panel, b).curve.point_at(b.from);
    if ((end - begin).norm() > kOnRing || way(a, a.to).dot(way(b, b.from)) < kSmooth) return false;
  }
  return true;
}

}  // namespace

void settle_rings(Program& program, SeamCorners& corners, SeamInfo& info) {
  std::vector<SeamSide>& sides = info.seam.sides;
  std::vector<char> settled(sides.size(), 0);
  for (const SeamStart& start : info.starts) {
    bool met = false;
    for (std::size_t k = 0; k < sides.size(); ++k)
      if (sides[k].closed && !settled[k] && begin_at(program, corners, sides[k], start)) settled[k] = 1, met = true;
    if (met) continue;
    const bool any = std::any_of(sides.begin(), sides.end(), [](const SeamSide& s) { return s.closed; });
    Message message("G0512",
                    any ? "no ring of seam `" + info.seam.name + "` passes `" +
                              std::string(program.sources.text(start.span)) + "`"
                        : "seam `" + info.seam.name + "` has no closed side that could start there",
                    start.span);
    report(program,
           message.help(any ? "name a seam or zip that ends on the ring, or a notch of its edges"
                            : "a side is closed where its end is its start, or another seam or a zip joins "
                              "them; open sides start where they are drawn"));
    return;
  }
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (!sides[k].closed || settled[k] || !is_round(program, sides[k])) continue;
    report(program, Message("G0511",
                            "the ring `" + show(Value{info.sides[k]}) + "` of seam `" + info.seam.name +
                                "` has no corner: nothing says where it starts",
                            info.spans[k])
                        .help("put a notch on it and add `start at PANEL.NOTCH`"));
    return;
  }
}

}  // namespace garment::interpreter
