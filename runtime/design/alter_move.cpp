// Moving edges, and scaling.
#include <algorithm>
#include <cmath>

#include "runtime/design/alter.hpp"
#include "runtime/geometry/curve_map.hpp"

namespace garment::design {
namespace {

using detail::kOnEdge;

bool named(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Old and new course of an edge.
struct Redrawn {
  geometry::Curve before, after;
};

/// Moves the corners of the named edges of one loop, edges[first .. first + count); those on the edge `fold` stay on it.
bool move_loop(Panel& panel, std::vector<Edge>& edges, std::size_t first, std::size_t count,
               const std::vector<std::string>& names, const Point2& by, const std::string& fold,
               std::vector<Redrawn>& redrawn) {
  const Point2 none(0, 0);
  std::vector<Point2> shift(count, none);  // corner k is the start of edge k
  std::vector<bool> moved(count, false);
  bool any = false;
  for (std::size_t k = 0; k < count; ++k) {
    if (!named(names, edges[first + k].name)) continue;
    moved[k] = moved[(k + 1) % count] = any = true;
    shift[k] = shift[(k + 1) % count] = by;
  }
  for (std::size_t k = 0; k < count && any && !named(names, fold); ++k) {
    if (edges[first + k].name != fold) continue;
    const geometry::Curve& course = edges[first + k].curve;
    const Point2 along = (course.end() - course.start()).normalized();
    for (const std::size_t corner : {k, (k + 1) % count}) shift[corner] = shift[corner].dot(along) * along;
  }
  for (std::size_t k = 0; k < count && any; ++k) {
    const Point2 start = shift[k], end = shift[(k + 1) % count];
    if (!moved[k] && !moved[(k + 1) % count]) continue;
    Edge& edge = edges[first + k];
    const geometry::Curve before = edge.curve;
    const geometry::Curve after = geometry::warped(before, start, end);
    const double ratio = before.length() > 0 ? after.length() / before.length() : 1;
    detail::redraw(panel, edge, after, [ratio](double s) { return ratio * s; });
    redrawn.push_back({before, after});
  }
  return any;
}

/// How far the end of a line moves with the edge that it lies on.
Point2 shift_of(const Point2& end, const std::vector<Redrawn>& redrawn) {
  for (const Redrawn& r : redrawn) {
    const double s = r.before.nearest(end);
    if ((r.before.point_at(s) - end).norm() > kOnEdge || r.before.length() <= 0) continue;
    return r.after.point_at(s / r.before.length() * r.after.length()) - end;
  }
  return {0, 0};
}

}  // namespace

namespace detail {

void redraw(Panel& panel, Edge& edge, const geometry::Curve& course, const std::function<double(double)>& place) {
  edge.curve = course;
  auto follow = [&](double s) { return std::clamp(place(s), 0.0, course.length()); };
  for (Notch& notch : panel.notches)
    if (notch.edge == edge.name) notch.at = follow(notch.at);
  for (EdgeDart& dart : panel.darts)
    if (dart.edge == edge.name) dart.at = follow(dart.at);
  for (Pleat& pleat : panel.pleats)
    if (pleat.edge == edge.name) pleat.at = follow(pleat.at);
}

}  // namespace detail

bool move(Panel& panel, const std::vector<std::string>& names, const Point2& by, const std::string& fold) {
  std::vector<Redrawn> redrawn;
  std::vector<std::string> all = names;  // a hole stands for all its edges
  for (const Hole& hole : panel.holes)
    for (int k = hole.first; k < hole.first + hole.count && named(names, hole.name); ++k)
      all.push_back(panel.hole_edges[static_cast<std::size_t>(k)].name);
  bool any = move_loop(panel, panel.edges, 0, panel.edges.size(), all, by, fold, redrawn);
  for (const Hole& hole : panel.holes)
    any = move_loop(panel, panel.hole_edges, static_cast<std::size_t>(hole.first),
                    static_cast<std::size_t>(hole.count), all, by, fold, redrawn) ||
          any;
  for (Edge& line : panel.lines) {
    const bool own = named(names, line.name);
    any = any || own;
    const Point2 start = own ? by : shift_of(line.curve.start(), redrawn),
                 end = own ? by : shift_of(line.curve.end(), redrawn);
    if (start.norm() == 0 && end.norm() == 0) continue;
    const double length = line.curve.length();
    const geometry::Curve course = geometry::warped(line.curve, start, end);
    const double ratio = length > 0 ? course.length() / length : 1;
    detail::redraw(panel, line, course, [ratio](double s) { return ratio * s; });
  }
  for (InteriorPoint& point : panel.points) {
    const bool own = named(names, point.name);
    any = any || own;
    point.point += own ? by : shift_of(point.point, redrawn);
  }
  return any;
}

void scale(Panel& panel, double factor_x, double factor_y) {
  auto map = [&](Point2& p) { p = Point2(factor_x * p.x(), factor_y * p.y()); };
  // A dart's or pleat's measures along an edge grow with it there, a depth with the normal.
  auto factor = [&](const Edge& edge, double at, bool across) {
    Point2 t = edge.curve.tangent_at(at);
    if (across) t = Point2(-t.y(), t.x());
    return Point2(factor_x * t.x(), factor_y * t.y()).norm();
  };
  for (auto* edges : {&panel.edges, &panel.hole_edges, &panel.lines})
    for (Edge& edge : *edges) {
      for (EdgeDart& dart : panel.darts)
        if (dart.edge == edge.name)
          dart.width *= factor(edge, dart.at, false), dart.depth *= factor(edge, dart.at, true);
      for (Pleat& pleat : panel.pleats)
        if (pleat.edge == edge.name) {
          const double along = factor(edge, pleat.at, false);
          pleat.length *= factor(edge, pleat.at, true);
          pleat.underlay *= along;
          pleat.spacing *= along;
        }
      const geometry::Curve before = edge.curve;
      const geometry::Curve course = geometry::stretched(before, factor_x, factor_y);
      detail::redraw(panel, edge, course, [&](double s) {
        Point2 p = before.point_at(s);
        map(p);
        return course.nearest(p);
      });
    }
  for (InteriorPoint& point : panel.points) map(point.point);
  for (EdgeDart& dart : panel.darts)
    if (dart.apex) map(*dart.apex);
  for (InsideDart& dart : panel.inside_darts) {
    const Point2 along = (dart.to - dart.from).normalized();
    dart.width *= Point2(-factor_x * along.y(), factor_y * along.x()).norm();
    map(dart.from);
    map(dart.to);
  }
}

}  // namespace garment::design
