// Seam allowances: cloth outside the stitch line, and whether there is room for it.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "interpreter/language/panel_marks.hpp"
#include "interpreter/language/parts.hpp"
#include "interpreter/language/segments.hpp"

namespace garment::interpreter {
namespace {

using design::Point2;

constexpr double kStep = 5e-3;       // m between the places of an edge that are looked at
constexpr double kLeastGap = 1e-6;   // m
constexpr double kCorner = 2.5;      // allowances cross beside a corner; so many widths from it they may
constexpr double kSharp = 0.9;       // cosine of the turn from which on it is a corner
constexpr double kRound = 1.2;       // way along the edge to the straight way: less is no bend
constexpr double kTolerance = 5e-4;  // m of overlap that nobody cuts

double outward(const std::vector<design::Edge>& edges, std::size_t first, std::size_t count, bool hole) {
  double area = 0;
  for (std::size_t k = first; k < first + count; ++k) area += edges[k].curve.area_term();
  return (area > 0) == hole ? 1 : -1;  // of the normal to the left
}

/// The edge's name without its half.
std::string drawn_name(const std::string& name) {
  for (const std::string_view half : {"left.", "right."})
    if (name.starts_with(half)) return name.substr(half.size());
  return name;
}

/// Where the allowances of two edges lie on each other.
struct Overlap {
  std::size_t a = 0, b = 0;
  Point2 at{0, 0};
  double gap = 0;       ///< between the stitch lines there, m
  double excess = 0;    ///< how much the widths together are too wide, m
};

class AllowanceChecker {
 public:
  AllowanceChecker(Program& program, const PanelInfo& info, const std::vector<design::Edge>& edges, double side)
      : program_(program), info_(info), edges_(edges), side_(side), segments_(segments_of(edges)) {}

  void run() {
    std::optional<Overlap> worst;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (edges_[e].allowance <= 0 || is_leg(edges_[e].name)) continue;
      const double length = edges_[e].curve.length();
      const int n = std::clamp(static_cast<int>(std::ceil(length / kStep)), 2, 2000);
      for (int k = 0; k <= n; ++k) {
        const auto found = look(e, length * k / n);
        if (found && found->excess > kTolerance && (!worst || found->excess > worst->excess + kLeastGap)) worst = found;
      }
    }
    if (worst) tell(*worst);
  }

 private:
  /// The legs of a drawn dart are folded on each other, not cut apart.
  bool is_leg(const std::string& name) const {
    for (const design::LegDart& dart : info_.panel.leg_darts)
      if (dart.leg_a == name || dart.leg_b == name) return true;
    return false;
  }

  /// Looks square outwards from a place of edge `e` for another stitch line.
  std::optional<Overlap> look(std::size_t e, double s) {
    const geometry::Curve& curve = edges_[e].curve;
    const Point2 from = curve.point_at(s), t = curve.tangent_at(s), way = side_ * Point2(-t.y(), t.x());
    std::optional<Overlap> nearest;
    for (const Segment& segment : segments_) {
      count_step(program_, span_of(edges_[e]));
      const design::Edge& other = edges_[segment.edge];
      if (is_leg(other.name)) continue;
      const Point2 d = segment.b - segment.a, w = segment.a - from;
      const double det = way.x() * d.y() - way.y() * d.x();
      if (det == 0) continue;
      const double gap = (w.x() * d.y() - w.y() * d.x()) / det, u = (w.x() * way.y() - w.y() * way.x()) / det;
      if (!(gap > kLeastGap && u >= 0 && u <= 1) || (nearest && gap >= nearest->gap)) continue;
      const double wide = edges_[e].allowance + other.allowance;
      if (gap >= wide || joined(e, s, segment.edge, from + gap * way, gap, wide)) continue;
      nearest = Overlap{e, segment.edge, from, gap, wide - gap};
    }
    return nearest;
  }

  /// True where the two places hang together: beside the corner of two neighbours, where allowances are mitred, or along
  /// one smooth stretch.
  bool joined(std::size_t e, double s, std::size_t other, const Point2& hit, double gap, double wide) const {
    const std::size_t n = edges_.size();
    const double there = edges_[other].curve.nearest(hit), rest = edges_[e].curve.length() - s;
    if (other == e) return std::fabs(there - s) <= kRound * gap;
    auto beside = [&](std::size_t first, double to_corner, double from_corner) {
      const geometry::Curve &a = edges_[first].curve, &b = edges_[(first + 1) % n].curve;
      const bool sharp = a.tangent_at(a.length()).dot(b.tangent_at(0)) < kSharp;
      return sharp ? std::min(to_corner, from_corner) < kCorner * wide : to_corner + from_corner <= kRound * gap;
    };
    return (other == (e + 1) % n && beside(e, rest, there)) ||
           (e == (other + 1) % n && beside(other, edges_[other].curve.length() - there, s));
  }

