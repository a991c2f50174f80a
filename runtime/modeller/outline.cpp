#include "runtime/modeller/outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/base/number.hpp"
#include "runtime/geometry/gauss.hpp"
#include "runtime/modeller/crossing.hpp"

namespace garment::modeller {
namespace {

using geometry::cross;

/// Ends that lie closer than this meet, m: below what any pattern file resolves, far above rounding.
constexpr double kMeet = 1e-5;
constexpr double kNear = 0.02;  // of h: what lies this near to a border or line lies on it
constexpr double kJoin = 0.2;  // of h: lines join the border at a particle this near

std::string mm(double metres) { return format_number(metres * 1000, 4) + " mm"; }

bool is_finite(const geometry::Curve& c) {
  return c.start().allFinite() && c.end().allFinite() && std::isfinite(c.length()) &&
         std::isfinite(c.area_term());
}

/// A dart in arc lengths of its edge as drawn.
struct Mouth {
  int dart;
  double from, to;
  Point2 apex;
};

void report(Findings& findings, const char* code, OriginId origin, std::string message, std::string help) {
  findings.push_back({code, Severity::error, std::move(message), {{origin, ""}}, std::move(help)});
}

bool check_loop(const design::Panel& panel, Findings& findings) {
  if (panel.edges.empty()) {
    report(findings, "G0454", panel.origin, fmt::format("panel `{}` has no edges", panel.name),
           "draw its outline");
    return false;
  }
  for (std::size_t i = 0; i < panel.edges.size(); ++i) {
    const design::Edge& edge = panel.edges[i];
    const design::Edge& next = panel.edges[(i + 1) % panel.edges.size()];
    if (!is_finite(edge.curve)) {
      report(findings, "G0454", edge.origin,
             fmt::format("edge `{}` of panel `{}` has no finite shape", edge.name, panel.name),
             "check its points");
      return false;
    }
    double gap = (edge.curve.end() - next.curve.start()).norm();
    if (!(gap <= kMeet)) {
      report(findings, "G0454", edge.origin,
             fmt::format(
                 "edge `{}` of panel `{}` ends {} from the start of edge `{}`; an outline is one closed loop",
                 edge.name, panel.name, mm(gap), next.name),
             "let every edge start where the one before it ends");
      return false;
    }
  }
  return true;
}

/// Darts per edge, ascending along it; `left_is_inside` says on which side of the drawn edges the panel lies.
bool collect_mouths(const design::Panel& panel, bool left_is_inside, std::vector<std::vector<Mouth>>& mouths,
                    Findings& findings) {
  mouths.assign(panel.edges.size(), {});
  for (std::size_t d = 0; d < panel.darts.size(); ++d) {
    const design::EdgeDart& dart = panel.darts[d];
    std::size_t e = 0;
    while (e < panel.edges.size() && panel.edges[e].name != dart.edge) ++e;
    if (e == panel.edges.size()) {
      report(findings, "G0453", dart.origin,
             fmt::format("dart `{}` opens on edge `{}`, which panel `{}` does not have", dart.name, dart.edge,
                         panel.name),
             "name an edge of the panel");
      return false;
    }
    const geometry::Curve& curve = panel.edges[e].curve;
    double from = dart.at - dart.width / 2, to = dart.at + dart.width / 2, length = curve.length();
    if (!(dart.width > 0) || !(from > -kMeet) || !(to < length + kMeet)) {
      report(findings, "G0453", dart.origin,
             fmt::format("the mouth of dart `{}` reaches from {} to {} on edge `{}`, which is {} long",
                         dart.name, mm(from), mm(to), dart.edge, mm(length)),
             "move the dart or make it narrower");
      return false;
    }
    from = std::max(from, 0.0);
    to = std::min(to, length);
    Point2 tangent = curve.tangent_at(dart.at), inwards(-tangent.y(), tangent.x());
    if (!left_is_inside) inwards = -inwards;
    Point2 apex = dart.apex ? *dart.apex : Point2(curve.point_at(dart.at) + dart.depth * inwards);
    Point2 chord = curve.point_at(to) - curve.point_at(from);
    double side = cross(chord, apex - curve.point_at(from));
    if (!apex.allFinite() || !((left_is_inside ? side : -side) > kMeet * chord.norm())) {
      report(findings, "G0453", dart.origin,
             fmt::format("the point of dart `{}` does not lie inside panel `{}`", dart.name, panel.name),
             "give the dart a positive depth, or a point on the panel's side of the edge");
      return false;
    }
    mouths[e].push_back({static_cast<int>(d), from, to, apex});
  }
  for (std::vector<Mouth>& on_edge : mouths) {
    std::sort(on_edge.begin(), on_edge.end(), [](const Mouth& a, const Mouth& b) { return a.from < b.from; });
    for (std::size_t k = 1; k < on_edge.size(); ++k) {
      if (on_edge[k].from >= on_edge[k - 1].to - 1e-12) continue;
      const design::EdgeDart &a = panel.darts[on_edge[k - 1].dart], &b = panel.darts[on_edge[k].dart];
      report(findings, "G0453", b.origin,
             fmt::format("the mouths of darts `{}` and `{}` overlap by {}", a.name, b.name,
                         mm(on_edge[k - 1].to - on_edge[k].from)),
             "move them apart or make one narrower");
      return false;
    }
  }
  return true;
}

Piece make_leg(const Point2& a, const Point2& b, int dart, bool towards_apex) {
  Piece leg;
  leg.curve = geometry::Curve(a, b);
  leg.dart = dart;
  leg.towards_apex = towards_apex;
  leg.to = leg.curve.length();
  return leg;
}

/// Appends what is left of edge `e`, with its darts, in walking order.
void append_edge(const design::Panel& panel, int e, bool forward, const std::vector<Mouth>& mouths,
                 std::vector<Piece>& pieces) {
  const geometry::Curve& curve = panel.edges[e].curve;
  double at = forward ? 0 : curve.length();
  auto walk_to = [&](double arc) {
    if (std::abs(arc - at) > kMeet) {
      Piece piece;
      piece.curve = curve;
      piece.edge = e;
      piece.from = at;
      piece.to = arc;
      pieces.push_back(std::move(piece));
    }
    at = arc;
  };
  for (std::size_t k = 0; k < mouths.size(); ++k) {
    const Mouth& m = mouths[forward ? k : mouths.size() - 1 - k];
    double near = forward ? m.from : m.to, far = forward ? m.to : m.from;
    walk_to(near);
    pieces.push_back(make_leg(curve.point_at(near), m.apex, m.dart, true));
    pieces.push_back(make_leg(m.apex, curve.point_at(far), m.dart, false));
    at = far;
  }
  walk_to(forward ? curve.length() : 0);
}

/// The loop of a hole, with the cloth to the left: clockwise. Gives the area that it cuts away, m^2.
double append_hole(const design::Panel& panel, const design::Hole& hole, Outline& outline) {
  double area = 0;
  for (int k = 0; k < hole.count; ++k) area += panel.hole_edges[hole.first + k].curve.area_term();
  outline.loops.push_back(outline.pieces.size());
  for (int k = 0; k < hole.count; ++k) {
    Piece piece;
    piece.edge = hole.first + (area < 0 ? k : hole.count - 1 - k);
    piece.on = design::EdgePart::On::hole;
    piece.curve = panel.hole_edges[piece.edge].curve;
    (area < 0 ? piece.to : piece.from) = piece.curve.length();
    outline.pieces.push_back(std::move(piece));
  }
  return std::abs(area);
}

/// The lens of a dart inside: from its first tip along its left side to the other tip, and back along its right side.
double append_lens(const design::InsideDart& dart, int index, Outline& outline) {
  const Point2 along = (dart.to - dart.from).normalized(), left(-along.y(), along.x());
  const Point2 widest = dart.from + dart.at * (dart.to - dart.from);
  const Point2 corners[] = {dart.from, widest + dart.width / 2 * left, dart.to, widest - dart.width / 2 * left};
  outline.loops.push_back(outline.pieces.size());
  for (int k = 0; k < 4; ++k) {
    Piece leg = make_leg(corners[k], corners[(k + 1) % 4], -1, false);
    leg.inside_dart = index;
    outline.pieces.push_back(std::move(leg));
  }
  return 0.5 * dart.width * (dart.to - dart.from).norm();
}

bool check_lens(const design::Panel& panel, const design::InsideDart& dart, Findings& findings) {
  if (dart.width > 0 && dart.at > 0 && dart.at < 1 && (dart.to - dart.from).norm() > kMeet) return true;
  report(findings, "G0453", dart.origin, fmt::format("dart `{}` inside panel `{}` has no extent", dart.name, panel.name),
         "give it two tips, a width, and a widest place between the tips");
  return false;
}

/// A piece as a polyline, with the position of every point.
struct Trace {
  std::vector<Point2> at;
  std::vector<double> t;
  Point2 low{1e300, 1e300}, high{-1e300, -1e300};

