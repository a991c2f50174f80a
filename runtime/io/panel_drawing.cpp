#include "runtime/io/panel_drawing.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "runtime/base/number.hpp"
#include "runtime/base/portable_math.hpp"
#include "runtime/io/cut_lines.hpp"

namespace garment::io {
namespace {

constexpr double kMargin = 19;       // mm about a piece, for the letters of its seams
constexpr double kTagRadius = 5.4;   // mm
constexpr double kNotch = 6;         // mm
constexpr double kMinNamed = 0.018;  // m, shorter edges carry no name

const Pen kFold{"#7a7f89", 0.35, "6 2 1 2", "none"};
const Pen kMouth{"#9aa0aa", 0.3, "2 2", "none"};

Point left_of(const Point& t) { return {-t[1], t[0]}; }

/// Where the line through p along d crosses the closed polygon: ascending parameters, in units of d.
std::vector<double> crossings(const std::vector<Point>& polygon, const Point& p, const Point& d) {
  std::vector<double> out;
  const Point n = left_of(d);
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double s = n.dot(a - p), t = n.dot(b - p);
    if ((s > 0) == (t > 0)) continue;
    out.push_back(d.dot(a + (b - a) * (s / (s - t)) - p) / d.squaredNorm());
  }
  std::sort(out.begin(), out.end());
  return out;
}

struct Chord {
  Point middle;
  double width = 0;
};

/// A wide place for the lettering, near the middle.
Chord roomiest(const std::vector<Point>& polygon) {
  Extent box;
  for (const Point& p : polygon) box.grow(p);
  Chord best{0.5 * (box.low + box.high), 0};
  double best_score = -1e300;
  for (int k = 3; k <= 13; ++k) {
    const Point start(box.low[0] - 1, box.low[1] + box.size()[1] * k / 16.0);
    const std::vector<double> at = crossings(polygon, start, Point(1, 0));
    for (std::size_t i = 0; i + 1 < at.size(); i += 2) {
      const double width = at[i + 1] - at[i];
      const double score = width - 0.6 * std::fabs(start[1] - 0.5 * (box.low[1] + box.high[1]));
      if (score > best_score) {
        best_score = score;
        best = {start + Point(0.5 * (at[i] + at[i + 1]), 0), width};
      }
    }
  }
  return best;
}

/// The stitch line as path data with its true curves, on paper with the panel's origin at `shift`; `edges` receives the names
/// of the edges, each with the number of curves that it is made of. For readers: what is drawn follows it closely enough.
std::string course_of(const design::Panel& panel, const Point& shift, std::string& edges) {
  auto number = [](double x) { return format_number(std::round(x * 1e7) / 1e7); };
  auto at = [&](const design::Point2& p) {
    return number(shift[0] + 1000 * p.x()) + ' ' + number(shift[1] - 1000 * p.y());
  };
  std::string out;
  for (const design::Edge& edge : panel.edges) {
    std::vector<geometry::Curve> links = edge.curve.elements();
    if (std::holds_alternative<geometry::Quadratic>(edge.curve.shape())) links = {edge.curve};
    if (out.empty()) out = "M" + at(edge.curve.start());
    for (const geometry::Curve& c : links) {
      if (const auto* q = std::get_if<geometry::Quadratic>(&c.shape())) {
        out += "Q" + at(q->control) + ' ' + at(c.end());
      } else if (const auto* b = std::get_if<geometry::Cubic>(&c.shape())) {
        out += "C" + at(b->control_1) + ' ' + at(b->control_2) + ' ' + at(c.end());
      } else if (const auto* arc = std::get_if<geometry::Arc>(&c.shape()); arc && arc->bulge != 0) {
        const double half = (c.end() - c.start()).norm() / 2, sagitta = std::fabs(arc->bulge);
        const std::string radius = number(1000 * (half * half / sagitta + sagitta) / 2);
        // Paper has y down: what bulges to the left of the way turns clockwise, from x to y.
        out += "A" + radius + ' ' + radius + " 0 " + (sagitta > half ? "1 " : "0 ") + (arc->bulge > 0 ? "1 " : "0 ") + at(c.end());
      } else {
        out += "L" + at(c.end());
      }
    }
    edges += fmt::format("{}{} {}", edges.empty() ? "" : " ", edge.name, links.size());
  }
  return out + "Z";
}

}  // namespace

