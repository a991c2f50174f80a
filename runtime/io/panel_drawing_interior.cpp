// What lies inside a pattern piece and along its edges: cut lines, holes, lines, points, lenses, pleats.
#include <algorithm>
#include <cmath>

#include "runtime/io/cut_lines.hpp"
#include "runtime/io/panel_drawing.hpp"

namespace garment::io {
namespace {

const Pen kAllowance{"#1b1d22", 0.4, "", "none"};
const Pen kRim{"#1b1d22", 0.7, "", "#ffffff"};
const Pen kLine{"#3c6e8f", 0.4, "5 2", "none"};
const Pen kSlit{"#b03a2e", 0.6, "", "none"};
const Pen kFoldLine{"#6a4c93", 0.4, "4 1.5", "none"};
const Pen kArrow{"#6a4c93", 0.4, "", "none"};
const char* const kName = "#555b66";

/// Label beside a curve's middle.
Point beside(const geometry::Curve& curve, double share) {
  const design::Point2 t = curve.tangent_at(share * curve.length());
  return mm_of(curve.point_at(share * curve.length())) + 2.5 * Point(-t.y(), t.x());
}

}  // namespace

void PanelDrawing::draw_allowances(Paper& paper, const Placed& on) const {
  for (const CutLine& line : cut_lines(panel_)) paper.polyline(on(mm_of(line)), true, kAllowance);
}

void PanelDrawing::draw_interior(Paper& paper, const Placed& on) const {
  for (const design::Hole& hole : panel_.holes) {
    std::vector<Point> rim;
    for (int k = hole.first; k < hole.first + hole.count; ++k) {
      const std::vector<Point> part = mm_of(panel_.hole_edges[static_cast<std::size_t>(k)].curve.polyline(kChord));
      rim.insert(rim.end(), part.begin(), part.end() - 1);
    }
    paper.polyline(on(rim), true, kRim);
    Extent box;
    for (const Point& p : rim) box.grow(p);
    const double size = std::clamp(0.2 * box.size()[0], 2.0, 4.0);
    paper.text(on(0.5 * (box.low + box.high)), hole.name, {size, Anchor::middle, 0, false, kName});
  }
  for (std::size_t k = 0; k < panel_.lines.size(); ++k) {
    const design::Edge& line = panel_.lines[k];
    const bool slit = std::any_of(panel_.slits.begin(), panel_.slits.end(),
                                  [&](const design::Slit& s) { return s.line == static_cast<int>(k); });
    paper.polyline(on(mm_of(line.curve.polyline(kChord))), false, slit ? kSlit : kLine);
    paper.text(on(beside(line.curve, 0.4)), line.name, {3, Anchor::middle, 0, false, kName});
  }
  for (const design::InteriorPoint& point : panel_.points) {
    const Point p = mm_of(point.point);
    paper.line(on(p - Point(2, 0)), on(p + Point(2, 0)), kMark);
    paper.line(on(p - Point(0, 2)), on(p + Point(0, 2)), kMark);
    paper.text(on(p + Point(3, 2.5)), point.name, {3, Anchor::start, 0, false, kName});
  }
  draw_lenses(paper, on);
  draw_pleats(paper, on);
}

void PanelDrawing::draw_lenses(Paper& paper, const Placed& on) const {
  for (const design::InsideDart& dart : panel_.inside_darts) {
    const Point from = mm_of(dart.from), to = mm_of(dart.to), along = to - from;
    const Point middle = from + dart.at * along, side = 500 * dart.width * Point(-along[1], along[0]).normalized();
    paper.polyline(on({from, Point(middle + side), to, Point(middle - side)}), true, kCut);
    paper.line(on(from), on(to), kLine);
    for (const Point& tip : {from, to}) paper.circle(on(tip), 1.2, kMark);
    const Point right = side[0] > 0 ? Point(middle + side) : Point(middle - side);
    paper.text(on(right + Point(2, 0)), dart.name, {3, Anchor::start, 0, false, kName});
  }
}

void PanelDrawing::draw_pleats(Paper& paper, const Placed& on) const {
  constexpr double kShown = 60;  // mm of a pleat that is only held at its edge
  for (const design::Pleat& pleat : panel_.pleats)
    for (std::size_t e = 0; e < panel_.edges.size(); ++e) {
      if (panel_.edges[e].name != pleat.edge) continue;
      const geometry::Curve& curve = panel_.edges[e].curve;
      const double deep = pleat.length > 0 ? 1000 * pleat.length : kShown;
      for (int k = 0; k < pleat.count; ++k) {
        const double at = pleat.at + k * pleat.spacing;
        const Point in = inward(static_cast<int>(e), at), t = curve.tangent_at(at);
        auto place = [&](double s) { return mm_of(curve.point_at(at + s)); };
        const bool both = pleat.kind == design::Pleat::Kind::box || pleat.kind == design::Pleat::Kind::inverted;
        const double half = pleat.take() / 2;
        std::vector<double> folds{-half, half};
        folds.push_back(0);
        if (both) folds = {-half, -half / 2, half / 2, half};
        for (const double s : folds) paper.line(on(place(s)), on(place(s) + deep * in), kFoldLine);
        // An arrow from fold line to the line it is laid on.
        auto arrow = [&](double a, double b) {
          const Point p = place(a) + 8 * in, q = place(b) + 8 * in, back = (b > a ? -1 : 1) * Point(t);
          paper.line(on(p), on(q), kArrow);
          paper.line(on(q), on(q + 2 * back + 1.2 * in), kArrow);
          paper.line(on(q), on(q + 2 * back - 1.2 * in), kArrow);
        };
        if (!both) {
          arrow(-pleat.toward * half, pleat.toward * half);
        } else if (pleat.kind == design::Pleat::Kind::inverted) {
          arrow(-half, -0.1 * half), arrow(half, 0.1 * half);
        } else {
          arrow(-0.1 * half, -half), arrow(0.1 * half, half);
        }
        if (k == 0) paper.text(on(place(0) + (deep + 4) * in), pleat.name, {3, Anchor::middle, 0, false, kName});
      }
    }
}

}  // namespace garment::io
