// Questions about an outline as a polygon fine enough for checks (0.05 mm).
#include <algorithm>
#include <cmath>

#include "interpreter/language/outline.hpp"
#include "interpreter/language/segments.hpp"

namespace garment::interpreter {
namespace {

using design::Point2;
using geometry::cross;

std::string plain_name(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string::npos ? name : name.substr(dot + 1);
}

}  // namespace

void check_crossings(Program& program, const std::string& owner, const std::vector<design::Edge>& edges,
                     const std::vector<Span>& spans) {
  const std::vector<Segment> segments = segments_of(edges);
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
      count_step(program, spans[0]);
      const auto at = crossing(s, t);
      if (!at) continue;
      const std::string one = plain_name(edges[s.edge].name), two = plain_name(edges[t.edge].name);
      const std::string where = format_point(*at);
      Message message("G0402",
                      s.edge == t.edge
                          ? "edge `" + one + "` of " + owner + " crosses itself at " + where
                          : "edges `" + one + "` and `" + two + "` of " + owner + " cross at " + where,
                      spans[s.edge]);
      if (s.edge != t.edge) message.also(spans[t.edge], "");
      fail(program, message.help(owner.starts_with("hole") ? "a hole is one loop that does not cross itself"
                                                             : "an outline is one loop that does not cross itself"));
    }
  }
}

double depth_inside(const design::Panel& panel, const Point2& from, const Point2& way, double skip) {
  double nearest = 1e9;
  for (const Segment& s : segments_of(panel.edges)) {
    const Point2 d = s.b - s.a;
    const double det = cross(way, d);
    if (det == 0) continue;
    const double t = cross(s.a - from, d) / det, u = cross(s.a - from, way) / det;
    if (t > skip && u >= 0 && u <= 1) nearest = std::min(nearest, t);
  }
  return nearest;
}

bool contains(const design::Panel& panel, const Point2& p, double tolerance) {
  return contains(segments_of(panel.edges), p, tolerance);
}

}  // namespace garment::interpreter
