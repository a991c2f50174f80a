#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/modeller/matching.hpp"
#include "runtime/modeller/pleats.hpp"

namespace garment::modeller {
namespace {

constexpr double kSamePleat = 1e-4;  // of h: places of one pleat
constexpr double kLeastSewn = 1e-7;  // m: shorter sewn lengths are none

bool is_valid(const design::Garment& garment, const design::EdgePart& part) {
  if (part.panel < 0 || part.panel >= static_cast<int>(garment.panels.size())) return false;
  const design::Panel& panel = garment.panels[part.panel];
  const std::size_t n = part.on == design::EdgePart::On::hole   ? panel.hole_edges.size()
                        : part.on == design::EdgePart::On::line ? panel.lines.size()
                                                                : panel.edges.size();
  return part.edge >= 0 && part.edge < static_cast<int>(n) &&
         std::isfinite(part.from) && std::isfinite(part.to);
}

using Stretches = std::vector<std::pair<double, double>>;

/// Stretches of an edge that its pleats take.
Stretches taken_by_pleats(const design::EdgePart& part, const design::Panel& panel) {
  Stretches taken;
  if (part.on == design::EdgePart::On::outline)
    for (const LaidPleat& pleat : laid_pleats(panel))
      if (pleat.edge == part.edge) taken.emplace_back(pleat.from, pleat.to);
  return taken;
}

/// What remains of a part of an edge as drawn without the stretches that are taken in, in walking order.
std::vector<design::EdgePart> without(const design::EdgePart& part, Stretches taken) {
  std::sort(taken.begin(), taken.end());
  std::vector<design::EdgePart> rest;
  double at = std::min(part.from, part.to);
  const double end = std::max(part.from, part.to);
  auto keep = [&](double from, double to) {
    if (to - from <= kLeastSewn) return;
    rest.push_back(part);
    rest.back().from = from;
    rest.back().to = to;
  };
  for (const auto& [from, to] : taken) {
    keep(at, std::min(from, end));
    at = std::max(at, to);
  }
  keep(at, end);
  if (part.from < part.to) return rest;
  std::reverse(rest.begin(), rest.end());
  for (design::EdgePart& some : rest) std::swap(some.from, some.to);
  return rest;
}

/// What remains of a part of an edge once the darts are cut, in walking order. Its ends go to breaks within `snap` spacings.
std::vector<SideSegment> resolve(const design::EdgePart& part, std::vector<BorderPanel>& panels, double snap = kSnap) {
  std::vector<SideSegment> segments;
  BorderPanel& panel = panels[part.panel];
  double low = std::min(part.from, part.to), high = std::max(part.from, part.to);
  for (std::size_t k = 0; k < panel.outline.pieces.size(); ++k) {
    Piece& piece = panel.outline.pieces[k];
    if (piece.edge != part.edge || piece.on != part.on) continue;
    double a = std::max(low, std::min(piece.from, piece.to)),
           b = std::min(high, std::max(piece.from, piece.to));
    if (b - a <= kLeastSewn) continue;
    const double end_a = std::clamp(piece.position(a), 0.0, piece.length()),
                 end_b = std::clamp(piece.position(b), 0.0, piece.length());
    double t_a = break_at(piece, end_a, snap * panel.h), snapped = break_at(piece, end_b, snap * panel.h);
    if (snapped == t_a) {  // a part shorter than the snapping distance stays
      t_a = break_at(piece, end_a, 0);
      snapped = break_at(piece, end_b, 0);
    }
    if (snapped == t_a) continue;
    SideSegment s{part.panel, static_cast<int>(k), t_a, snapped, 0, 1};
    if (part.from > part.to) std::swap(s.t0, s.t1);
    segments.push_back(s);
  }
  auto arc = [&](const SideSegment& s) { return panel.outline.pieces[s.piece].arc(s.t0); };
  std::sort(segments.begin(), segments.end(), [&](const SideSegment& x, const SideSegment& y) {
    return part.from < part.to ? arc(x) < arc(y) : arc(x) > arc(y);
  });
  return segments;
}

void finish(Side& side) {
  side.length = 0;
  for (SideSegment& s : side.segments) {
    s.begin = side.length;
    side.length += s.taken();
  }
}

/// `kind` is what messages call it: a zip is a seam here.
void collect_seam(const design::Garment& garment, const design::Seam& seam, const char* kind, std::vector<BorderPanel>& panels,
                  std::vector<Matching>& result, Findings& findings) {
  Matching matching;
  matching.name = seam.name;
  matching.origin = seam.origin;
  matching.lap = seam.finish.lap;
  matching.slack = seam.finish.slack;
  matching.tension = seam.finish.tension;
  matching.merge = matching.report = !matching.tied();
  matching.rings = std::all_of(seam.sides.begin(), seam.sides.end(), [](const design::SeamSide& side) { return side.closed; });
  for (const design::SeamSide& declared : seam.sides) {
    Side side;
    for (std::size_t k = 0; k < declared.parts.size(); ++k) {
      const design::EdgePart& part = declared.parts[k];
      if (!is_valid(garment, part)) {
        findings.push_back({"G0550",
                            Severity::error,
                            fmt::format("a side of {} `{}` names an edge that does not exist", kind, seam.name),
                            {{declared.origin.value ? declared.origin : seam.origin, ""}},
                            "name edges of declared panels"});
        return;
      }
      for (const design::EdgePart& sewn : without(part, taken_by_pleats(part, garment.panels[part.panel])))
        for (SideSegment s : resolve(sewn, panels)) {
          s.fullness = declared.fullness_of(k);
          side.segments.push_back(s);
        }
    }
    finish(side);
    if (side.length <= kLeastSewn) {
      findings.push_back({"G0550",
                          Severity::error,
                          fmt::format("a side of {} `{}` has no length to sew", kind, seam.name),
                          {{declared.origin.value ? declared.origin : seam.origin, ""}},
                          "sew a part of an edge that has length and is not taken in by a dart"});
      return;
    }
    matching.sides.push_back(std::move(side));
  }
  if (matching.sides.size() < 2) {
    findings.push_back({"G0550",
                        Severity::error,
                        fmt::format("{} `{}` has {} side", kind, seam.name, matching.sides.size()),
                        {{seam.origin, ""}},
                        "a seam joins two sides or more"});
    return;
  }
  result.push_back(std::move(matching));
}

/// Undoes the last `open` of a side, by its sewn length.
void undo_end(Side& side, double open, std::vector<BorderPanel>& panels) {
  const double closed = (1 - open) * side.length;
  while (!side.segments.empty() && side.segments.back().begin >= closed - kLeastSewn) side.segments.pop_back();
  if (!side.segments.empty()) {
    SideSegment& last = side.segments.back();
    const double rest = closed - last.begin, end = last.t0 < last.t1 ? last.t0 + rest : last.t0 - rest;
    if (rest < last.length() - kLeastSewn) {
      Piece& piece = panels[last.panel].outline.pieces[last.piece];
      last.t1 = break_at(piece, end, kSnap * panels[last.panel].h);
      if (last.t1 == last.t0) last.t1 = break_at(piece, end, 0);
    }
  }
  finish(side);
}

/// As far as it is closed, a zip is a seam.
void collect_zip(const design::Garment& garment, const design::Zip& zip, std::vector<BorderPanel>& panels,
                 std::vector<Matching>& result, Findings& findings) {
  design::Seam seam{zip.name, zip.origin, {{zip.side_origin[0], zip.sides[0]}, {zip.side_origin[1], zip.sides[1]}}, {}};
  const std::size_t before = result.size();
  collect_seam(garment, seam, "zip", panels, result, findings);
  if (result.size() == before) return;
  std::vector<Side>& sides = result.back().sides;
  for (Side& side : sides) undo_end(side, std::clamp(zip.open, 0.0, 1.0), panels);
  if (sides[0].length <= kLeastSewn || sides[1].length <= kLeastSewn) result.pop_back();  // wholly open
}

void collect_darts(std::vector<BorderPanel>& panels, std::vector<Matching>& result) {
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const std::vector<Piece>& pieces = panels[p].outline.pieces;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      if (pieces[k].dart < 0 || !pieces[k].towards_apex) continue;
      std::size_t other = (k + 1) % pieces.size();  // the leg back from the apex follows
      const design::EdgeDart& dart = panels[p].panel->darts[pieces[k].dart];
      Matching matching;
      matching.name = panels[p].panel->name + "." + dart.name;
      matching.origin = dart.origin;
      int panel = static_cast<int>(p);
      matching.sides.resize(2);
      matching.sides[0].segments = {{panel, static_cast<int>(k), 0, pieces[k].length(), 0, 1}};
      matching.sides[1].segments = {{panel, static_cast<int>(other), pieces[other].length(), 0, 0, 1}};
      for (Side& side : matching.sides) finish(side);
      result.push_back(std::move(matching));
    }
  }
}