  bool may_meet(const Trace& other, double reach) const {
    return ((low - other.high).array() <= reach).all() && ((other.low - high).array() <= reach).all();
  }
};

Trace trace_of(const Piece& piece, double h) {
  Trace trace;
  const double length = piece.length();
  const int n = piece.straight() ? 1 : std::max(8, static_cast<int>(std::ceil(length / (h / 20))));
  for (int i = 0; i <= n; ++i) {
    trace.t.push_back(length * i / n);
    trace.at.push_back(piece.at(trace.t.back()));
    trace.low = trace.low.cwiseMin(trace.at.back());
    trace.high = trace.high.cwiseMax(trace.at.back());
  }
  return trace;
}

/// Nearest place of a trace to `p`: distance and position.
std::pair<double, double> nearest(const Trace& trace, const Point2& p) {
  double best = 1e300, t = 0;
  for (std::size_t k = 0; k + 1 < trace.at.size(); ++k) {
    const Point2 way = trace.at[k + 1] - trace.at[k];
    const double share = std::clamp((p - trace.at[k]).dot(way) / std::max(1e-300, way.squaredNorm()), 0.0, 1.0);
    const double distance = (trace.at[k] + share * way - p).norm();
    if (distance >= best) continue;
    best = distance;
    t = trace.t[k] + share * (trace.t[k + 1] - trace.t[k]);
  }
  return {best, t};
}

/// Where two traces cross: positions on both.
std::vector<std::pair<double, double>> crossings(const Trace& a, const Trace& b) {
  std::vector<std::pair<double, double>> result;
  for (std::size_t i = 0; i + 1 < a.at.size(); ++i) {
    const Point2 low = a.at[i].cwiseMin(a.at[i + 1]), high = a.at[i].cwiseMax(a.at[i + 1]);
    if (((low - b.high).array() > 0).any() || ((b.low - high).array() > 0).any()) continue;
    for (std::size_t j = 0; j + 1 < b.at.size(); ++j) {
      const Point2 u = a.at[i + 1] - a.at[i], v = b.at[j + 1] - b.at[j], off = b.at[j] - a.at[i];
      const double det = cross(u, v);
      if (det == 0) continue;
      const double s = cross(off, v) / det, r = cross(off, u) / det;
      if (s < 0 || s >= 1 || r < 0 || r >= 1) continue;
      result.emplace_back(a.t[i] + s * (a.t[i + 1] - a.t[i]), b.t[j] + r * (b.t[j + 1] - b.t[j]));
    }
  }
  return result;
}

/// Breaks both pieces at a place that they share.
void join(std::size_t a, double t_a, std::size_t b, double t_b, double tolerance, Outline& outline) {
  const double at_a = break_at(outline.pieces[a], t_a, tolerance), at_b = break_at(outline.pieces[b], t_b, tolerance);
  outline.joints.push_back({{a, b}, {at_a, at_b}});
}

/// Finds where the lines begin and end on the border or on other lines, and where they cross.
void join_lines(double h, Outline& outline) {
  const std::size_t first = outline.n_closed < outline.loops.size() ? outline.loops[outline.n_closed] : outline.pieces.size();
  if (first == outline.pieces.size()) return;
  const double near = kNear * h, snap = kJoin * h;
  std::vector<Trace> traces;
  for (const Piece& piece : outline.pieces) traces.push_back(trace_of(piece, h));
  for (std::size_t line = first; line < outline.pieces.size(); ++line) {
    const double length = outline.pieces[line].length();
    for (std::size_t other = 0; other < outline.pieces.size(); ++other) {
      if (other == line || !traces[line].may_meet(traces[other], near)) continue;
      for (int e = 0; e < 2; ++e) {  // ends that lie on the other one
        const Point2 end = e == 0 ? traces[line].at.front() : traces[line].at.back();
        const auto [distance, t] = nearest(traces[other], end);
        if (distance <= near) join(other, t, line, e == 0 ? 0 : length, snap, outline);
      }
      if (other < first || other > line) continue;
      for (const auto& [t_line, t_other] : crossings(traces[line], traces[other]))
        if (t_line > snap && t_line < length - snap && t_other > snap && t_other < outline.pieces[other].length() - snap)
          join(other, t_other, line, t_line, snap, outline);
    }
  }
}

Piece piece_of(const InnerLine& line, double from, double to) {
  Piece piece;
  piece.curve = line.curve;
  piece.edge = line.line;
  piece.on = design::EdgePart::On::line;
  piece.from = from;
  piece.to = to;
  return piece;
}

/// Is there cloth at the point? Even-odd over the closed loops.
bool on_cloth(const Point2& p, const std::vector<Trace>& border) {
  bool inside = false;
  for (const Trace& trace : border)
    for (std::size_t k = 0; k + 1 < trace.at.size(); ++k) {
      const Point2 &a = trace.at[k], &b = trace.at[k + 1];
      if ((a.y() <= p.y()) != (b.y() <= p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
        inside = !inside;
    }
  return inside;
}

/// Adds what of the lines lies on the cloth, off its border, and along no line before.
void append_lines(const std::vector<InnerLine>& lines, double h, Outline& outline) {
  constexpr double kPlaces[] = {0, 0.3, 0.5, 0.8, 1};
  std::vector<Trace> border, added;
  if (!lines.empty())
    for (const Piece& piece : outline.pieces) border.push_back(trace_of(piece, h));
  for (const InnerLine& line : lines) {
    const double length = line.curve.length();
    if (!is_finite(line.curve) || !(length > kMeet)) continue;
    const Trace trace = trace_of(piece_of(line, 0, length), h);
    std::vector<double> cuts{0, length};
    for (const Trace& piece : border) {
      if (!trace.may_meet(piece, kNear * h)) continue;
      for (const auto& [t, unused] : crossings(trace, piece)) cuts.push_back(t);
      if (const auto [distance, t] = nearest(trace, piece.at.front()); distance <= kNear * h) cuts.push_back(t);  // a corner
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      if (!(cuts[k + 1] - cuts[k] > kNear * h)) continue;
      const Point2 middle = line.curve.point_at(0.5 * (cuts[k] + cuts[k + 1]));
      const bool along_border = std::any_of(border.begin(), border.end(), [&](const Trace& piece) { return nearest(piece, middle).first <= kNear * h; });
      if (along_border || !on_cloth(middle, border)) continue;
      const bool again = std::any_of(added.begin(), added.end(), [&](const Trace& other) {
        return std::all_of(std::begin(kPlaces), std::end(kPlaces), [&](double place) {
          return nearest(other, line.curve.point_at(cuts[k] + place * (cuts[k + 1] - cuts[k]))).first <= kNear * h;
        });
      });
      if (again) continue;
      outline.lines.push_back(line);
      outline.lines.back().from = cuts[k];
      outline.lines.back().to = cuts[k + 1];
      outline.loops.push_back(outline.pieces.size());
      outline.pieces.push_back(piece_of(line, cuts[k], cuts[k + 1]));
      added.push_back(trace_of(outline.pieces.back(), h));
    }
  }
}

bool mirrors(const Piece& a, const Piece& b, double fold_x) {
  auto mirror = [&](const Point2& p) { return Point2(2 * fold_x - p.x(), p.y()); };
  if (std::abs(a.length() - b.length()) > kMeet) return false;
  for (double f : {0.0, 0.3, 0.5, 1.0})
    if ((a.at(f * a.length()) - mirror(b.at((1 - f) * b.length()))).norm() > kMeet) return false;
  return true;
}

/// Turns the loop so that it starts at the fold, if the panel is symmetric about it.
void find_half(Outline& outline, double fold_x) {
  std::size_t n = outline.pieces.size();
  std::vector<std::size_t> on_fold;
  for (std::size_t k = 0; k < n; ++k)
    if (std::abs(corner(outline, k).x() - fold_x) < kMeet) on_fold.push_back(k);
  if (on_fold.size() != 2 || n % 2 != 0) return;
  std::size_t first = on_fold[0];
  if (outline.pieces[first].at(0.5 * outline.pieces[first].length()).x() < fold_x) first = on_fold[1];
  std::rotate(outline.pieces.begin(), outline.pieces.begin() + static_cast<std::ptrdiff_t>(first),
              outline.pieces.end());
  if (std::abs(corner(outline, n / 2).x() - fold_x) >= kMeet) return;
  for (std::size_t k = 0; k < n / 2; ++k)
    if (!mirrors(outline.pieces[k], outline.pieces[n - 1 - k], fold_x)) return;
  outline.n_half = n / 2;
}

/// Loop `l` of the border crosses itself nowhere. (That loops keep apart shows in the mesh.)
bool check_crossing(const design::Panel& panel, const Outline& outline, std::size_t l, double h, Findings& findings) {
  std::vector<Point2> loop;
  std::vector<std::size_t> piece_of;
  for (std::size_t k = outline.begin_of(l); k < outline.end_of(l); ++k) {
    const Piece& piece = outline.pieces[k];
    loop.push_back(corner(outline, k));
    piece_of.push_back(k);
    if (piece.straight()) continue;
    std::vector<double> arcs;
    piece.curve.polyline(h / 50, &arcs);
    if (piece.from > piece.to) std::reverse(arcs.begin(), arcs.end());
    for (double arc : arcs) {
      double t = piece.position(arc);
      if (t < 1e-3 * h || t > piece.length() - 1e-3 * h) continue;
      loop.push_back(piece.at(t));
      piece_of.push_back(k);
    }
  }
  std::optional<Crossing> crossing = find_crossing(loop);
  if (!crossing) return true;
  const Piece &a = outline.pieces[piece_of[crossing->first]], &b = outline.pieces[piece_of[crossing->second]];
  int dart = a.dart >= 0 ? a.dart : b.dart;
  auto place = [&] {
    return fmt::format("({}, {}) mm", format_number(crossing->point.x() * 1000, 4),
                       format_number(crossing->point.y() * 1000, 4));
  };
  auto name = [&](const Piece& p) {
    if (p.inside_dart >= 0) return fmt::format("dart `{}`", panel.inside_darts[p.inside_dart].name);
    return p.dart >= 0 ? fmt::format("dart `{}`", panel.darts[p.dart].name)
                       : fmt::format("edge `{}`", design::edge_of(panel, {-1, p.edge, 0, 0, p.on}).name);
  };
  if (dart >= 0) {
    report(findings, "G0453", panel.darts[dart].origin,
           fmt::format("{} meets {} at {} in panel `{}`: the dart is deeper than its panel", name(a), name(b),
                       place(), panel.name),
           "make the dart shorter, or move it");
  } else {
    findings.push_back({"G0450",
                        Severity::error,
                        fmt::format("the outline of panel `{}` crosses itself at {}: {} and {}", panel.name,
                                    place(), name(a), name(b)),
                        {{design::edge_of(panel, {-1, a.edge, 0, 0, a.on}).origin, ""},
                         {design::edge_of(panel, {-1, b.edge, 0, 0, b.on}).origin, ""}},
                        "an outline may not touch or cross itself: move a point, or flatten a curve"});
  }
  return false;
}

}  // namespace

double Piece::bulge(double t0, double t1) const {
  if (straight()) return 0;
  Point2 p0 = at(t0);
  return geometry::integrate(geometry::kGauss8, arc(t0), arc(t1), 0.0, [&](double s) {
    return 0.5 * cross(curve.point_at(s) - p0, curve.tangent_at(s));
  });
}

double break_at(Piece& piece, double t, double tolerance) {
  auto next = std::lower_bound(piece.breaks.begin(), piece.breaks.end(), t);
  bool above = next != piece.breaks.end() && *next - t <= tolerance;
  bool below = next != piece.breaks.begin() && t - *(next - 1) <= tolerance;
  if (above && below) return *next - t < t - *(next - 1) ? *next : *(next - 1);
  if (above) return *next;
  if (below) return *(next - 1);
  piece.breaks.insert(next, t);
  return t;
}

std::size_t Outline::loop_of(std::size_t k) const {
  std::size_t l = 0;
  while (l + 1 < loops.size() && loops[l + 1] <= k) ++l;
  return l;
}

Point2 corner(const Outline& outline, std::size_t k) { return outline.pieces[k].at(0); }

std::optional<Outline> cut_outline(const design::Panel& panel, double h, const std::vector<InnerLine>& lines,
                                   Findings& findings) {
  if (!check_loop(panel, findings)) return std::nullopt;
  double area = 0;
  for (const design::Edge& edge : panel.edges) area += edge.curve.area_term();
  if (!(std::abs(area) > 1e-10)) {
    report(findings, "G0454", panel.origin,
           fmt::format("the outline of panel `{}` encloses {} mm^2", panel.name,
                       format_number(std::abs(area) * 1e6, 3)),
           "check the order and the signs of its points");
    return std::nullopt;
  }
  bool forward = area > 0;
  std::vector<std::vector<Mouth>> mouths;
  if (!collect_mouths(panel, forward, mouths, findings)) return std::nullopt;
  Outline outline;
  int n = static_cast<int>(panel.edges.size());
  for (int k = 0; k < n; ++k) {
    int e = forward ? k : n - 1 - k;
    append_edge(panel, e, forward, mouths[e], outline.pieces);
  }
  outline.area = std::abs(area);
  for (int e = 0; e < n; ++e) {
    const geometry::Curve& curve = panel.edges[e].curve;
    Piece whole;
    whole.curve = curve;
    for (const Mouth& m : mouths[e]) {
      whole.from = forward ? m.from : m.to;
      whole.to = forward ? m.to : m.from;
      Point2 a = whole.at(0), b = whole.at(whole.length());
      outline.area -= whole.bulge(0, whole.length()) + 0.5 * cross(b - a, m.apex - a);
    }
  }
  for (const design::Hole& hole : panel.holes) outline.area -= append_hole(panel, hole, outline);
  for (std::size_t d = 0; d < panel.inside_darts.size(); ++d) {
    if (!check_lens(panel, panel.inside_darts[d], findings)) return std::nullopt;
    outline.area -= append_lens(panel.inside_darts[d], static_cast<int>(d), outline);
  }
  for (std::size_t l = 0; l < outline.loops.size(); ++l)
    if (!check_crossing(panel, outline, l, h, findings)) return std::nullopt;
  outline.n_closed = outline.loops.size();
  append_lines(lines, h, outline);
  if (panel.fold_x && outline.loops.size() == 1) find_half(outline, *panel.fold_x);
  for (Piece& piece : outline.pieces) piece.breaks = {0, piece.length()};
  join_lines(h, outline);
  return outline;
}

}  // namespace garment::modeller
