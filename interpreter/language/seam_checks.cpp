// Checks that need all seams: chains meet, rings close.
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "interpreter/language/edges.hpp"
#include "interpreter/language/parts.hpp"
#include "interpreter/language/seam_rings.hpp"
#include "interpreter/language/seams.hpp"

namespace garment::interpreter {
namespace {

using design::EdgePart;
using design::Point2;

constexpr double kOneCorner = 1e-3;  // m, points of a panel this near are one corner

}  // namespace

std::size_t SeamCorners::of_point(int panel, const Point2& p) {
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (points_[k].first == panel && (points_[k].second - p).norm() < kOneCorner) return root(k);
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

std::string name_of_part(const Program& program, const EdgePart& part) {
  const design::Panel& panel = program.panels[static_cast<std::size_t>(part.panel)].panel;
  return panel.name + '.' + design::edge_of(panel, part).name;
}

namespace {

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

void join_sides(SeamCorners& corners, const SeamInfo& info) {
  for (const design::SeamSide& side : info.seam.sides) join_ends(corners, side.parts, info.seam.sides[0].parts);
}

bool is_ring(SeamCorners& corners, const std::vector<EdgePart>& parts) {
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (corners.of(parts[k], true) != corners.of(parts[(k + 1) % parts.size()], false)) return false;
  return true;
}

/// Joins the corners where seams begin and end. Where a ring that says `start at` begins is not known before it is settled:
/// till then its ends join nothing, or the place where a side happens to begin would pass for a place on the others.
/// Returns the seams settled so.
std::set<const SeamInfo*> join_seams(Program& program, SeamCorners& corners) {
  std::vector<SeamInfo*> waiting;
  for (SeamInfo& info : program.seams) {
    if (!info.ready) continue;
    if (info.starts.empty())
      join_sides(corners, info);
    else
      waiting.push_back(&info);
  }
  std::set<const SeamInfo*> settled;
  auto settle = [&](SeamInfo* info) {
    for (design::SeamSide& side : info->seam.sides) {
      side.closed = is_ring(corners, side.parts);
      if (!side.closed) return false;
    }
    PartGuard guard(program, info->part);
    settle_rings(program, corners, *info);
    join_sides(corners, *info);
    settled.insert(info);
    return true;
  };
  for (std::size_t before = waiting.size() + 1; waiting.size() < before && !program.has_error;) {
    before = waiting.size();
    std::erase_if(waiting, settle);
  }
  for (const SeamInfo* info : waiting) join_sides(corners, *info);
  return settled;
}

}  // namespace

void check_chains(Program& program) {
  SeamCorners corners(program);
  for (std::size_t p = 0; p < program.panels.size(); ++p) corners.join_legs(static_cast<int>(p));
  for (const design::Zip& zip : program.garment.zips)
    if (!zip.sides[0].empty() && !zip.sides[1].empty()) join_ends(corners, zip.sides[0], zip.sides[1]);
  const std::set<const SeamInfo*> settled = join_seams(program, corners);
  for (SeamInfo& info : program.seams) {
    if (!info.ready || settled.contains(&info)) continue;
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

}  // namespace garment::interpreter
