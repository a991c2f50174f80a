// Questions about an outline as a polygon fine enough for checks (0.05 mm).
#include <algorithm>
#include <cmath>

#include "interpreter/language/outline.hpp"

namespace garment::interpreter {
namespace {

using design::Point2;

constexpr double kChordError = 5e-5;  // m

struct Segment {
  Point2 a, b;
  std::size_t edge = 0;
};

std::vector<Segment> segments_of(const design::Panel& panel) {
  std::vector<Segment> segments;
  for (std::size_t k = 0; k < panel.edges.size(); ++k) {
    const std::vector<Point2> line = panel.edges[k].curve.polyline(kChordError);
    for (std::size_t j = 0; j + 1 < line.size(); ++j) segments.push_back({line[j], line[j + 1], k});
  }
  return segments;
}

double cross(const Point2& u, const Point2& v) { return u.x() * v.y() - u.y() * v.x(); }

bool crosses(const Segment& s, const Segment& t, Point2& at) {
  const double d1 = cross(s.b - s.a, t.a - s.a), d2 = cross(s.b - s.a, t.b - s.a);
  const double d3 = cross(t.b - t.a, s.a - t.a), d4 = cross(t.b - t.a, s.b - t.a);
  if (!(d1 * d2 < 0 && d3 * d4 < 0)) return false;
  at = s.a + (d3 / (d3 - d4)) * (s.b - s.a);
  return true;
}

std::string plain_name(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string::npos ? name : name.substr(dot + 1);
}

}  // namespace

void check_crossings(Program& program, const design::Panel& panel, const std::vector<Span>& spans) {
  std::vector<Segment> segments = segments_of(panel);
  auto low = [](const Segment& s) { return std::min(s.a.x(), s.b.x()); };
  auto high = [](const Segment& s) { return std::max(s.a.x(), s.b.x()); };
  std::vector<std::size_t> order(segments.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return low(segments[i]) != low(segments[j]) ? low(segments[i]) < low(segments[j]) : i < j;
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    count_step(program, spans[0]);
    const Segment& s = segments[order[i]];
    for (std::size_t j = i + 1; j < order.size() && low(segments[order[j]]) <= high(s); ++j) {
      const Segment& t = segments[order[j]];
      Point2 at;
      if (!crosses(s, t, at)) continue;
      const std::string one = plain_name(panel.edges[s.edge].name),
                        two = plain_name(panel.edges[t.edge].name);
      const std::string where =
          "(" + format_quantity(at.x(), kLength) + ", " + format_quantity(at.y(), kLength) + ")";
      Message message("G0402",
                      s.edge == t.edge
                          ? "edge `" + one + "` of `" + panel.name + "` crosses itself at " + where
                          : "edges `" + one + "` and `" + two + "` of `" + panel.name + "` cross at " + where,
                      spans[s.edge]);
      if (s.edge != t.edge) message.also(spans[t.edge], "");
      fail(program, message.help("an outline is one loop that does not cross itself"));
    }
  }
}

double depth_inside(const design::Panel& panel, const Point2& from, const Point2& way, double skip) {
  double nearest = 1e9;
  for (const Segment& s : segments_of(panel)) {
    const Point2 d = s.b - s.a;
    const double det = cross(way, d);
    if (det == 0) continue;
    const double t = cross(s.a - from, d) / det, u = cross(s.a - from, way) / det;
    if (t > skip && u >= 0 && u <= 1) nearest = std::min(nearest, t);
  }
  return nearest;
}

bool contains(const design::Panel& panel, const Point2& p, double tolerance) {
  bool inside = false;
  for (const Segment& s : segments_of(panel)) {
    const Point2 d = s.b - s.a;
    const double t = std::clamp((p - s.a).dot(d) / d.squaredNorm(), 0.0, 1.0);
    if ((s.a + t * d - p).norm() <= tolerance) return true;
    if ((s.a.y() > p.y()) != (s.b.y() > p.y()) && p.x() < s.a.x() + (p.y() - s.a.y()) / d.y() * d.x())
      inside = !inside;
  }
  return inside;
}

}  // namespace garment::interpreter