PanelDrawing::PanelDrawing(const design::Panel& panel, std::vector<SeamTag> tags, std::vector<std::string> facts,
                   const std::array<double, 3>& color)
    : panel_(panel), tags_(std::move(tags)), facts_(std::move(facts)) {
  auto pale = [](double c) { return static_cast<int>(255 * (0.86 + 0.14 * std::clamp(c, 0.0, 1.0)) + 0.5); };
  tint_ = fmt::format("#{:02x}{:02x}{:02x}", pale(color[0]), pale(color[1]), pale(color[2]));
  double area = 0;
  for (const design::Edge& e : panel.edges) area += e.curve.area_term();
  side_ = area < 0 ? -1 : 1;
  collect_darts();
  collect_outline();
  if (outline_.size() < 3) {
    room_ = {Point(0, 0), Point(0, 0)};
    return;
  }
  for (const Point& p : outline_) room_.grow(p);
  for (const design::Edge& e : panel.edges)
    for (const design::Point2& p : e.curve.polyline(kChord)) room_.grow(mm_of(p));
  for (const CutLine& line : cut_lines(panel))
    for (const design::Point2& p : line) room_.grow(mm_of(p));
  room_.low -= Point(kMargin, kMargin);
  room_.high += Point(kMargin, kMargin);
}

Point PanelDrawing::inward(int edge, double at) const {
  return side_ * left_of(panel_.edges[edge].curve.tangent_at(at));
}

void PanelDrawing::collect_darts() {
  for (const design::EdgeDart& d : panel_.darts) {
    const auto e = std::find_if(panel_.edges.begin(), panel_.edges.end(),
                                [&](const design::Edge& edge) { return edge.name == d.edge; });
    if (e == panel_.edges.end()) continue;
    const int edge = static_cast<int>(e - panel_.edges.begin());
    const double from = std::max(0.0, d.at - d.width / 2),
                 to = std::min(e->curve.length(), d.at + d.width / 2);
    const Point middle = mm_of(e->curve.point_at(d.at));
    const Point apex = d.apex ? mm_of(*d.apex) : Point(middle + 1000 * d.depth * inward(edge, d.at));
    darts_.push_back(
        {edge, from, to, mm_of(e->curve.point_at(from)), apex, mm_of(e->curve.point_at(to)), middle});
  }
  std::stable_sort(darts_.begin(), darts_.end(),
                   [](const Dart& a, const Dart& b) { return a.from < b.from; });
}

void PanelDrawing::collect_outline() {
  for (std::size_t e = 0; e < panel_.edges.size(); ++e) {
    std::vector<double> at;
    const std::vector<design::Point2> points = panel_.edges[e].curve.polyline(kChord, &at);
    auto dart = darts_.begin();
    for (std::size_t k = 0; k < points.size(); ++k) {
      auto belongs = [&] {
        return dart != darts_.end() && (dart->edge != static_cast<int>(e) || dart->to <= at[k]);
      };
      while (belongs()) {
        if (dart->edge == static_cast<int>(e))
          for (const Point& p : {dart->start, dart->apex, dart->end}) outline_.push_back(p);
        ++dart;
      }
      const bool in_mouth = dart != darts_.end() && at[k] > dart->from && at[k] < dart->to;
      if (!in_mouth) outline_.push_back(mm_of(points[k]));
    }
  }
}