/// The side of two legs of a dart inside.
Side lens_side(int panel, const Outline& outline, std::size_t first, bool forward) {
  Side side;
  for (std::size_t k : {first, first + 1}) {
    const double length = outline.pieces[k].length();
    side.segments.push_back({panel, static_cast<int>(k), forward ? 0 : length, forward ? length : 0, 0, 1});
  }
  if (!forward) std::swap(side.segments[0], side.segments[1]);
  finish(side);
  return side;
}

/// Darts inside: the left side of the lens against its right one, from the first tip.
void collect_inside_darts(std::vector<BorderPanel>& panels, std::vector<Matching>& result) {
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const Outline& outline = panels[p].outline;
    for (std::size_t l = 1; l < outline.loops.size(); ++l) {
      const std::size_t first = outline.begin_of(l);
      if (outline.pieces[first].inside_dart < 0) continue;
      const design::InsideDart& dart = panels[p].panel->inside_darts[outline.pieces[first].inside_dart];
      Matching matching;
      matching.name = panels[p].panel->name + "." + dart.name;
      matching.origin = dart.origin;
      matching.sides = {lens_side(static_cast<int>(p), outline, first, true),
                        lens_side(static_cast<int>(p), outline, first + 2, false)};
      result.push_back(std::move(matching));
    }
  }
}

