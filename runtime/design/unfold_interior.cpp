#include "runtime/design/unfold_interior.hpp"

#include <cmath>

namespace garment::design {
namespace {

constexpr double kOnFold = 1e-6;  // m

Point2 image(const Point2& p, double fold_x) { return {2 * fold_x - p.x(), p.y()}; }

Edge image(const Edge& edge, const std::string& prefix, double fold_x) {
  Edge out = edge;
  out.name = prefix + edge.name;
  out.curve = edge.curve.mirrored_x(fold_x);
  return out;
}

/// The edge of the hole that lies along the fold; -1 if there is none.
int fold_edge_of(const Panel& half, const Hole& hole, double fold_x) {
  for (int k = 0; k < hole.count; ++k)
    if (hole.count > 1 && on_fold(half.hole_edges[static_cast<std::size_t>(hole.first + k)].curve, fold_x)) return k;
  return -1;
}

const Edge& edge_at(const Panel& half, const Hole& hole, int k) {
  return half.hole_edges[static_cast<std::size_t>(hole.first + k % hole.count)];
}

void add_holes(const Panel& half, const std::string& drawn, const std::string& mirrored, double fold_x,
               Panel& whole) {
  for (const Hole& hole : half.holes) {
    const int fold = fold_edge_of(half, hole, fold_x);
    Hole out = hole;
    out.first = static_cast<int>(whole.hole_edges.size());
    if (fold >= 0) {
      for (int k = 1; k < hole.count; ++k) {
        whole.hole_edges.push_back(edge_at(half, hole, fold + k));
        whole.hole_edges.back().name = drawn + whole.hole_edges.back().name;
      }
      for (int k = hole.count - 1; k > 0; --k) {
        whole.hole_edges.push_back(image(edge_at(half, hole, fold + k), mirrored, fold_x));
        whole.hole_edges.back().curve = whole.hole_edges.back().curve.reversed();
      }
      out.count = 2 * (hole.count - 1);
      whole.holes.push_back(out);
      continue;
    }
    for (const bool mirror : {false, true}) {
      out.name = (mirror ? mirrored : drawn) + hole.name;
      out.first = static_cast<int>(whole.hole_edges.size());
      for (int k = 0; k < hole.count; ++k) {
        const Edge& edge = edge_at(half, hole, k);
        whole.hole_edges.push_back(mirror ? image(edge, mirrored, fold_x) : edge);
        if (!mirror) whole.hole_edges.back().name = drawn + edge.name;
      }
      whole.holes.push_back(out);
    }
  }
}

void add_lines(const Panel& half, const std::string& drawn, const std::string& mirrored, double fold_x,
               Panel& whole) {
  auto add_slits = [&](std::size_t line, const std::string& prefix) {
    for (Slit slit : half.slits) {
      if (slit.line != static_cast<int>(line)) continue;
      slit.name = prefix + slit.name;
      slit.line = static_cast<int>(whole.lines.size()) - 1;
      whole.slits.push_back(slit);
    }
  };
  for (std::size_t k = 0; k < half.lines.size(); ++k) {
    const bool once = on_fold(half.lines[k].curve, fold_x);
    whole.lines.push_back(half.lines[k]);
    if (!once) whole.lines.back().name = drawn + half.lines[k].name;
    add_slits(k, once ? "" : drawn);
    if (once) continue;
    whole.lines.push_back(image(half.lines[k], mirrored, fold_x));
    add_slits(k, mirrored);
  }
}

}  // namespace

bool on_fold(const Point2& point, double fold_x) { return std::fabs(point.x() - fold_x) < kOnFold; }

bool on_fold(const geometry::Curve& curve, double fold_x) {
  for (const Point2& p : curve.polyline(1e-5))
    if (!on_fold(p, fold_x)) return false;
  return true;
}

bool in_joined_hole(const Panel& half, const std::string& edge, double fold_x) {
  for (const Hole& hole : half.holes) {
    if (fold_edge_of(half, hole, fold_x) < 0) continue;
    for (int k = 0; k < hole.count; ++k)
      if (edge_at(half, hole, k).name == edge) return true;
  }
  return false;
}

void unfold_interior(const Panel& half, const std::string& drawn, const std::string& mirrored, double fold_x,
                     Panel& whole) {
  add_holes(half, drawn, mirrored, fold_x, whole);
  add_lines(half, drawn, mirrored, fold_x, whole);
  for (const InteriorPoint& point : half.points) {
    const bool once = on_fold(point.point, fold_x);
    whole.points.push_back(point);
    if (once) continue;
    whole.points.back().name = drawn + point.name;
    whole.points.push_back({mirrored + point.name, point.origin, image(point.point, fold_x)});
  }
  for (const InsideDart& dart : half.inside_darts) {
    const bool once = on_fold(dart.from, fold_x) && on_fold(dart.to, fold_x);
    whole.inside_darts.push_back(dart);
    if (once) continue;
    whole.inside_darts.back().name = drawn + dart.name;
    InsideDart other = dart;
    other.name = mirrored + dart.name;
    other.from = image(dart.from, fold_x);
    other.to = image(dart.to, fold_x);
    whole.inside_darts.push_back(other);
  }
}

}  // namespace garment::design