void PanelDrawing::draw(Paper& paper, const Point& corner) const {
  if (outline_.size() < 3) return;
  const Placed on{Point(corner[0] - room_.low[0], corner[1] + room_.high[1])};
  paper.begin_group(panel_.name);
  draw_outline(paper, on);
  draw_interior(paper, on);
  draw_allowances(paper, on);
  draw_middle(paper, on);
  draw_edge_names(paper, on);
  draw_notches(paper, on);
  draw_tags(paper, on);
  paper.end_group();
}

void PanelDrawing::draw_outline(Paper& paper, const Placed& on) const {
  Pen pen = kCut;
  pen.fill = tint_;
  std::string edges;
  const std::string course = course_of(panel_, on.shift, edges);
  paper.data("data-course", course);
  paper.data("data-edges", edges);
  paper.polyline(on(outline_), true, pen);
  for (const Dart& d : darts_) {
    std::vector<Point> mouth;
    for (int k = 0; k <= 8; ++k)
      mouth.push_back(mm_of(panel_.edges[d.edge].curve.point_at(d.from + (d.to - d.from) * k / 8)));
    paper.polyline(on(mouth), false, kMouth);
    paper.line(on(d.middle), on(d.apex), kMouth);
    paper.circle(on(d.apex), 1.2, kMark);
  }
  if (panel_.fold_x) {
    const Point p(1000 * *panel_.fold_x, 0);
    const std::vector<double> at = crossings(outline_, p, Point(0, 1));
    for (std::size_t k = 0; k + 1 < at.size(); k += 2)
      paper.line(on(p + Point(0, at[k])), on(p + Point(0, at[k + 1])), kFold);
  }
}

void PanelDrawing::draw_notches(Paper& paper, const Placed& on) const {
  for (const design::Notch& n : panel_.notches)
    for (std::size_t e = 0; e < panel_.edges.size(); ++e) {
      if (panel_.edges[e].name != n.edge) continue;
      const Point p = mm_of(panel_.edges[e].curve.point_at(n.at)), in = inward(static_cast<int>(e), n.at);
      const double beyond = 1000 * panel_.edges[e].allowance;  // to the cut line, where scissors find it
      paper.line(on(p - beyond * in), on(p + kNotch * in), kMark);
      paper.text(on(p + (kNotch + 3) * in), n.name,
                 {3,
                  in[0] > 0.3    ? Anchor::start
                  : in[0] < -0.3 ? Anchor::end
                                 : Anchor::middle,
                  0, false, "#555b66"});
    }
}

void PanelDrawing::draw_edge_names(Paper& paper, const Placed& on) const {
  for (std::size_t e = 0; e < panel_.edges.size(); ++e) {
    const geometry::Curve& curve = panel_.edges[e].curve;
    const double length = curve.length();
    if (panel_.edges[e].name.empty() || length < kMinNamed) continue;
    double at = 0.5 * length;  // a third of the way where a dart or a notch may be in the middle
    for (const Dart& d : darts_)
      if (d.edge == static_cast<int>(e) && d.from < 0.65 * length && d.to > 0.35 * length) at = 0.2 * length;
    for (const design::Notch& n : panel_.notches)
      if (n.edge == panel_.edges[e].name && std::fabs(n.at - at) < 0.03) at = 0.3 * length;
    const std::string label = panel_.edges[e].name + "  " + format_number(std::round(length * 1e4) / 10, 5);
    const double size = std::clamp(1000 * length / (0.75 * static_cast<double>(label.size())), 2.0, 6.0);
    const Point t = curve.tangent_at(at);
    double turn = -portable::atan2(t[1], t[0]) * 180 / portable::kPi;  // paper turns clockwise
    if (turn > 90.5) turn -= 180;
    if (turn < -89.5) turn += 180;
    paper.text(on(mm_of(curve.point_at(at)) + (3 + 0.6 * size) * inward(static_cast<int>(e), at)), label,
               {size, Anchor::middle, turn, false, "#555b66"});
  }
}