  void tell(const Overlap& o) const {
    const design::Edge &a = edges_[o.a], &b = edges_[o.b];
    const bool one = o.a == o.b;
    const double fits = std::max(0.0, std::floor(o.gap / 2 * 1000) / 1000);
    Message message("G0431",
                    one ? "the allowance of `" + a.name + "` (" + format_quantity(a.allowance, kLength) +
                              ") lies on itself at " + format_point(o.at) + ": the edge comes within " +
                              format_quantity(o.gap, kLength) + " of itself there"
                        : "the allowances of `" + a.name + "` (" + format_quantity(a.allowance, kLength) + ") and `" +
                              b.name + "` (" + format_quantity(b.allowance, kLength) + ") lie on each other at " +
                              format_point(o.at) + ": the edges are " + format_quantity(o.gap, kLength) + " apart there",
                    span_of(a));
    if (!one) message.also(span_of(b), "");
    report(program_,
           message.help(format_quantity(fits, kLength) + (one ? " would fit: `allowance " : " on each would fit: `allowance ") +
                        format_quantity(fits, kLength) + " on " + a.name + "`"));
  }

  /// Where the edge was drawn, whichever half it is in.
  Span span_of(const design::Edge& edge) const {
    const auto found = info_.spans.find(drawn_name(edge.name));
    return found == info_.spans.end() ? Span{} : found->second;
  }

  Program& program_;
  const PanelInfo& info_;
  const std::vector<design::Edge>& edges_;
  double side_;
  std::vector<Segment> segments_;
};

std::string edge_named(Drawing& drawing, const RecipeItem& item, Clauses& clauses) {
  return clauses.has("on") ? edge_under(drawing, item, clauses).name : "";
}

}  // namespace

void add_allowance(Drawing& drawing, const RecipeItem& item) {
  Program& program = drawing.program;
  Scope& scope = drawing_scope(program, *item.scope, drawing.index, item);
  Clauses clauses(program, *item.statement, scope);
  if (item.statement->operands.size() != 1)
    fail(program, Message(item.statement->operands.empty() ? "G0312" : "G0313", "`allowance` takes one width",
                          item.statement->keyword.span)
                      .help("as in `allowance 1 cm` or `allowance 4 cm on hem`"));
  const Expr& expr = item.statement->operands[0];
  const double width = eval_quantity(program, expr, scope, kLength, "`allowance`").value;
  if (!(width >= 0 && width <= kWidestAllowance))
    fail(program, Message("G0309",
                          "`allowance` is " + format_quantity(width, kLength) + "; it must lie in 0 cm .. " +
                              format_quantity(kWidestAllowance, kLength),
                          expr.span));
  const std::string name = edge_named(drawing, item, clauses);
  clauses.finish();
  for (const design::Edge& line : drawing.panel.lines)
    if (!name.empty() && line.name == name)
      fail(program, Message("G0430", "`" + name + "` is an interior line: there is no cloth to leave beyond it",
                            clauses.find("on")->clause->span)
                        .help("allowances are left at edges of the outline and of holes"));
  for (auto* edges : {&drawing.panel.edges, &drawing.panel.hole_edges})
    for (design::Edge& edge : *edges)
      if (name.empty() ? !drawing.info.own_allowance.contains(edge.name) : edge.name == name) edge.allowance = width;
  if (!name.empty()) drawing.info.own_allowance.insert(name);
}

void check_allowances(Program& program, const PanelInfo& info) {
  const design::Panel& panel = info.panel;
  AllowanceChecker(program, info, panel.edges, outward(panel.edges, 0, panel.edges.size(), false)).run();
  for (const design::Hole& hole : panel.holes) {
    const auto first = panel.hole_edges.begin() + hole.first;
    const std::vector<design::Edge> edges(first, first + hole.count);
    AllowanceChecker(program, info, edges, outward(edges, 0, edges.size(), true)).run();
  }
}

void take_seam_allowances(Program& program) {
  std::map<const design::Edge*, double> widest;  // of those seen; nothing follows from the order here
  std::set<std::size_t> changed;
  for (const SeamInfo& seam : program.seams) {
    if (!seam.ready || !seam.seam.finish.allowance) continue;
    const double width = *seam.seam.finish.allowance;
    for (const design::SeamSide& side : seam.seam.sides)
      for (const design::EdgePart& part : side.parts) {
        PanelInfo& info = program.panels[static_cast<std::size_t>(part.panel)];
        if (part.on == design::EdgePart::On::line) continue;  // there is cloth on both sides already
        auto& edges = part.on == design::EdgePart::On::hole ? info.panel.hole_edges : info.panel.edges;
        design::Edge& edge = edges[static_cast<std::size_t>(part.edge)];
        if (info.own_allowance.contains(drawn_name(edge.name))) continue;
        double& most = widest.try_emplace(&edge, width).first->second;
        most = std::max(most, width);
        edge.allowance = most;
        changed.insert(static_cast<std::size_t>(part.panel));
      }
  }
  for (std::size_t p : changed) {
    PartGuard guard(program, program.panels[p].part);
    check_allowances(program, program.panels[p]);
  }
}

}  // namespace garment::interpreter
