// Checks that need all seams: chains meet, nothing is left unsewn by mistake.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "interpreter/language/edges.hpp"
#include "interpreter/language/parts.hpp"
#include "interpreter/language/seam_rings.hpp"
#include "interpreter/language/seams.hpp"

namespace garment::interpreter {
namespace {

using design::EdgePart;
using design::Point2;

constexpr double kSame = 1e-3;    // m, points of a panel this near are one corner
constexpr double kUnsewn = 2e-3;  // m of an edge that may stay unsewn unsaid

}  // namespace

std::size_t SeamCorners::of_point(int panel, const Point2& p) {
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (points_[k].first == panel && (points_[k].second - p).norm() < kSame) return root(k);
  points_.emplace_back(panel, p);
  parent_.push_back(points_.size() - 1);
  return points_.size() - 1;
}

std::size_t SeamCorners::of(const EdgePart& part, bool at_end) {
  const design::Panel& panel = program_.panels[static_cast<std::size_t>(part.panel)].panel;
  return of_point(part.panel, design::edge_of(panel, part).curve.point_at(at_end ? part.to : part.from));
}

void SeamCorners::join_legs(int panel) {
  const design::Panel& p = program_.panels[static_cast<std::size_t>(panel)].panel;
  for (const design::LegDart& dart : p.leg_darts)
    for (std::size_t k = 0; k < p.edges.size(); ++k) {
      const std::size_t next = (k + 1) % p.edges.size();
      const std::string &one = p.edges[k].name, &two = p.edges[next].name;
      if (!(one == dart.leg_a && two == dart.leg_b) && !(one == dart.leg_b && two == dart.leg_a)) continue;
      const EdgePart in{panel, static_cast<int>(k), 0, p.edges[k].curve.length()};
      const EdgePart out{panel, static_cast<int>(next), 0, p.edges[next].curve.length()};
      join(of(in, false), of(out, true));
    }
}

void SeamCorners::join(std::size_t a, std::size_t b) {
  a = root(a);
  b = root(b);
  if (a != b) parent_[std::max(a, b)] = std::min(a, b);
}

std::size_t SeamCorners::root(std::size_t k) const {
  while (parent_[k] != k) k = parent_[k];
  return k;
}

namespace {

std::string name_of_part(const Program& program, const EdgePart& part) {
  const design::Panel& panel = program.panels[static_cast<std::size_t>(part.panel)].panel;
  return panel.name + '.' + design::edge_of(panel, part).name;
}

void check_links(Program& program, SeamCorners& corners, const SeamInfo& info, std::size_t side) {
  const std::vector<EdgePart>& parts = info.seam.sides[side].parts;
  for (std::size_t k = 0; k + 1 < parts.size(); ++k) {
    if (corners.of(parts[k], true) == corners.of(parts[k + 1], false)) continue;
    const bool turned = corners.of(parts[k], true) == corners.of(parts[k + 1], true) ||
                        corners.of(parts[k], false) == corners.of(parts[k + 1], false);
    // Sides after the first run against the way they are written.
    const EdgePart& first = side > 0 ? parts[k + 1] : parts[k];
    const EdgePart& second = side > 0 ? parts[k] : parts[k + 1];
    report(
        program,
        Message("G0503",
                "in seam `" + info.seam.name + "` the end of `" + name_of_part(program, first) +
                    "` does not meet the start of `" + name_of_part(program, second) + "`",
                info.spans[side])
            .help(turned ? "walk one of them the other way: put `-` before it"
                         : "links must meet where another seam joins them; is their order right, or a seam "
                           "between them missing?"));
    return;
  }
}

/// Ends that come together because the two sides of a seam or zip do.
void join_ends(SeamCorners& corners, const std::vector<EdgePart>& a, const std::vector<EdgePart>& b) {
  corners.join(corners.of(a.front(), false), corners.of(b.front(), false));
  corners.join(corners.of(a.back(), true), corners.of(b.back(), true));
}

struct Interval {
  double from, to;
  int seam;
};

/// By panel, kind of edge and index there.
using Cover = std::map<std::array<int, 3>, std::vector<Interval>>;

std::array<int, 3> key_of(const EdgePart& part) { return {part.panel, static_cast<int>(part.on), part.edge}; }

void cover(Cover& all, const EdgePart& part, int seam) {
  all[key_of(part)].push_back({std::min(part.from, part.to), std::max(part.from, part.to), seam});
}

/// Length of an edge that nothing covers; the mouths of darts count as covered.
double uncovered(const PanelInfo& info, const EdgePart& part, std::vector<Interval> covers) {
  const design::Edge& e = design::edge_of(info.panel, part);
  for (const design::EdgeDart& dart : info.panel.darts)
    if (dart.edge == e.name) covers.push_back({dart.at - dart.width / 2, dart.at + dart.width / 2, -1});
  for (const design::LegDart& dart : info.panel.leg_darts)
    if (dart.leg_a == e.name || dart.leg_b == e.name) covers.push_back({0, e.curve.length(), -1});
  std::sort(covers.begin(), covers.end(),
            [](const Interval& a, const Interval& b) { return a.from < b.from; });
  double open = 0, reached = 0;
  for (const Interval& c : covers) {
    open += std::max(0.0, c.from - reached);
    reached = std::max(reached, c.to);
  }
  return open + std::max(0.0, e.curve.length() - reached);
}

void warn_sewn_twice(Program& program, const Cover& all) {
  for (const auto& [key, covers] : all)
    for (std::size_t i = 0; i < covers.size(); ++i)
      for (std::size_t j = i + 1; j < covers.size(); ++j) {
        const Interval &a = covers[i], &b = covers[j];
        if (a.seam < 0 || b.seam < 0 || a.seam == b.seam) continue;
        if (std::min(a.to, b.to) - std::max(a.from, b.from) < kUnsewn) continue;
        const SeamInfo &one = program.seams[static_cast<std::size_t>(a.seam)],
                       &two = program.seams[static_cast<std::size_t>(b.seam)];
        const std::string edge =
            name_of_part(program, {key[0], key[2], 0, 0, static_cast<EdgePart::On>(key[1])});
        PartGuard guard(program, two.part);
        report(program, Message("G0508",
                                "edge `" + edge + "` is sewn by seam `" + one.seam.name + "` and by seam `" +
                                    two.seam.name + "`",
                                two.spans[0])
                            .also(one.spans[0], "first here")
                            .help("one seam may have more than two sides: `seam NAME: A to B to C`")
                            .warning());
      }
}

}  // namespace

void check_chains(Program& program) {
  SeamCorners corners(program);
  for (std::size_t p = 0; p < program.panels.size(); ++p) corners.join_legs(static_cast<int>(p));
  for (const SeamInfo& info : program.seams)
    for (const design::SeamSide& side : info.seam.sides)
      if (info.ready) join_ends(corners, side.parts, info.seam.sides[0].parts);
  for (const design::Zip& zip : program.garment.zips)
    if (!zip.sides[0].empty() && !zip.sides[1].empty()) join_ends(corners, zip.sides[0], zip.sides[1]);
  for (SeamInfo& info : program.seams) {
    if (!info.ready) continue;
    PartGuard guard(program, info.part);
    for (std::size_t k = 0; k < info.seam.sides.size(); ++k) {
      design::SeamSide& side = info.seam.sides[k];
      check_links(program, corners, info, k);
      side.closed = corners.of(side.parts.front(), false) == corners.of(side.parts.back(), true);
    }
    if (!program.has_error) settle_rings(program, corners, info);
  }
  if (!program.has_error) check_twists(program);
}

void check_unsewn(Program& program) {
  Cover all;
  for (std::size_t k = 0; k < program.seams.size(); ++k)
    for (const design::SeamSide& side : program.seams[k].seam.sides)
      for (const EdgePart& part : side.parts) cover(all, part, static_cast<int>(k));
  warn_sewn_twice(program, all);
  for (const design::Attachment& attachment : program.garment.attachments)
    for (const EdgePart& part : attachment.parts) cover(all, part, -1);
  for (const design::Hem& hem : program.garment.hems)
    for (const EdgePart& part : hem.parts) cover(all, part, -1);
  for (const design::Zip& zip : program.garment.zips)
    for (const std::vector<EdgePart>& side : zip.sides)
      for (const EdgePart& part : side) cover(all, part, -1);
  for (std::size_t p = 0; p < program.panels.size(); ++p) {
    const PanelInfo& info = program.panels[p];
    PartGuard guard(program, info.part);
    auto open_length = [&](const NamedEdge& edge) {
      double open = 0;
      for (const EdgePart& part : edge.parts) {
        if (part.on == EdgePart::On::line || design::edge_of(info.panel, part).free) continue;
        const auto covers = all.find(key_of(part));
        open += uncovered(info, part, covers == all.end() ? std::vector<Interval>{} : covers->second);
      }
      return open;
    };
    auto is_whole = [](const NamedEdge& edge, double open) {
      double length = 0;
      for (const EdgePart& part : edge.parts) length += std::fabs(part.to - part.from);
      return open > length - kUnsewn;
    };
    auto warn = [&](const NamedEdge& edge, const std::string& half, double open) {
      if (open <= kUnsewn) return;
      const std::string name = info.panel.name + '.' + (half.empty() ? "" : half + '.') + edge.name;
      report(program,
             Message("G0505",
                     (is_whole(edge, open) ? "edge `" : format_quantity(open, kLength) + " of edge `") +
                         name + "` is neither sewn nor attached",
                     edge.span)
                 .warning()
                 .help("sew it, attach it, or mark it `free`"));
    };
    for (const NamedEdge& edge : info.edges) {
      if (edge.half == "right" || (edge.half.empty() && info.folded)) continue;
      const double open = open_length(edge);
      const NamedEdge* twin = edge.half.empty() ? nullptr : find_edge(info, "right", edge.name);
      const double other = twin == nullptr ? 0 : open_length(*twin);
      if (twin != nullptr && is_whole(edge, open) && is_whole(*twin, other)) {
        warn(edge, "", open);  // both halves alike are said once
        continue;
      }
      warn(edge, edge.half, open);
      if (twin != nullptr) warn(*twin, "right", other);
    }
  }
}

}  // namespace garment::interpreter