/// Darts whose legs are drawn: the one leg from the tip against the other.
void collect_leg_darts(std::vector<BorderPanel>& panels, std::vector<Matching>& result) {
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const design::Panel& panel = *panels[p].panel;
    for (const design::LegDart& dart : panel.leg_darts) {
      Matching matching;
      matching.name = panel.name + "." + dart.name;
      matching.origin = dart.origin;
      const design::Edge* legs[2] = {nullptr, nullptr};
      int index[2] = {-1, -1};
      for (std::size_t e = 0; e < panel.edges.size(); ++e)
        for (int k = 0; k < 2; ++k)
          if (panel.edges[e].name == (k == 0 ? dart.leg_a : dart.leg_b)) legs[k] = &panel.edges[e], index[k] = static_cast<int>(e);
      if (legs[0] == nullptr || legs[1] == nullptr) continue;
      // They meet in the tip: drawn towards it is walked backwards.
      const bool a_ends = (legs[0]->curve.end() - legs[1]->curve.start()).norm() <
                          (legs[0]->curve.start() - legs[1]->curve.end()).norm();
      for (int k = 0; k < 2; ++k) {
        const double length = legs[k]->curve.length();
        const bool from_start = (k == 0) != a_ends;
        Side side;
        side.segments = resolve({static_cast<int>(p), index[k], from_start ? 0 : length, from_start ? length : 0}, panels);
        finish(side);
        matching.sides.push_back(std::move(side));
      }
      result.push_back(std::move(matching));
    }
  }
}

/// The part of the sewn edge - pleats folded, darts closed - that begins at `from` and is `length` long, or as far as the edge goes.
std::vector<design::EdgePart> sewn_from(double from, int way, double length, const design::EdgePart& edge,
                                        const design::Panel& panel) {
  design::EdgePart part = edge;
  part.from = from;
  part.to = way > 0 ? design::edge_of(panel, edge).curve.length() : 0;
  std::vector<design::EdgePart> result;
  Stretches taken = taken_by_pleats(edge, panel);
  for (const design::EdgeDart& dart : panel.darts)
    if (dart.edge == panel.edges[edge.edge].name) taken.emplace_back(dart.at - dart.width / 2, dart.at + dart.width / 2);
  for (design::EdgePart some : without(part, taken)) {
    const double has = std::abs(some.to - some.from);
    if (has > length) some.to = some.from + way * length;
    if (length > kLeastSewn) result.push_back(some);
    length -= has;
  }
  return result;
}

Side side_of(const std::vector<design::EdgePart>& parts, std::vector<BorderPanel>& panels) {
  Side side;
  for (const design::EdgePart& part : parts)
    for (const SideSegment& s : resolve(part, panels, kSamePleat)) side.segments.push_back(s);
  finish(side);
  return side;
}