void PanelDrawing::draw_tags(Paper& paper, const Placed& on) const {
  const Pen ring{"#b03a2e", 0.4, "", "#fff"}, arrow{"#b03a2e", 0.3, "", "#b03a2e"},
      bound{"#b03a2e", 0.5, "", "none"};
  for (const SeamTag& tag : tags_) {
    const geometry::Curve& curve = panel_.edges[tag.edge].curve;
    const double at = 0.5 * (tag.from + tag.to);
    const Point p = mm_of(curve.point_at(at)), out = -inward(tag.edge, at);
    const Point along = (tag.to >= tag.from ? 1 : -1) * Point(curve.tangent_at(at));
    paper.polyline(
        on({Point(p + 2.6 * along), Point(p - 2 * along + 1.7 * out), Point(p - 2 * along - 1.7 * out)}),
        true, arrow);
    paper.circle(on(p + (kTagRadius + 3.5) * out), kTagRadius, ring);
    const double size = tag.letter.size() > 2 ? 3.6 : 6.0;
    paper.text(on(p + (kTagRadius + 3.5) * out), tag.letter, {size, Anchor::middle, 0, true, "#b03a2e"});
    for (double end : {tag.from, tag.to}) {
      if (end < 1e-6 || end > curve.length() - 1e-6) continue;  // corners show themselves
      const Point q = mm_of(curve.point_at(end)), n = inward(tag.edge, end);
      paper.line(on(q - 3 * n), on(q + 3 * n), bound);
    }
  }
}

void PanelDrawing::draw_grain(Paper& paper, const Placed& on, const Point& through) const {
  const Point d(-portable::sin(panel_.grain_angle), portable::cos(panel_.grain_angle));
  const std::vector<double> at = crossings(outline_, through, d);
  double low = 0, high = 0;
  for (std::size_t k = 0; k + 1 < at.size(); k += 2)
    if (at[k] <= 0 && at[k + 1] >= 0) {
      low = at[k];
      high = at[k + 1];
    }
  const double half = std::min(0.36 * (high - low), 110.0);
  if (half < 4) return;
  const Point middle = through + 0.5 * (low + high) * d, a = middle - half * d, b = middle + half * d;
  const double head = std::min(7.0, 0.4 * half);
  paper.line(on(a), on(b), kMark);
  Pen pen = kMark;
  pen.fill = pen.stroke;
  for (const auto& [tip, way] : {std::pair<Point, Point>{b, d}, {a, -d}})
    paper.polyline(on({tip, Point(tip - head * way + 0.3 * head * left_of(way)),
                       Point(tip - head * way - 0.3 * head * left_of(way))}),
                   true, pen);
}

void PanelDrawing::draw_middle(Paper& paper, const Placed& on) const {
  const Chord room = roomiest(outline_);
  std::size_t longest = panel_.name.size();
  for (const std::string& f : facts_) longest = std::max(longest, (f.size() * 2 + 2) / 3);
  const double size = std::clamp(
      0.5 * room.width / (0.56 * static_cast<double>(std::max<std::size_t>(longest, 4))), 2.5, 14.0);
  const double wide = lettering_width(std::string(longest, 'x'), size);
  draw_grain(paper, on, room.middle - Point(std::min(0.5 * wide + 10, 0.42 * room.width), 0));
  Point at = room.middle +
             Point(std::min(6.0, 0.04 * room.width), 0.7 * size * static_cast<double>(facts_.size()) / 2);
  paper.text(on(at), panel_.name, {size, Anchor::middle, 0, true, "#1b1d22"});
  at[1] -= 1.25 * size;
  for (const std::string& f : facts_) {
    paper.text(on(at), f, {0.62 * size, Anchor::middle, 0, false, "#3c414b"});
    at[1] -= 0.9 * size;
  }
}

}  // namespace garment::io