/// What holds pleats: their layers along the edge, and the lines that are stitched down.
void collect_pleats(std::vector<BorderPanel>& panels, std::vector<Matching>& result) {
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const design::Panel& panel = *panels[p].panel;
    const std::vector<LaidPleat> pleats = laid_pleats(panel);
    for (std::size_t k = 0; k < pleats.size(); ++k) {
      const LaidPleat& pleat = pleats[k];
      Matching matching;
      matching.name = panel.name + "." + panel.pleats[pleat.pleat].name;
      matching.origin = panel.pleats[pleat.pleat].origin;
      matching.report = false;
      const design::EdgePart edge{static_cast<int>(p), pleat.edge, 0, 0};
      auto part = [&](double from, double to) {
        design::EdgePart some = edge;
        some.from = from;
        some.to = to;
        return some;
      };
      for (const LaidPleat::Layers& layers : pleat.layers) {
        const std::vector<design::EdgePart> beside = sewn_from(layers.beside, layers.way, pleat.depth, edge, panel);
        double reach = 0;
        for (const design::EdgePart& some : beside) reach += std::abs(some.to - some.from);
        matching.sides.clear();
        if (reach > kLeastSewn) matching.sides.push_back(side_of(beside, panels));
        else reach = pleat.depth;  // at the edge's end: the two layers of the pleat alone
        for (double start : layers.start)
          matching.sides.push_back(side_of({part(start, start + (layers.fold > start ? reach : -reach))}, panels));
        result.push_back(matching);
        if (reach >= pleat.depth - kLeastSewn || matching.sides.size() < 3) continue;
        matching.sides.clear();  // what reaches beyond the edge's end
        for (double start : layers.start)
          matching.sides.push_back(side_of({part(start + (layers.fold > start ? reach : -reach), layers.fold)}, panels));
        result.push_back(matching);
      }
      if (panel.pleats[pleat.pleat].length <= 0) continue;
      matching.sides.clear();
      for (std::size_t l = 0; l < panels[p].outline.lines.size(); ++l) {
        const InnerLine& line = panels[p].outline.lines[l];
        if (line.from > kLeastSewn || line.pleat != static_cast<int>(k) || (!same_place(line.at, pleat.from) && !same_place(line.at, pleat.to))) continue;
        const std::size_t piece = panels[p].outline.begin_of(panels[p].outline.n_closed + l);
        Piece& drawn = panels[p].outline.pieces[piece];
        const double end = std::min(panel.pleats[pleat.pleat].length, drawn.length());
        const double stop = break_at(drawn, end, kSnap * panels[p].h);
        Side side;
        side.segments.push_back({static_cast<int>(p), static_cast<int>(piece), 0, stop, 0, 1});
        finish(side);
        matching.sides.push_back(std::move(side));
      }
      if (matching.sides.size() == 2) result.push_back(matching);
    }
  }
}

void collect_halves(std::vector<BorderPanel>& panels, std::vector<Matching>& result) {
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const Outline& outline = panels[p].outline;
    if (outline.n_half == 0) continue;
    Matching matching;
    matching.name = panels[p].panel->name;
    matching.origin = panels[p].panel->origin;
    matching.merge = matching.report = false;
    matching.sides.resize(2);
    int panel = static_cast<int>(p);
    for (std::size_t k = 0; k < outline.n_half; ++k) {
      std::size_t other = outline.pieces.size() - 1 - k;
      matching.sides[0].segments.push_back({panel, static_cast<int>(k), 0, outline.pieces[k].length(), 0, 1});
      matching.sides[1].segments.push_back(
          {panel, static_cast<int>(other), outline.pieces[other].length(), 0, 0, 1});
    }
    for (Side& side : matching.sides) finish(side);
    result.push_back(std::move(matching));
  }
}

}  // namespace

std::vector<Matching> collect_matchings(const design::Garment& garment, std::vector<BorderPanel>& panels,
                                        Findings& findings) {
  std::vector<Matching> result;
  for (const design::Seam& seam : garment.seams) collect_seam(garment, seam, "seam", panels, result, findings);
  for (const design::Zip& zip : garment.zips) collect_zip(garment, zip, panels, result, findings);
  collect_darts(panels, result);
  collect_leg_darts(panels, result);
  collect_inside_darts(panels, result);
  collect_pleats(panels, result);
  collect_halves(panels, result);
  return result;
}

void break_at_attachments(const design::Garment& garment, std::vector<BorderPanel>& panels) {
  for (const design::Attachment& attachment : garment.attachments)
    for (const design::EdgePart& part : attachment.parts)
      if (is_valid(garment, part)) resolve(part, panels);
}

}  // namespace garment::modeller
